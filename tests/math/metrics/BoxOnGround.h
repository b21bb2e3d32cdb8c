// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <metrics/ShadowMetrics.h>

namespace gnomon::test {

/// A box on level ground seen from straight above, 128 x 96 px of 0.05 m, its shadow worked by hand.
///
/// The sun stands at 45 degrees in the west (-x). The box covers columns 20 to 39 and rows 32 to 63; its shadow on the
/// ground ends at 70.2 px, so that columns 40 to 69 are in shadow and column 70 in part: T_a = 0.75, one of its four
/// columns of rays. R leaves out column 40, beside the box. Of Rc then 29 x 32 = 928 pixels are shadowed, and 6 x 32 =
/// 192, columns 41 to 46, are at contact: t_b = (x - 2 m) √2 < 0.5 m.
struct BoxOnGround {
    glm::dvec2 camera{0.0}; ///< px by which the camera looks farther right and up.
    double lowering = 0.0;  ///< px by which a lower sun makes the shadow longer.

    metrics::TruthMaps truth() const;
    /// The camera's matrix for truth().position.
    glm::dmat4 clipFromPosition() const;

    static constexpr int width = 128, height = 96;
    static constexpr double pixel = 0.05; ///< m
    static constexpr int ground = 1, roof = 2;
    static constexpr std::size_t shadowed = 928, contact = 192, edge = 32;
};

/// V of a picture that is true.
inline metrics::Picture perfect() { return BoxOnGround().truth().lit; }

/// Every pixel (x, y) by a function of it.
metrics::Picture picture(int width, int height, const std::function<double(int x, int y)>& value);

/// A picture whose columns [x, x + w) of rows [y, y + h) are `value`.
metrics::Picture filled(metrics::Picture picture, int x, int y, int w, int h, double value);

/// Metrics of a visibility against the box's truth.
metrics::ShadowMetrics measured(const metrics::Picture& visibility, const metrics::TruthMaps& truth);
metrics::ShadowMetrics measured(const metrics::Picture& visibility);

} // namespace gnomon::test
