// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Ground.h>
#include <gnomon/TerrainGround.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/ground/HeightField.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/TriangleGround.h>

#include <glm/common.hpp>
#include <osg/Matrixd>
#include <osg/Shape>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

/// Posts of an osg::HeightField within its border, and where they are. Heights that are none are NaN.
struct OsgHeightField {
    int columns = 0, rows = 0; ///< less than 2 of either: there is no cell.
    double left = 0.0, low = 0.0, columnStep = 0.0, rowStep = 0.0;
    std::vector<float> heights;
    osg::Matrixd rootFromField;

    OsgHeightField(const osg::HeightField& field, const osg::Matrixd& rootFromLocal);

    /// nullopt if they are turned, mirrored in plan, or without a cell.
    std::optional<HeightField> grid() const;
    /// Appends each cell that is no hole, cut as HeightField cuts it.
    void addTo(std::vector<glm::dvec3>& vertices, std::vector<unsigned>& indices) const;

    /// How far off floats may have put a post, in the root's unit.
    double rounding() const;

private:
    std::size_t at(int column, int row) const { return std::size_t(row) * std::size_t(columns) + std::size_t(column); }
    bool isHole(int column, int row) const;
};

/// Field's own frame, which is turned about its origin and moved to it.
osg::Matrixd localFromField(const osg::HeightField& field) {
    return osg::Matrixd::rotate(field.getRotation()) * osg::Matrixd::translate(field.getOrigin());
}

int within(unsigned posts, unsigned border) { return posts / 2 > border ? static_cast<int>(posts - 2 * border) : 0; }

/// Only scales along the axes and moves.
bool keepsAxes(const osg::Matrixd& m) {
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            if (row != column && m(row, column) != 0.0) return false;
    return m(3, 3) == 1.0;
}

OsgHeightField::OsgHeightField(const osg::HeightField& field, const osg::Matrixd& rootFromLocal)
    : columnStep(field.getXInterval()),
      rowStep(field.getYInterval()),
      rootFromField(localFromField(field) * rootFromLocal) {
    const unsigned border = field.getBorderWidth();
    columns = within(field.getNumColumns(), border);
    rows = within(field.getNumRows(), border);
    left = border * columnStep;
    low = border * rowStep;
    heights.reserve(std::size_t(columns) * std::size_t(rows));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const float height = field.getHeight(unsigned(column) + border, unsigned(row) + border);
            heights.push_back(isHeight(height) ? height : std::numeric_limits<float>::quiet_NaN());
        }
}

std::optional<HeightField> OsgHeightField::grid() const {
    const osg::Matrixd& m = rootFromField;
    const osg::Vec3d origin = osg::Vec3d(left, low, 0.0) * m;
    const glm::dvec2 step(columnStep * m(0, 0), rowStep * m(1, 1));
    if (columns < 2 || rows < 2 || !keepsAxes(m) || !(step.x > 0.0 && step.y > 0.0)) return std::nullopt;
    if (!std::isfinite(step.x + step.y + origin.x() + origin.y() + origin.z())) return std::nullopt;
    std::vector<float> scaled = heights;
    for (float& height : scaled) height = static_cast<float>(double(height) * m(2, 2));
    return HeightField({columns, rows, {origin.x(), origin.y()}, step, origin.z()}, std::move(scaled));
}

bool OsgHeightField::isHole(int column, int row) const {
    return !std::isfinite(heights[at(column, row)] + heights[at(column + 1, row)] + heights[at(column, row + 1)] +
                          heights[at(column + 1, row + 1)]);
}

void OsgHeightField::addTo(std::vector<glm::dvec3>& vertices, std::vector<unsigned>& indices) const {
    const std::size_t first = vertices.size();
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const osg::Vec3d post(left + column * columnStep, low + row * rowStep, double(heights[at(column, row)]));
            vertices.push_back(toGlm(post * rootFromField));
        }
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + 1 < columns; ++column) {
            if (isHole(column, row)) continue;
            const auto a = static_cast<unsigned>(first + at(column, row)),
                       d = static_cast<unsigned>(a + unsigned(columns));
            indices.insert(indices.end(), {a, a + 1, d + 1, a, d + 1, d});
        }
}

double OsgHeightField::rounding() const {
    const osg::Matrixd& m = rootFromField;
    const osg::Vec3d first = osg::Vec3d(left, low, 0.0) * m,
                     last = osg::Vec3d(left + columns * columnStep, low + rows * rowStep, 0.0) * m;
    return std::numeric_limits<float>::epsilon() / 2.0 * (last - first).length();
}

/// Whether a drawable still looks as its shape says: osgUtil::Optimizer moves vertices and forgets the shape.
bool drawsItsShape(const osg::ShapeDrawable& drawable, const osg::HeightField& field) {
    const osg::Matrixd matrix = localFromField(field);
    const unsigned columns = field.getNumColumns(), rows = field.getNumRows();
    osg::BoundingBoxd expected;
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column) {
            const osg::Vec3d post(column * double(field.getXInterval()), row * double(field.getYInterval()),
                                  double(field.getHeight(column, row)));
            expected.expandBy(post * matrix);
            const bool rim = row == 0 || column == 0 || row + 1 == rows || column + 1 == columns;
            if (rim) expected.expandBy((post - osg::Vec3d(0.0, 0.0, double(field.getSkirtHeight()))) * matrix);
        }
    const osg::BoundingBox drawn = drawable.computeBoundingBox();
    const double rounding = 1e-5 * expected.radius(); // of floats, with room
    return (osg::Vec3d(drawn._min) - expected._min).length() <= rounding &&
           (osg::Vec3d(drawn._max) - expected._max).length() <= rounding;
}

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
