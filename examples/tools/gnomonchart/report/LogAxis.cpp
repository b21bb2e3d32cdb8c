// SPDX-License-Identifier: MIT
#include "LogAxis.h"

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr double air = 1.4; // a factor, at either end

} // namespace

double LogAxis::place(double value) const {
    const double share = std::log(std::clamp(value, low, high) / low) / std::log(high / low);
    return from + share * (to - from);
}

std::vector<double> LogAxis::ticks(std::size_t most) const {
    std::vector<double> all, powers;
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, power);
            if (value < low || value > high) continue;
            all.push_back(value);
            if (digit == 1.0) powers.push_back(value);
        }
    return all.size() > most ? powers : all;
}

LogAxis logAxis(const std::vector<double>& values, double least, double from, double to) {
    double low = 1.0, high = 1.0;
    if (!values.empty()) {
        low = std::max(least, *std::min_element(values.begin(), values.end()));
        high = std::max(low, *std::max_element(values.begin(), values.end()));
    }
    return {low / air, std::max(high * air, 3.0 * low), from, to};
}

} // namespace gnomon::examples
