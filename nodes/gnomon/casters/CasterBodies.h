// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawable.h>
#include <gnomon/casters/CasterMesh.h>

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// A geometry in its own frame, and what it was read from: held, so that no later array can stand at the same place.
struct CasterBody : public osg::Referenced {
    osg::ref_ptr<const CasterMesh> mesh;
    std::vector<osg::ref_ptr<const osg::Referenced>> sources;

protected:
    ~CasterBody() override = default;
};

/// Drawables that move as a whole: each geometry once, in its own frame, however many places it has.
///
/// Cost
/// - 12 bytes a triangle and 12 a vertex of each geometry.
/// Threads
/// - One at a time. The owner locks.
class CasterBodies {
public:
    /// Drawables with fewer triangles are joined: to draw them apart would cost more than to make them again.
    static constexpr std::size_t fewestTriangles = 256;

    /// True if a piece can be a body: large enough, of all its triangles, and not flattened by its transform.
    static bool isBody(const CasterDrawable& piece);

    /// A piece that can be a body, at its place. Reads the graph where the geometry is not known.
    /// @param origin  of the scene, group frame.
    /// @return nullopt if its frame leaves out other triangles than the group's.
    std::optional<PlacedMesh> placed(const CasterDrawable& piece, const osg::Vec3d& origin);
    /// The bounds of a geometry that is known, at a place; invalid if it is not known. @param triangles  gets their number.
    osg::BoundingBoxd boundsOf(std::uint64_t geometry, const osg::Matrixd& groupFromLocal,
                               std::size_t& triangles) const;
    /// Lets go what no piece is any more.
    void prune();
    void clear() { _known.clear(); }

private:
    std::unordered_map<std::uint64_t, osg::ref_ptr<const CasterBody>> _known; ///< by CasterDrawable::geometry.
};

} // namespace gnomon
