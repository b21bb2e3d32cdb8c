// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/AutoShadowOptions.h>
#include <gnomon/ShadowDecision.h>
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/TerrainShadowOptions.h>
#include <gnomon/choice/ShadowWork.h>

#include <osg/Vec4d>

#include <array>
#include <string>
#include <vector>

namespace gnomon {

struct AutoCosts;

/// Shares of the frames in which things move.
struct AutoMotion {
    double scene = 0.0; ///< the light or a caster.
    double view = 0.0;  ///< the view alone.
};

/// A way to draw a shadow, with what it is expected to come to.
struct AutoCandidate {
    /// Mixed: simple casters by volume, the others by map, see CasterSplit.
    enum class Kind { Nothing, Planar, Terrain, Map, Volume, Traced, Mixed };

    Kind kind = Kind::Nothing;
    ShadowMapOptions map = {};
    TerrainShadowOptions terrain = {};
    std::vector<osg::Vec4d> planes = {}; ///< group frame.
    double error = 0.0;                  ///< pixels.
    ShadowWork still = {};               ///< in every frame.
    ShadowWork change = {};              ///< besides, in a frame in which the light or a caster moves.
    std::string obstacle = {};           ///< why it cannot be used.

    /// True if it has a map, and with it ShadowMapOptions.
    bool hasMap() const { return kind == Kind::Map || kind == Kind::Mixed; }
    /// Specification string without composite and receiver. "volume+", and that of the map, where both are drawn.
    std::string spec() const;
    /// True if it is drawn alike, wherever the planes are.
    bool isSame(const AutoCandidate& other) const;
    /// Milliseconds a frame, over many frames.
    double time(const AutoCosts& costs, const AutoMotion& motion) const;
    ShadowCandidate judged(const AutoCosts& costs, const AutoMotion& motion) const;
};

/// What work takes: by the renderer, and corrected for each kind of candidate.
struct AutoCosts {
    static constexpr std::size_t kinds = 7; ///< see AutoCandidate::Kind.

    /// What predicted times of a kind are multiplied by: of frames in which neither light nor casters move, and of others.
    struct Factors {
        double still = 1.0, moving = 1.0;
    };

    CostRates rates = {};
    std::array<Factors, kinds> factors = {};
};

} // namespace gnomon
