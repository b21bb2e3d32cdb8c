// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/onterrain/HullTopology.h>

#include <cstddef>

namespace gnomon {

/// Many convex parts in a few blocks of memory, for packedShadows(): a tile of a town, say. Independent of the light; changed
/// only where casters do.
///
/// A part's corners are floats about its first one, which is in double: they are off by 10⁻⁷ of its size at most.
///
/// Cost    a house takes 114 bytes. What add() takes is mostly finding out how the part hangs together.
/// Threads any number may read.
class PackedParts {
public:
    PackedParts() = default;
    explicit PackedParts(const std::vector<ConvexPart>& parts);

    std::size_t size() const { return _anchors.size(); }
    /// At the end.
    void add(const ConvexPart& part);
    /// One of another's, as it is.
    void add(const PackedParts& from, std::size_t part);
    /// The last part takes its place. @param at  below size().
    void remove(std::size_t at);
    std::size_t bytes() const; ///< that are kept, without the topologies, which all share.

    const HullTopology& topology(std::size_t part) const { return *_topologies[_kinds[part]]; }
    const glm::dvec3& anchor(std::size_t part) const { return _anchors[part]; } ///< its first corner.
    /// The other corners, about the anchor.
    const glm::vec3* others(std::size_t part) const { return _others.data() + begin(part); }
    /// Bounds of all corners about their anchors, which are corners, too.
    const glm::vec3& low() const { return _low; }
    const glm::vec3& high() const { return _high; }

private:
    unsigned begin(std::size_t part) const { return part > 0 ? _ends[part - 1] : 0u; }
    void addOther(const glm::vec3& corner);
    void bound(const glm::vec3& corner);
    void makeRoom(std::size_t part, std::size_t corners);
    std::uint16_t kindOf(std::shared_ptr<const HullTopology> topology);
    void forgetUnused();

    std::vector<glm::dvec3> _anchors;
    std::vector<glm::vec3> _others;
    std::vector<unsigned> _ends; ///< one past each part's own of `_others`.
    std::vector<std::uint16_t> _kinds;
    std::vector<std::shared_ptr<const HullTopology>> _topologies;
    glm::vec3 _low{0.0f}, _high{0.0f};
};

} // namespace gnomon
