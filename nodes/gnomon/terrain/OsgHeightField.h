// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/HeightField.h>

#include <osg/Matrixd>

#include <optional>
#include <vector>

namespace osg {
class HeightField;
class ShapeDrawable;
} // namespace osg

namespace gnomon {

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

/// Whether a drawable still looks as its shape says: osgUtil::Optimizer moves vertices and forgets the shape.
bool drawsItsShape(const osg::ShapeDrawable& drawable, const osg::HeightField& field);

} // namespace gnomon
