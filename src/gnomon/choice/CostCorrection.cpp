// SPDX-License-Identifier: MIT
#include <gnomon/choice/CostCorrection.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon {
namespace {

constexpr std::size_t fewest = 3, kept = 5; // frames

} // namespace

bool CostCorrection::isKnown() const { return _ratios.size() >= fewest; }

bool CostCorrection::add(double measured, double predicted) {
    const double ratio = measured / predicted;
    if (!(measured > 0.0 && predicted > 0.0 && ratio > 0.0 && std::isfinite(ratio))) return false;
    _ratios.push_back(ratio);
    if (_ratios.size() > kept) _ratios.pop_front();
    if (!isKnown()) return false;
    std::vector<double> sorted(_ratios.begin(), _ratios.end());
    std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
    const double now = std::clamp(sorted[sorted.size() / 2], 1.0 / range, range);
    if (std::abs(std::log(now / _factor)) <= std::log(hysteresis)) return false;
    _factor = now;
    return true;
}

} // namespace gnomon
