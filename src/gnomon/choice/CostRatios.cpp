// SPDX-License-Identifier: MIT
#include <gnomon/choice/CostRatios.h>

#include <algorithm>
#include <locale>
#include <sstream>

namespace gnomon {
namespace {

constexpr double most = 1e4;

struct Ratio {
    const char* name;
    double CostRatios::*value;
};

constexpr Ratio ratios[] = {{"call", &CostRatios::call},          {"triangle", &CostRatios::triangle},
                            {"texel", &CostRatios::texel},        {"tap", &CostRatios::tap},
                            {"relit", &CostRatios::relit},        {"filled", &CostRatios::filled},
                            {"processor", &CostRatios::processor}};

constexpr const char* testsName = "tests";

bool isUsable(double ratio) { return ratio >= 1.0 / most && ratio <= most; }

} // namespace

CostRates CostRatios::rates() const {
    CostRates result;
    result.call *= call;
    result.triangle *= triangle;
    result.texel *= texel;
    result.pixel *= tap;
    result.tap *= tap;
    result.relit *= relit;
    result.filled *= filled;
    result.ray *= processor;
    result.object *= processor;
    return result;
}

std::string CostRatios::text() const {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(6);
    for (const Ratio& ratio : ratios) out << ratio.name << ' ' << this->*ratio.value << '\n';
    out << testsName << ' ' << tests << '\n';
    return out.str();
}

std::optional<CostRatios> CostRatios::parse(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    CostRatios result;
    for (const Ratio& ratio : ratios) {
        std::string name;
        double value = 0.0;
        if (!(in >> name >> value) || name != ratio.name || !isUsable(value)) return std::nullopt;
        result.*ratio.value = value;
    }
    std::string name, more;
    unsigned tests = 0;
    if (!(in >> name >> tests) || name != testsName || tests < 1 || tests > enoughTests || in >> more)
        return std::nullopt;
    result.tests = tests;
    return result;
}

CostRatios CostRatios::clamped() const {
    CostRatios result = *this;
    for (const Ratio& ratio : ratios) {
        double& value = result.*ratio.value;
        value = value > 0.0 ? std::clamp(value, 1.0 / most, most) : 1.0;
    }
    return result;
}

CostRatios CostRatios::leastWith(const CostRatios& other) const {
    CostRatios result;
    for (const Ratio& ratio : ratios) result.*ratio.value = std::min(this->*ratio.value, other.*ratio.value);
    result.tests = std::min(tests + other.tests, enoughTests);
    return result;
}

} // namespace gnomon
