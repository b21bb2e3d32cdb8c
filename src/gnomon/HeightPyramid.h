// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeightField.h>

#include <functional>
#include <glm/vec4.hpp>

namespace gnomon {

/// What is known of blocks of 1, 2 × 2, 4 × 4 … cells of a height field: lowest and highest point, steepest slope, and how
/// far the block's two triangles are from the ground that they stand for.
///
/// Cost    16 bytes a cell and a third more; building some 10 ns a post and level.
/// Threads any number, once built.
/// Source: M. Duchaineau et al., "ROAMing Terrain: Real-time Optimally Adapting Meshes", IEEE Visualization 1997, for
///         errors nested over a hierarchy.
class HeightPyramid {
public:
    /// @param field  kept by reference; must outlive the pyramid.
    explicit HeightPyramid(const HeightField& field);

    /// Triangles that stand for the ground to within `error` of its height, each point of it once in plan, wherever a
    /// point of them may be on the inner side of all `planes` (unit normals); others may be left out.
    /// @param error  scene's unit; 0 gives the ground's own triangles.
    void cover(const std::vector<glm::dvec4>& planes, double error,
               const std::function<void(const GroundTriangle&)>& take) const;
    /// Where a ray meets the ground first, from either side. @param along  any length but 0; the ray has no end.
    std::optional<glm::dvec3> hit(const glm::dvec3& start, const glm::dvec3& along) const;
    /// Tangent of the steepest slope where the ground may be on the inner side of all planes; 0 if it is nowhere.
    double steepest(const std::vector<glm::dvec4>& planes) const;

private:
    struct Node {
        float low = 1.0f, high = 0.0f; ///< low > high: all of it is a hole.
        float off = 0.0f;              ///< infinite where its triangles cannot stand for it.
        float slope = 0.0f;
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

    const Node& node(const Block& block) const;
    Node cell(int x, int y) const;
    Node merged(const Block& block) const;
    float off(const Block& block) const;
    Level levelOver(const Level& below, int level) const;
    /// Goes down from the top wherever `enter` says so.
    void descend(const Block& from, const std::function<bool(const Block&)>& enter) const;
    void descend(const std::function<bool(const Block&)>& enter) const;
    bool mayHold(const Block& block, const std::vector<glm::dvec4>& planes) const;
    /// The block's box: its lowest corner and its size.
    std::pair<glm::dvec3, glm::dvec3> boxOf(const Block& block) const;

    const HeightField& _field;
    std::vector<Level> _levels; ///< cells first.
};

} // namespace gnomon
