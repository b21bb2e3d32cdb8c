// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/Caster.h>
#include <gnomon/casters/CasterMesh.h>

#include <osg/BoundingBox>
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osg/ref_ptr>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>

namespace gnomon {

/// What was read of drawables before: the casters under LODs that were met lately, so that a level that comes back is not
/// extracted again; and each body once, in its own frame, however many places it has.
///
/// Cost
/// - 12 bytes a triangle and 12 a vertex of each body.
/// - The triangles of levels that no view has now: as many as three times those that are seen, or a million.
/// Threads
/// - One at a time. The owner locks.
class KnownCasters {
public:
    /// Of a caster under an LOD; null if it is not known.
    const Caster* find(std::uint64_t fingerprint) const;
    void add(const Caster& piece);
    /// A visit of the graph begins.
    void startVisit() { ++_visit; }

    /// A piece that is a body, at its place. Reads the graph where the geometry is not known.
    /// @param origin  of the scene, group frame.
    /// @return nullopt if its frame leaves out other triangles than the group's.
    std::optional<PlacedMesh> placed(const Caster& piece, const osg::Vec3d& origin);
    /// The bounds of a body that is known, at a place; invalid if it is not known. @param triangles  gets their number.
    osg::BoundingBoxd boundsOf(std::uint64_t geometry, const osg::Matrixd& groupFromLocal,
                               std::size_t& triangles) const;

    /// Drops levels that are in no graph any more, and those met longest ago if there is too much.
    void pruneLevels();
    /// Drops bodies that no piece is any more.
    void pruneBodies();
    void clear();

private:
    struct Level {
        osg::ref_ptr<const Caster> piece;
        unsigned lastVisit;
    };
    std::unordered_map<std::uint64_t, Level> _levels;                          ///< by Caster::fingerprint.
    std::unordered_map<std::uint64_t, osg::ref_ptr<const CasterMesh>> _bodies; ///< by Caster::geometry.
    unsigned _visit = 0;
};

} // namespace gnomon
