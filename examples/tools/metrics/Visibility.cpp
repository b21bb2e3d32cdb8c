// SPDX-License-Identifier: MIT
#include <glm/geometric.hpp>
#include <metrics/Visibility.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::metrics {
namespace {

constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

double measure(double a, double b, double s, Visibility& tally) {
    const bool finite = std::isfinite(a) && std::isfinite(b) && std::isfinite(s);
    const bool contrast = b - s >= leastContrast;
    const double v = finite && contrast ? (a - s) / (b - s) : unmeasured;
    if (finite && !contrast)
        ++tally.lowContrast;
    else if (!std::isfinite(v))
        ++tally.notFinite;
    return std::isfinite(v) ? v : unmeasured;
}

/// Root of a mean of squares.
struct RootMeanSquare {
    double sum = 0.0;
    std::size_t count = 0;

    void add(double square) {
        sum += square;
        ++count;
    }
    std::optional<double> value() const {
        return count ? std::optional(std::sqrt(sum / static_cast<double>(count))) : std::nullopt;
    }
};

constexpr int box = 4; // px

/// Mean of the box whose lower left pixel is (x, y).
template <typename T>
double boxMean(const Grid<T>& grid, int x, int y) {
    double sum = 0.0;
    for (int i = 0; i < box * box; ++i) sum += static_cast<double>(grid.at(x + i % box, y + i / box));
    return sum / (box * box);
}

} // namespace

Visibility visibility(const Picture& casting, const Picture& notCasting, const Picture& shadowed) {
    Visibility result;
    result.value = Picture(casting.width, casting.height);
    for (std::size_t i = 0; i < casting.cells.size(); ++i)
        result.value.cells[i] = measure(casting.cells[i], notCasting.cells[i], shadowed.cells[i], result);
    return result;
}

IntensityError intensityError(const Picture& visibility, const Picture& lit, const Mask& facing) {
    RootMeanSquare all, penumbra;
    for (std::size_t i = 0; i < facing.cells.size(); ++i) {
        if (!facing.cells[i]) continue;
        const double t = lit.cells[i], error = visibility.cells[i] - t;
        all.add(error * error);
        if (t > 0.02 && t < 0.98) penumbra.add(error * error);
    }
    return {all.value(), penumbra.value()};
}

IntensityError thinIntensityError(const Picture& visibility, const Picture& lit, const Mask& facing) {
    const int width = std::max(0, facing.width - box + 1), height = std::max(0, facing.height - box + 1);
    Picture shown(width, height), truth(width, height);
    Mask whole(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            whole.at(x, y) = boxMean(facing, x, y) == 1.0;
            shown.at(x, y) = boxMean(visibility, x, y);
            truth.at(x, y) = boxMean(lit, x, y);
        }
    return intensityError(shown, truth, whole);
}

std::optional<double> shadedError(const Grid<glm::dvec3>& picture, const Grid<glm::dvec3>& truth, const Mask& within) {
    RootMeanSquare all;
    for (std::size_t i = 0; i < within.cells.size(); ++i) {
        const glm::dvec3 error = picture.cells[i] - truth.cells[i];
        const double square = glm::dot(error, error) / 3.0;
        if (within.cells[i] && std::isfinite(square)) all.add(square);
    }
    return all.value();
}

} // namespace gnomon::metrics
