// SPDX-License-Identifier: MIT
#include <gnomon/choice/ShadowWork.h>

#include <algorithm>
#include <iterator>

namespace gnomon {
namespace {

struct Kind {
    double ShadowWork::*count;
    double CostRates::*rate;
};

constexpr Kind kinds[] = {{&ShadowWork::calls, &CostRates::call},    {&ShadowWork::triangles, &CostRates::triangle},
                          {&ShadowWork::texels, &CostRates::texel},  {&ShadowWork::pixels, &CostRates::pixel},
                          {&ShadowWork::taps, &CostRates::tap},      {&ShadowWork::relit, &CostRates::relit},
                          {&ShadowWork::filled, &CostRates::filled}, {&ShadowWork::rays, &CostRates::ray},
                          {&ShadowWork::objects, &CostRates::object}};

} // namespace

bool CostRates::operator==(const CostRates& other) const {
    return std::all_of(std::begin(kinds), std::end(kinds),
                       [&](const Kind& kind) { return this->*kind.rate == other.*kind.rate; });
}

ShadowWork& ShadowWork::operator+=(const ShadowWork& other) {
    for (const Kind& kind : kinds) this->*kind.count += other.*kind.count;
    return *this;
}

ShadowWork operator*(double share, ShadowWork work) {
    for (const Kind& kind : kinds) work.*kind.count *= share;
    return work;
}

double timeOf(const ShadowWork& work, const CostRates& rates) {
    double time = 0.0;
    for (const Kind& kind : kinds) time += work.*kind.count * rates.*kind.rate;
    return time;
}

} // namespace gnomon
