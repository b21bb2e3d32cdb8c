// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityScene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// One caster of a random scene. Lengths are metres.
struct RandomCaster {
    int shape = 0; ///< 0: a box; else another of the table in RandomScene.cpp.
    int state = 0; ///< how it is drawn, 0: plainly. What is clear, cut or not drawn is not there for rays.
    glm::dvec3 foot{0.0}, size{1.0};
    double turn = 0.0, tilt = 0.0; ///< degrees, about the vertical and about x.
    int transforms = 0;            ///< above it, mirrored and stretched in turns.
    bool broken = false;           ///< holds triangles with NaN and without area.
    bool edited = false;           ///< stands elsewhere for two frames, then its vertices are changed in place.
};

/// A scene that a seed makes, the same on every machine.
struct RandomScene {
    enum class Ground { FLAT, TILTED, HILLS };

    unsigned seed = 0;
    Ground ground = Ground::FLAT;
    std::vector<RandomCaster> casters;
    glm::dvec4 light{0.0}; ///< homogeneous.
    glm::dvec3 eye{0.0}, center{0.0};
    double fovy = 40.0;  ///< degrees.
    double offset = 0.0; ///< of all of it from the origin, metres.
    double scale = 1.0;  ///< of all of it.
    double half = 14.0;  ///< of the ground's side.
    double stray = 0.0;  ///< how far away another box is; 0: there is none.

    /// A slab above the eye, out of sight, whose shadow is in sight.
    enum class Roof {
        NONE,
        CULLED, ///< by a callback.
        CUT     ///< by a clip plane of a camera above all.
    };
    Roof roof = Roof::NONE;
    bool backdrop = false; ///< drawn first, through a projection of its own.
    double fraction = 0.0; ///< of a pixel, see SceneCamera.
};

/// Seeds from here on have roofs, backdrops, fractions, water and edited casters, too.
constexpr unsigned firstOfMoreKinds = 10001;

RandomScene randomScene(unsigned seed);
StabilityCase caseOf(const RandomScene& scene, int width, int height);

/// The scene with one thing less or plainer, each in one way; none if it is as plain as can be.
std::vector<RandomScene> simpler(const RandomScene& scene);

/// All that makes it, for people.
std::string describe(const RandomScene& scene);

/// What a search looks through.
struct RandomSearch {
    unsigned first = 1, count = 500; ///< seeds.
    std::vector<Entrant> contenders;
    int width = 128, height = 96; ///< of the pictures, pixels.
    unsigned workers = 1;         ///< child processes at a time.
    unsigned batch = 400;         ///< seeds after which faults are told, at least 1.
};

/// A scene in which a technique breaks, as plain as it still does.
struct RandomFault {
    std::string technique;
    unsigned seed = 0;
    RandomScene plainest;
    StabilityCell cell; ///< of the plainest.
};

/// Whether a cell is a catastrophe among random scenes: a crash, a hang, a failure, NaN, or an IoU below 0.5 where more than
/// 200 pixels are shadowed, or wrong away from edges, and no limit is stated. A technique with a receiver of its own is judged there.
bool isRandomFault(const StabilityCell& cell);

/// Measures random scenes, and makes each fault's scene plainer for as long as the fault stays.
/// @param progress  see runStability().
/// @param found     called for each fault, after its batch.
/// @return scenes of which all faults were told; less than search.count if `progress` ended the search.
unsigned searchRandomScenes(const RandomSearch& search,
                            const std::function<bool(std::size_t done, const std::string&)>& progress,
                            const std::function<void(const RandomFault&)>& found);

/// A sentence a fault, with all that makes its scene.
std::string faultText(const RandomFault& fault);

} // namespace gnomon::examples
