// SPDX-License-Identifier: MIT
#pragma once
#include "Yardstick.h"

#include <metrics/Flicker.h>

#include <functional>
#include <limits>
#include <vector>

namespace gnomon::examples {

/// A short film of a scene and the truth of each frame, for metrics::FlickerMeter.
///
/// Cost    34 rays a pixel and frame; about 50 bytes a pixel and frame are kept.
class Film {
public:
    enum class Motion {
        CAMERA, ///< the camera goes on by an eighth of a texel of a map of 1024 over the scene.
        LIGHT,  ///< the light turns, by as much at the scene's edge.
        PIXELS  ///< the camera goes on, then turns, by an eighth of a pixel at the median depth of what is seen.
    };

    /// @param frames  at least 2.
    /// @param stops   asked before each frame: true ends the film there.
    Film(const Yardstick& yardstick, Motion motion, int frames, const std::function<bool()>& stops);

    /// What the contender's film is like. The sight is moved.
    /// @param objects          only receivers of ids up to this count.
    /// @param turnedAwayWrong  where not null, the most of any frame, see metrics::turnedAwayWrong().
    metrics::FlickerMeter measure(Sight& sight, const std::function<bool()>& stops,
                                  int objects = std::numeric_limits<int>::max(),
                                  std::size_t* turnedAwayWrong = nullptr) const;

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
