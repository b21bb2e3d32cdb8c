// SPDX-License-Identifier: MIT
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/mapfit/CascadeSplits.h>

#include <algorithm>

namespace gnomon {
namespace {

static_assert(ShadowMapOptions::mostCascades == mostCascades);

double within(double value, double most) { return value > 0.0 ? std::min(value, most) : 0.0; }

/// The value if it is one of its kind, whose last is given; else the default.
template <typename Kind>
Kind known(Kind value, Kind last, Kind byDefault) {
    return value >= 0 && value <= last ? value : byDefault;
}

} // namespace

ShadowMapOptions ShadowMapOptions::usable() const {
    const ShadowMapOptions fresh;
    ShadowMapOptions options;
    options.size = std::clamp(size, leastSize, mostSize);
    options.filter = known(filter, FINE, fresh.filter);
    options.cascades = std::clamp(cascades, 0, mostCascades);
    options.edges = known(edges, SOFT, fresh.edges);
    options.sunAngle = within(sunAngle, mostAngle);
    options.lampSize = within(lampSize, mostLength);
    options.radius = within(radius, mostLength);
    options.view = known(view, CASCADES, fresh.view);
    options.programUnit = known(programUnit, mostUnit, fresh.programUnit);
    return options;
}

} // namespace gnomon
