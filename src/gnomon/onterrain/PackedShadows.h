// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/onterrain/PackedParts.h>
#include <gnomon/onterrain/TerrainOutcome.h>

#include <glm/vec2.hpp>

#include <array>

namespace gnomon {

struct ShadowKernel;

/// The shadow of one of many parts, in their PackedShadows.
struct PackedShadow {
    const glm::vec3* corners; ///< about PackedShadows::origin.
    std::size_t cornerCount;
    /// Three a triangle, places among the part's own corners, counter-clockwise from above. None where `isFan`: then the
    /// triangles are 0, i, i + 1 of the corners, which are the outline, counter-clockwise from above.
    const unsigned* indices;
    std::size_t indexCount;
    TerrainOutcome outcome;
    bool isFan() const { return outcome == TerrainOutcome::fan; }
};

/// What tells how far one part's shadow moves under a sun: see movedAtMost().
struct ShadowMotion {
    double height = 0.0; ///< of the part over its shadow; infinite if there may be a shadow as soon as the sun moves.
    /// Slope of the ground there along the light's way in plan and across it, more the more nearly it falls off as the light
    /// does.
    double along = 0.0, across = 0.0;
};

/// Of a sun over the horizon. @param then,now  see wayOf().
struct SunTurn {
    SunTurn(const glm::dvec2& then, const glm::dvec2& now);
    double way;           ///< length of its way in plan a unit of height, then.
    double along, across; ///< by how much that has changed, as ShadowMotion has it.
    double turned;        ///< in all.
};

/// What tells how far any of many shadows moves, whichever way the sun does.
class ShadowRates {
public:
    static constexpr double mostTurned = 0.1; ///< beyond it nothing is known.
    /// @param way  length of the light's way in plan a unit of height.
    void take(const ShadowMotion& motion, double way);
    /// @param turned  by how much that way has changed.
    double movedAtMost(double turned) const;
    double ofSmallTurns() const { return _rates.front(); } ///< a unit of turn.

private:
    static constexpr std::array<double, 3> turns = {1e-3, 1e-2, mostTurned};
    std::array<double, 3> _rates{}; ///< a unit of turn, for turns up to each of `turns`.
};

/// The shadows of PackedParts, part by part.
struct PackedShadows {
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> corners;
    std::vector<unsigned> indices;
    std::vector<unsigned> cornerEnds, indexEnds; ///< one past each part's own.
    std::vector<TerrainOutcome> outcomes;
    ShadowRates rates;     ///< of all.
    double steepest = 0.0; ///< slope of the ground wherever they are or may be by then, or more.

    std::size_t size() const { return outcomes.size(); }
    PackedShadow operator[](std::size_t part) const;
    /// As terrainShadow() gives them, but for the rounding to single precision about the origin.
    Drape triangles(std::size_t part) const;
    std::size_t triangleCount() const; ///< of all.
    std::size_t bytes() const;         ///< that are kept.
};

/// terrainShadow() of each part, bit for bit. Memory that `found` has is used again.
///
/// @param origin  that the corners are about, near the parts: they are floats.
/// @param kernel  one of shadowKernels(); null for the best. All give the same bits.
///
/// Threads any number, each with its own `found`.
void packedShadows(const Ground& ground, const PackedParts& parts, const glm::dvec4& light, TerrainMethod method,
                   double error, const glm::dvec3& origin, PackedShadows& found, const ShadowKernel* kernel = nullptr);

/// Of each part's shadow, by the ground that it may come near. @param sun  over the horizon, that they were found with.
void findMotions(const Ground& ground, const PackedParts& parts, const PackedShadows& found, const glm::dvec4& sun,
                 std::vector<ShadowMotion>& motions);

/// The way towards a sun over the horizon in plan, a unit of height.
glm::dvec2 wayOf(const glm::dvec4& sun);

/// How far in plan any edge of the shadows may have moved at most since they were found.
///
/// @param shadows  found with the light `then`.
/// @return infinite where no bound is known: of lamps that moved, where the ground is as steep as the light, or near a hole in it.
///
/// A point at height h over its shadow moves it by v = h (d' - d) + (G v) d, where d is the light's way in plan a unit of
/// height, d' what it was and G the ground's gradient on the way of its ray, old and new: so |v| <= h |d - d'| (1 + |d| |G| / (1 - G d)),
/// and where the way of the turn is known, G v = h G (d' - d) / (1 - G d).
/// Source: the tip's speed h / sin^2 e of a shadow on level ground, e the sun's elevation.
double movedAtMost(const PackedShadows& shadows, const glm::dvec4& then, const glm::dvec4& now);
/// Of one part alone, which is nearer to what it moves by.
double movedAtMost(const ShadowMotion& motion, const SunTurn& turn);

} // namespace gnomon
