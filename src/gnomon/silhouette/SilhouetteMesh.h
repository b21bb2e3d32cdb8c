// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace gnomon {

/// Triangles as shadow volumes need them: which share an edge, in connected parts. Found once a mesh, for all lights.
///
/// Vertices of exactly the same position are one, and those along open edges that differ by rounding. Any mesh will do:
/// open, of mixed winding, with edges of three triangles.
/// Triangles with two corners in one place are left out: nothing is lost, for their edges cancel.
///
/// Cost
/// - 32 bytes a triangle for its plane, 16 an edge. Linear in the triangles, but for a sort of the parts.
/// Source
/// - B. Kim, K. Kim, G. Turk, "A Shadow-Volume Algorithm for Opaque and Transparent Nonmanifold Casters", 2008.
struct SilhouetteMesh {
    static constexpr unsigned noTriangle = ~0u;

    /// An edge that `left` passes from `from` to `to`, and `right` back. Where more than two meet there are several.
    struct Edge {
        unsigned from, to;    ///< in `vertices`.
        unsigned left, right; ///< triangles; the number of triangles stands for none.
    };
    /// Triangles that are connected by edges, one after the other; edges likewise.
    struct Part {
        unsigned firstTriangle, triangles, firstEdge, edges;
        bool closed;         ///< each edge is passed as often one way as the other.
        bool inward;         ///< closed, and turned inside out.
        glm::vec3 low, high; ///< bounds.
        std::uint8_t kinds;  ///< of its triangles, those of all.
        bool smooth;         ///< some of its vertices have an offset.

        bool boundsHold(const glm::dvec3& place) const;
    };

    /// What it is made from, in the caller's memory.
    struct Source {
        const glm::vec3* positions = nullptr; ///< finite.
        std::size_t count = 0;
        const unsigned* corners = nullptr; ///< three a triangle, counter-clockwise from its front.
        std::size_t cornerCount = 0;
        const std::uint8_t* kinds = nullptr; ///< bits for each triangle, whose meaning is the caller's; null: 0.
        const glm::vec4* offsets = nullptr;  ///< by vertex, see terminatorOffsets(); null: 0.
    };
    SilhouetteMesh() = default;
    explicit SilhouetteMesh(const Source& source);

    std::size_t triangles() const { return planeD.size(); }

    std::vector<glm::vec3> vertices; ///< each place once.
    std::vector<glm::vec4> offsets;  ///< of each, see terminatorOffsets(); empty if there are none.
    glm::vec3 low{0.0f}, high{0.0f}; ///< bounds of all parts.
    std::vector<unsigned> corners;   ///< three a triangle.
    std::vector<Edge> edges;
    std::vector<Part> parts; ///< neighbours in space are neighbours here, as far as a curve can.
    /// Planes of the triangles, in double: unit normal and distance; all 0 without an area.
    std::vector<double> planeX, planeY, planeZ, planeD;
    /// Triangles so thin that their planes say nothing face as the triangle beyond their longest edge does.
    struct Thin {
        unsigned triangle, like;
    };
    std::vector<Thin> thin;
};

} // namespace gnomon
