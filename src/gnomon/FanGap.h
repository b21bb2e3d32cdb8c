// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeightField.h>

#include <vector>

namespace gnomon {

/// How far a fan, flat between its own corners, goes below and above the ground.
///
/// Between the lines and the diagonals of a grid both are flat: the gap is widest at a corner of what cutting the fan along
/// them leaves, or where an edge within the fan crosses one of them.
///
/// Memory is used again for the next one.
class FanGap {
public:
    /// @param fan  corners of a polygon of which the first sees all others, counter-clockwise in plan, in the ground's
    ///             frame; its triangles are 0, i, i + 1.
    void begin(const HeightField& field, const std::vector<glm::dvec3>& fan);
    /// @param onGround  a place in the fan.
    void take(const glm::dvec3& onGround) { take(heightAt(onGround) - onGround.z); }
    /// Where the fan's triangles meet. There must be ground.
    void takeInnerEdges();

    /// False of a fan that goes half around its first corner or more: then what is said of it is not right.
    bool isKnown() const;
    double below() const { return _below; } ///< 0 or more, as is the next.
    double above() const { return _above; }

private:
    struct Triangle {
        glm::dvec2 second; ///< its last edge about the first corner.
        glm::dvec2 slope;
    };
    double heightAt(const glm::dvec3& place) const;
    void takeCrossings(const glm::dvec3& to, double from, double step);
    void take(double over);

    const HeightField* _field = nullptr;
    std::vector<glm::dvec3> _fan;
    std::vector<Triangle> _triangles;
    double _below = 0.0, _above = 0.0;
};

} // namespace gnomon
