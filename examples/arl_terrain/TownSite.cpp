// SPDX-License-Identifier: MIT
#include "TownSite.h"

#include <gnomon/TerrainGround.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr double worthwhileRise = 0.1; // to the north, as a slope; more is no better
constexpr unsigned mostTried = 100;    // places along an axis
constexpr unsigned mostLooks = 16;     // along a side of the square
constexpr double mostCells = 1e6;      // along a side of the square

/// Cells from a post on, and how many.
struct Cells {
    unsigned column, row, columns, rows;
};

/// More than any model has where the step is none.
unsigned cellsAcross(double side, double step) {
    return static_cast<unsigned>(std::ceil(step * mostCells > side ? side / step : mostCells));
}

/// What speaks against a square.
struct Slopes {
    double steepest = 0.0, rise = 0.0; ///< along either axis; sum of those to the north.
    unsigned count = 0;

    /// @param east, north  from `here`, as heights and as ways.
    bool take(float here, float east, float north, const glm::dvec2& way) {
        if (!isHeight(here) || !isHeight(east) || !isHeight(north)) return false;
        const double northward = double(north - here) / way.y;
        steepest = std::max({steepest, std::abs(double(east - here) / way.x), std::abs(northward)});
        rise += northward;
        ++count;
        return true;
    }
};

/// Steepest slope less what the square rises to the north; infinite where a height is missing.
double unfitness(const osg::HeightField& field, const Cells& cells) {
    const unsigned right = cells.columns / mostLooks + 1, up = cells.rows / mostLooks + 1;
    const glm::dvec2 way(right * double(field.getXInterval()), up * double(field.getYInterval()));
    Slopes slopes;
    for (unsigned row = cells.row; row + up <= cells.row + cells.rows; row += up)
        for (unsigned column = cells.column; column + right <= cells.column + cells.columns; column += right)
            if (!slopes.take(field.getHeight(column, row), field.getHeight(column + right, row),
                             field.getHeight(column, row + up), way))
                return std::numeric_limits<double>::infinity();
    return slopes.steepest - std::min(slopes.rise / slopes.count, worthwhileRise);
}

[[noreturn]] void refuse(const osg::HeightField& field, double side) {
    std::ostringstream sentence;
    sentence << "the elevation model has no place for the town: " << side
             << " m each way are needed, with no height missing. "
             << "The model, whose unit must be metres, is "
             << (field.getNumColumns() - 1) * double(field.getXInterval()) << " by "
             << (field.getNumRows() - 1) * double(field.getYInterval()) << ".";
    throw std::runtime_error(sentence.str());
}

} // namespace

glm::dvec2 townSite(const osg::HeightField& field, double side) {
    Cells cells{0, 0, cellsAcross(side, field.getXInterval()), cellsAcross(side, field.getYInterval())};
    const Cells first = cells;
    Cells best = cells;
    double least = std::numeric_limits<double>::infinity();
    const unsigned acrossStep = field.getNumColumns() / mostTried + 1, alongStep = field.getNumRows() / mostTried + 1;
    for (cells.row = 0; cells.row + cells.rows < field.getNumRows(); cells.row += alongStep)
        for (cells.column = 0; cells.column + cells.columns < field.getNumColumns(); cells.column += acrossStep)
            if (const double here = unfitness(field, cells); here < least) least = here, best = cells;
    if (!(least < std::numeric_limits<double>::infinity())) refuse(field, side);
    return {(best.column + first.columns / 2.0) * double(field.getXInterval()),
            (best.row + first.rows / 2.0) * double(field.getYInterval())};
}

} // namespace gnomon::examples
