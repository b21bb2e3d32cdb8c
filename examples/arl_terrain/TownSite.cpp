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

/// Cells from a post on, and how many.
struct Cells {
    unsigned column, row, columns, rows;
};

unsigned cellsAcross(double side, double step) { return static_cast<unsigned>(std::ceil(std::min(side / step, 1e6))); }

/// Steepest slope along an axis less what the square rises to the north; infinite where a height is missing.
double unfitness(const osg::HeightField& field, const Cells& cells) {
    double steepest = 0.0, rise = 0.0;
    for (unsigned row = cells.row; row < cells.row + cells.rows; ++row)
        for (unsigned column = cells.column; column < cells.column + cells.columns; ++column) {
            const float here = field.getHeight(column, row), east = field.getHeight(column + 1, row),
                        north = field.getHeight(column, row + 1);
            if (!isHeight(here) || !isHeight(east) || !isHeight(north)) return std::numeric_limits<double>::infinity();
            const double northward = double(north - here) / double(field.getYInterval());
            steepest =
                std::max({steepest, std::abs(double(east - here) / double(field.getXInterval())), std::abs(northward)});
            rise += northward;
        }
    return steepest - std::min(rise / (cells.columns * cells.rows), worthwhileRise);
}

[[noreturn]] void refuse(const osg::HeightField& field, double side) {
    std::ostringstream sentence;
    sentence << "the elevation model has no place for the town: " << side << " m each way with no height missing, and "
             << "the model, whose unit must be metres, is "
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
