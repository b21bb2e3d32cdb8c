// SPDX-License-Identifier: MIT
#pragma once
#include "Errors.h"

#include <gnomon/metrics/Flicker.h>

#include <functional>
#include <vector>

namespace gnomon::examples {

/// One frame for the meter. @param origin  of the truth's positions.
metrics::FlickerFrame flickerFrame(const metrics::TruthMaps& truth, const osg::Vec3d& origin, const SceneCamera& camera,
                                   metrics::Picture visibility, metrics::Mask facing);

/// A short film of a scene and the truth of each frame, for metrics::FlickerMeter. Steps are about an eighth of a texel of
/// a map of 1024 over the scene: what snaps to texels is seen snapping.
///
/// Cost    34 rays a pixel and frame; about 50 bytes a pixel and frame are kept.
class Film {
public:
    enum class Motion { CAMERA, LIGHT };

    /// @param frames  at least 2.
    /// @param stops   asked before each frame: true ends the film there.
    Film(const Yardstick& yardstick, Motion motion, int frames, const std::function<bool()>& stops);

    /// What the contender's film is like. The sight is moved.
    metrics::FlickerMeter measure(Sight& sight, const std::function<bool()>& stops) const;

private:
    struct Frame {
        SceneCamera camera;
        osg::Vec4d light;
        metrics::TruthMaps truth;
    };

    osg::Vec3d _origin; ///< of the truth's positions
    std::vector<Frame> _frames;
};

} // namespace gnomon::examples
