// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/GroundIntersection.h>

#include <optional>

namespace gnomon {

/// Finds out whether a triangle is turned away from a light, and how far the light may move until that changes. A ground
/// gives it boxes first, and the triangles of those that matter.
class TurnedAwaySearch {
public:
    explicit TurnedAwaySearch(const glm::dvec4& light);

    /// False if the triangles inside of a box, up to this slope, need not be given.
    bool enter(const GroundBox& box, double slope);
    void take(const GroundTriangle& triangle);
    const TurnedAway& result() const { return _result; }

private:
    glm::dvec3 towards(const glm::dvec3& from) const { return glm::dvec3(_light) - _light.w * from; }

    const glm::dvec4 _light; ///< a unit direction or a place.
    TurnedAway _result;
};

/// Whether a triangle of one ground is turned away from a light that moves.
///
/// Cost  of a light that moves on: a subtraction, as long as it moves by less than the last search found out.
class FollowedTurn {
public:
    bool isTurnedAway(const Ground& ground, const glm::dvec4& light);
    void groundChanged() { _last = std::nullopt; }
    unsigned searches() const { return _searches; }

private:
    std::optional<TurnedAway> _last;
    glm::dvec4 _light{0.0}; ///< of the last search.
    unsigned _searches = 0;
};

} // namespace gnomon
