// SPDX-License-Identifier: MIT
#pragma once
#include "Contender.h"
#include "StageViewer.h"
#include "Yardstick.h"

#include <metrics/Visibility.h>

namespace gnomon::examples {

/// A contender's visibility scene on a screen: white in the light alone, float colours.
///
/// V = A / B: A is the frame, B the same with nothing in the passes that cast. Full shadow is black in such a scene, so
/// that no third picture is needed. Under BLEND there is some ambient light, which a shadow blackens, too.
class Sight {
public:
    /// @throws see Contender::stage.
    Sight(const Contender& contender, const ChartScene& scene);

    void setCamera(const SceneCamera& camera) { _viewer.setCamera(camera); }
    void setLight(const osg::Vec4d& light) { _viewer.staging().setLight(light); }
    metrics::Visibility visibility();
    /// Why shadows were missing in the last visibility.
    const std::vector<std::string>& diagnosis() const { return _diagnosis; }
    /// How its shadow was chosen, see Staging::decisions().
    const std::vector<ShadowDecision>& decisions() const { return _decisions; }

private:
    metrics::Picture frame();

    StageViewer _viewer;
    std::vector<std::string> _diagnosis;
    std::vector<ShadowDecision> _decisions;
};

/// The contender's picture as a user sees it.
ShadedPicture shadedPicture(const Contender& contender, const ChartScene& scene);

} // namespace gnomon::examples
