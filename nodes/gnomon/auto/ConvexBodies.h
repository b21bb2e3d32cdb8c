// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterDrawables.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <map>
#include <memory>
#include <vector>

namespace gnomon {

/// A convex body, group frame: a connected part of a drawable, or the box about one.
struct ConvexBody {
    std::vector<glm::dvec3> corners;
    std::vector<glm::dvec4> planes; ///< of its faces, outwards; of a plate two.
    bool isPlate() const { return planes.size() == 2; }
};

/// A drawable as bodies.
struct DrawableBodies {
    std::vector<ConvexBody> bodies; ///< its convex parts; else one, the box about it.
    bool convex = true;             ///< all parts that are connected are convex, so that none shadows itself.
    bool looked = true;             ///< else it has too many triangles to be looked at.
};

/// What casts, as bodies: found once for each drawable, and only for those that are asked for.
///
/// Threads one at a time.
class ConvexBodies {
public:
    /// @param of  reads the graph as a cull traversal does, see meshOf().
    const DrawableBodies& of(const CasterDrawable& piece);
    /// Lets go what is not of these, if that is much.
    void keepMostly(const CasterDrawables& casters);

private:
    std::map<osg::ref_ptr<const CasterDrawable>, DrawableBodies> _known;
};

/// True if a caster may stand between a light and any part of a body. Both are convex; it errs towards true.
/// @param light  group frame: w = 0 the way towards a sun, length 1; w = 1 a lamp.
bool mayShadow(const ConvexBody& caster, const ConvexBody& body, const glm::dvec4& light);

} // namespace gnomon
