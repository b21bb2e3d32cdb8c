// SPDX-License-Identifier: MIT
#include <metrics/Visibility.h>

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

} // namespace

Visibility visibility(const Picture& casting, const Picture& notCasting, const Picture& shadowed) {
    Visibility result;
    result.value = Picture(casting.width, casting.height);
    for (std::size_t i = 0; i < casting.cells.size(); ++i)
        result.value.cells[i] = measure(casting.cells[i], notCasting.cells[i], shadowed.cells[i], result);
    return result;
}

} // namespace gnomon::metrics
