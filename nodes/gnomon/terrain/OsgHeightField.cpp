// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Ground.h>
#include <gnomon/terrain/OsgHeightField.h>

#include <osg/Shape>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

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

} // namespace

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
    return HeightField(columns, rows, {origin.x(), origin.y()}, step, std::move(scaled), origin.z());
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

} // namespace gnomon
