// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityScene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gnomon::examples {

/// What a random scene's casters are.
enum class RandomShape { BOX, SPHERE, PRISM, SHEET, OPEN, TURNED, FENCE };

/// How they are drawn. CLEAR has an alpha of 0.3 and is black, SOLID one of 0.97; what is clear, cut or not drawn is not there for rays.
enum class RandomState {
    PLAIN,
    CLIPPED,
    CLEAR_TEXTURE,
    SOLID_TEXTURE,
    CLEAR_TEST,
    SOLID_TEST,
    CLEAR_COLORS,
    SOLID_COLORS,
    CLEAR_MATERIAL,
    SOLID_MATERIAL,
    RESTARTED,
    INDIRECT,
    BACK_CULLED,
    FRONT_CULLED,
    BOTH_CULLED,
    NEVER,
    MASKED,
    LINES
};

/// One caster of a random scene. Lengths are metres.
struct RandomCaster {
    RandomShape shape = RandomShape::BOX; ///< OPEN: a sphere without some triangles. TURNED: some the wrong way round.
    RandomState state = RandomState::PLAIN;
    glm::dvec3 foot{0.0}, size{1.0};
    double turn = 0.0, tilt = 0.0; ///< degrees, about the vertical and about x.
    int transforms = 0;            ///< above it, mirrored and stretched in turns.
    bool broken = false;           ///< holds triangles with NaN and without area.
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
};

RandomScene randomScene(unsigned seed);
StabilityCase caseOf(const RandomScene& scene, int width, int height);

/// The scene with one thing less or plainer, each in one way; none if it is as plain as can be.
std::vector<RandomScene> simpler(const RandomScene& scene);

/// All that makes it, for people.
std::string describe(const RandomScene& scene);

} // namespace gnomon::examples
