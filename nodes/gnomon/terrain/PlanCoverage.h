// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>

#include <array>
#include <vector>

namespace gnomon {

/// Which cells of a plan some rectangles touch.
///
/// Cost  of a question 4 sums. Memory  64 KB.
class PlanCoverage {
public:
    struct Rect {
        glm::dvec2 low, high;
    };
    explicit PlanCoverage(const std::vector<Rect>& rectangles);

    /// False if none of the rectangles touches it.
    bool touches(const Rect& rectangle) const;

private:
    static constexpr int side = 127;
    struct Cells {
        int fromX, fromY, toX, toY; ///< both ends included.
    };
    Cells cellsOf(const Rect& rectangle) const;

    Rect _all{};
    std::array<unsigned, (side + 1) * (side + 1)> _sums{}; ///< of touched cells to the left and below.
};

} // namespace gnomon
