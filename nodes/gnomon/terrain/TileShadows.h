// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/onterrain/PackedShadows.h>
#include <gnomon/terrain/CasterParts.h>
#include <gnomon/terrain/TileMesh.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <osg/Referenced>

namespace gnomon {

/// The shadows of a tile of casters. Whoever holds it may read: it is never changed while somebody else does.
struct TileShadows : public osg::Referenced {
    PackedShadows found;
    OutcomeCounts outcomes;
    glm::dvec4 light{0.0};                 ///< that they were found with.
    osg::ref_ptr<TileMesh> decals, prisms; ///< what shows them together; null if nobody draws them.
    glm::dvec2 low{0.0}, high{0.0};        ///< bounds in plan, about the origin; low > high if there is no shadow.
    double widest = 0.0;                   ///< diameter of the largest shadow.
    double slope = 0.0;                    ///< of the ground under the decals, where it is steepest.

protected:
    ~TileShadows() override = default;
};

} // namespace gnomon
