// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ConvexHull.h>

#include <array>
#include <cstdint>
#include <memory>

namespace gnomon {

/// How a convex hull hangs together, whatever the places of its corners. All boxes have the same one.
struct HullTopology {
    /// Between two flat faces, counter-clockwise as seen from outside the left one.
    struct Edge {
        unsigned from, to, left, right; ///< `right` is faces.size() where there is no face.
    };

    unsigned corners = 0;
    /// Of each flat face three of its corners, far from one another, counter-clockwise from outside.
    std::vector<std::array<unsigned, 3>> faces;
    std::vector<Edge> edges;
    int front = -1; ///< the face that is ConvexPart::front; -1 if there is none.

    bool isPlate() const { return faces.size() < 3; }
    /// Corners of the rim between what the light meets and what it does not, in order, counter-clockwise as seen from the
    /// light; none if there is none. @param lit  of each face, and false once more.
    void silhouette(const char* lit, std::vector<unsigned>& corners) const;

    /// The same for up to `mostTabled` faces, looked up. @param lit  a bit a face.
    struct Loop {
        const std::uint8_t *begin, *end;
    };
    static constexpr std::size_t mostTabled = 8;
    bool isTabled() const { return !_ends.empty(); }
    Loop silhouette(unsigned lit) const {
        return {_loops.data() + (lit > 0 ? _ends[lit - 1] : 0u), _loops.data() + _ends[lit]};
    }

private:
    friend struct ArrangedHull;
    void tabulate();

    std::vector<std::uint8_t> _loops; ///< of all sets of lit faces.
    std::vector<std::uint16_t> _ends;
};

/// A hull's corners in the order of its topology, without those that are in a face or an edge.
struct ArrangedHull {
    std::shared_ptr<const HullTopology> topology; ///< shared by all hulls that hang together alike.
    std::vector<glm::dvec3> corners;

    /// @param front  a plane of one of the faces, see ConvexPart; nullptr if there is none.
    ///
    /// Threads any number.
    explicit ArrangedHull(const ConvexHull& hull, const glm::dvec4* front = nullptr);
};

} // namespace gnomon
