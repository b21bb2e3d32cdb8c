// SPDX-License-Identifier: MIT
#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double step = 0.1; // of t, a frame
constexpr double mostAmplitude = 999.0;

} // namespace

void HaloPulse::setAmplitude(double amplitude) {
    if (std::isnan(amplitude)) {
        OSG_WARN << "gnomon: HaloPulse::setAmplitude(): NaN is refused. Give an amplitude from 0 to 999." << std::endl;
        return;
    }
    _amplitude = std::clamp(amplitude, 0.0, mostAmplitude);
}

bool HaloPulse::run(osg::Object* object, osg::Object* data) {
    auto* halo = dynamic_cast<HaloNode*>(object);
    if (_running && halo) {
        _time += step;
        const double scale = 1.0 + _amplitude * std::sin(_time);
        _running = scale > 1.0;
        halo->setScale(scale);
    }
    return traverse(object, data);
}

} // namespace gnomon
