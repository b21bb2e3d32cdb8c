// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/GroundSearch.h>
#include <gnomon/ground/HeightField.h>

namespace gnomon {

/// Ground on a regular grid, and what is known of blocks of 1, 2 × 2, 4 × 4 … of its cells: lowest and highest point, and
/// steepest slope.
///
/// Cost    12 bytes a cell and a third more, beside the field's.
class HeightPyramid : public Ground {
public:
    explicit HeightPyramid(HeightField field);
    const HeightField& field() const { return _field; }

    std::optional<double> height(double x, double y) const override { return _field.height(x, y); }
    std::optional<glm::dvec3> hit(const glm::dvec3& start, const glm::dvec3& along) const override;
    std::optional<GroundRange> range(const glm::dvec2& low, const glm::dvec2& high) const override;

private:
    struct Node {
        float low = 1.0f, high = 0.0f; ///< low > high: all of it is a hole.
        float slope = 0.0f;            ///< steepest; below 0, or -0, where there is a hole in it.

        bool isHole() const { return low > high; }
        bool hasHoles() const;
        double steepest() const;
    };
    struct Level {
        int columns = 0, rows = 0;
        std::vector<Node> nodes;
    };
    struct Block {
        int level, x, y;
        int side() const { return 1 << level; }
        int column() const { return x << level; }
        int row() const { return y << level; }
    };

    const Node& node(const Block& block) const {
        const Level& level = _levels[std::size_t(block.level)];
        return level.nodes[std::size_t(block.y) * std::size_t(level.columns) + std::size_t(block.x)];
    }
    Node cell(int x, int y) const;
    std::pair<double, double> heightsIn(int x, int y, const glm::dvec2& low, const glm::dvec2& high) const;
    Node merged(const Block& block) const;
    Level levelOver(const Level& below, int level) const;
    /// Goes down wherever `enter` says so, which it does not of a cell.
    template <class Enter>
    void descend(const Block& from, const Enter& enter) const;
    GroundBox boxOf(const Block& block) const;
    Block top() const { return {static_cast<int>(_levels.size()) - 1, 0, 0}; }

    const HeightField _field;
    std::vector<Level> _levels; ///< cells first.
};

} // namespace gnomon
