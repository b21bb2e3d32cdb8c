// SPDX-License-Identifier: MIT
#include "Errors.h"
#include "ImageFile.h"
#include "StageViewer.h"

namespace gnomon::examples {

Sight::Sight(const Contender& contender, const ChartScene& scene)
    : _viewer(contender.stage(scene, Look::VISIBILITY), scene.camera, StageViewer::Colour::FLOATS) {}

metrics::Picture Sight::frame() {
    _viewer.draw();
    return greysOf(*_viewer.image());
}

metrics::Visibility Sight::visibility() {
    const metrics::Picture casting = frame();
    _diagnosis = _viewer.staging().diagnose();
    _decisions = _viewer.staging().decisions();
    _viewer.staging().setCasting(false);
    const metrics::Picture notCasting = frame();
    _viewer.staging().setCasting(true);
    return metrics::visibility(casting, notCasting, metrics::Picture(casting.width, casting.height));
}

ShadedPicture shadedPicture(const Contender& contender, const ChartScene& scene) {
    StageViewer viewer(contender.stage(scene, Look::SHADED), scene.camera, StageViewer::Colour::FLOATS);
    viewer.draw();
    return coloursOf(*viewer.image());
}

} // namespace gnomon::examples
