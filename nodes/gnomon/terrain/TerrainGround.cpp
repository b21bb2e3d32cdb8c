// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/TerrainGround.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/ground/GridFromTriangles.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/TriangleGround.h>
#include <gnomon/terrain/OsgHeightField.h>

#include <osg/Shape>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace gnomon {
namespace {

/// The height field that a drawable shows; null if it shows something else.
const osg::HeightField* fieldOf(const osg::Drawable& drawable) {
    const auto* shape = dynamic_cast<const osg::ShapeDrawable*>(&drawable);
    const auto* field = shape ? dynamic_cast<const osg::HeightField*>(shape->getShape()) : nullptr;
    return field && drawsItsShape(*shape, *field) ? field : nullptr;
}

/// Takes height fields by their posts and all else by its triangles.
class TerrainTraverser : public CasterExtraction {
public:
    using CasterExtraction::CasterExtraction;
    const std::vector<OsgHeightField>& fields() const { return _fields; }

protected:
    void applyCaster(osg::Drawable& drawable, const Casting& casting) override {
        if (const osg::HeightField* field = fieldOf(drawable))
            _fields.emplace_back(*field, rootFromLocal());
        else
            CasterExtraction::applyCaster(drawable, casting);
    }

private:
    std::vector<OsgHeightField> _fields;
};

/// Of coordinates that came through matrices and sums of a few terms.
double roundingOf(const std::vector<glm::dvec3>& vertices) {
    glm::dvec3 most(0.0);
    for (const glm::dvec3& vertex : vertices) most = glm::max(most, glm::abs(vertex));
    return 16.0 * std::numeric_limits<double>::epsilon() * std::max({most.x, most.y, most.z});
}

/// @param rounding  of the vertices as they were drawn.
std::shared_ptr<const Ground> groundOf(const std::vector<OsgHeightField>& fields, std::vector<glm::dvec3> vertices,
                                       std::vector<unsigned> indices, double rounding) {
    if (fields.size() == 1 && indices.empty())
        if (auto grid = fields.front().grid()) return std::make_shared<HeightPyramid>(std::move(*grid));
    for (const OsgHeightField& field : fields) {
        field.addTo(vertices, indices);
        rounding = std::max(rounding, field.rounding());
    }
    // A post and its place, both rounded, from two vertices each.
    if (auto grid = gridOf(vertices, indices, 4.0 * rounding + roundingOf(vertices)))
        return std::make_shared<HeightPyramid>(std::move(*grid));
    return std::make_shared<TriangleGround>(std::move(vertices), indices);
}

} // namespace

std::shared_ptr<const Ground> groundOf(osg::Node& root, const Selection& terrain, const osg::Matrixd& groundFromRoot) {
    TerrainTraverser found(terrain);
    found.setRootFromVisited(groundFromRoot);
    root.accept(found);
    std::vector<glm::dvec3> vertices;
    vertices.reserve(found.getVertices().size());
    for (const osg::Vec3d& vertex : found.getVertices()) vertices.push_back(toGlm(vertex));
    return groundOf(found.fields(), std::move(vertices), found.getTriangles(), found.getRounding());
}

std::shared_ptr<const Ground> groundOf(const osg::HeightField& field) {
    return groundOf({OsgHeightField(field, osg::Matrixd::identity())}, {}, {}, 0.0);
}

} // namespace gnomon
