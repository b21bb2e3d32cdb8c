// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/ground/HeightField.h>

namespace gnomon {

/// Ground on a regular grid, and what is known of blocks of 1, 2 × 2, 4 × 4 … of its cells: lowest and highest point,
/// steepest slope, and how far the block's two triangles are from the ground that they stand for.
///
/// Cost    16 bytes a cell and a third more, beside the field's.
/// Source: M. Duchaineau et al., "ROAMing Terrain: Real-time Optimally Adapting Meshes", IEEE Visualization 1997, for
///         errors nested over a hierarchy.
class HeightPyramid : public Ground {
public:
    explicit HeightPyramid(HeightField field);
    const HeightField& field() const { return _field; }

    std::optional<double> height(double x, double y) const override { return _field.height(x, y); }
    std::optional<glm::dvec3> hit(const glm::dvec3& start, const glm::dvec3& along) const override;
    void cover(const std::vector<glm::dvec4>& planes, double error,
               const std::function<void(const GroundTriangle&, PlaneSet)>& take) const override;
    double steepest(const std::vector<glm::dvec4>& planes) const override;
    TurnedAway turnedAway(const glm::dvec4& light) const override;
    std::optional<GroundRange> range(const glm::dvec2& low, const glm::dvec2& high) const override;
    double steepest() const; ///< of all, infinite if there are holes.
    /// Cells, the last ones included.
    struct Cells {
        int left, low, right, high;
    };
    /// Those that a rectangle touches; nullopt if it is beside the grid. @param low,high  as HeightField::cellOf() has them.
    std::optional<Cells> cells(const glm::dvec2& low, const glm::dvec2& high) const;
    /// How far a block's two triangles are off the ground that they stand for, infinite where they cannot.
    double off(int level, int x, int y) const { return double(node({level, x, y}).off); }
    double steepest(const Cells& cells) const;                                          ///< of those that are no holes.
    bool isHole(int level, int x, int y) const { return node({level, x, y}).isHole(); } ///< all of a block.
    GroundRange range() const; ///< of all; not one of holes alone.
    /// Whether all of the cells that a rectangle touches are less steep than `tangent`, and none of them is a hole.
    /// @param low,high  as HeightField::cellOf() has places; what is beside the grid is left out.
    bool isGentle(const glm::dvec2& low, const glm::dvec2& high, double tangent) const;

private:
    struct Node {
        float low = 1.0f, high = 0.0f; ///< low > high: all of it is a hole.
        float off = 0.0f;              ///< infinite where its triangles cannot stand for it.
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
    Node merged(const Block& block) const;
    float off(const Block& block) const;
    Level levelOver(const Level& below, int level) const;
    /// Goes down from the top wherever `enter` says so.
    template <class Enter>
    void descend(const Block& from, const Enter& enter) const;
    template <class Enter>
    void descend(const Enter& enter) const;
    /// How far a ray goes before it meets the ground, in `along`s; infinite: it does not. Beside its start, that is the
    /// nearest few dozen cells.
    double hitBeside(const glm::dvec3& start, const glm::dvec3& along) const;
    double hitAnywhere(const glm::dvec3& start, const glm::dvec3& along) const;
    double hitAmong(const Cells& cells, double low, double high, const glm::dvec3& start,
                    const glm::dvec3& along) const;
    double hitInCell(int x, int y, const glm::dvec3& start, const glm::dvec3& along) const;
    bool isGentle(const Block& from, const glm::ivec2& low, const glm::ivec2& high, double tangent) const;
    GroundBox boxOf(const Block& block) const;
    /// Goes down where a point may be on the inner side of all planes. @param inside  those that are known to hold all.
    template <class Enter>
    void descendWithin(const Block& from, const std::vector<glm::dvec4>& planes, PlaneSet inside,
                       const Enter& enter) const;
    Block top() const { return {static_cast<int>(_levels.size()) - 1, 0, 0}; }

    const HeightField _field;
    std::vector<Level> _levels; ///< cells first.
};

} // namespace gnomon
