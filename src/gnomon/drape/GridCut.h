// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/GridDrape.h>

namespace gnomon {

/// Cuts convex polygons along the edges of a grid's triangles. Memory is used again for the next one.
///
/// Cost  a polygon's corners once for each line of the grid that crosses it, and each diagonal.
class GridCut {
public:
    /// @param field    must be there until the next call.
    /// @param polygon  convex, counter-clockwise, in plan, on the grid to rounding.
    /// @return what of it is over cells that are no holes, on the ground's own triangles, in the ground's frame; until the
    ///         next call. Pieces share the corners of their common edges.
    const DrapeMesh& cut(const HeightField& field, const std::vector<glm::dvec3>& polygon);

private:
    using Polygon = std::vector<unsigned>; ///< places in `_places`.

    unsigned add(const glm::dvec2& place);
    template <class Take>
    void slice(Polygon& polygon, int axis, int cells, Polygon& low, const Take& take);
    template <class Side, class Meet>
    void split(const Polygon& polygon, Polygon& low, Polygon& high, const Side& side, const Meet& meet);
    void cutCell(const Polygon& polygon, int x, int y);
    unsigned onLine(unsigned low, unsigned high, int axis, double at);
    void take(const Polygon& polygon, int x, int y, const glm::dvec3& heights);

    const HeightField* _field = nullptr;
    std::vector<glm::dvec2> _places; ///< as HeightField::cellOf() has them.
    std::vector<unsigned> _numbers;  ///< of each place among the mesh's corners, or none.
    std::vector<double> _sides;
    Polygon _polygon, _column, _cell, _low, _high;
    DrapeMesh _mesh;
};

} // namespace gnomon
