// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/drape/BoxShadow.h>
#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/onterrain/TerrainShadow.h>

#include <osg/BoundingBox>

#include <array>
#include <set>
#include <string>
#include <vector>

namespace gnomon {

/// Convex parts of casters, group frame. @param terrain  drawables that are left out.
std::vector<ConvexPart> partsOf(const CasterMesh& mesh, const std::set<const osg::Drawable*>& terrain = {});
/// What BOX takes for objects. @param box  of each of them; invalid: that of its points.
std::vector<BoxCaster> boxCastersOf(const CasterMesh& mesh, const std::set<const osg::Drawable*>& terrain = {},
                                    const osg::BoundingBoxd& box = {});

TerrainShadow boxShadowOf(const Ground& ground, const BoxCaster& caster, const glm::dvec4& light);

/// How often shadows came out how.
class OutcomeCounts {
public:
    void add(TerrainOutcome outcome) { ++_counts[static_cast<std::size_t>(outcome)]; }
    void add(const OutcomeCounts& other);
    /// What people should know: a sentence for each outcome that is not what was asked for.
    std::vector<std::string> causes() const;

private:
    std::array<std::size_t, static_cast<std::size_t>(TerrainOutcome::noGround) + 1> _counts{};
};

} // namespace gnomon
