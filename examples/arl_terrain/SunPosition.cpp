// SPDX-License-Identifier: MIT
#include "SunPosition.h"

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace gnomon::examples {

SunPosition sunPosition(double latitude, double declination, double hour) {
    const double phi = glm::radians(latitude), delta = glm::radians(declination),
                 h = glm::radians(15.0 * (hour - 12.0));
    const double east = -std::cos(delta) * std::sin(h);
    const double north = std::sin(delta) * std::cos(phi) - std::cos(delta) * std::sin(phi) * std::cos(h);
    const double up = std::sin(phi) * std::sin(delta) + std::cos(phi) * std::cos(delta) * std::cos(h);
    const double azimuth = glm::degrees(std::atan2(east, north));
    return {azimuth < 0.0 ? azimuth + 360.0 : azimuth, glm::degrees(std::asin(glm::clamp(up, -1.0, 1.0)))};
}

} // namespace gnomon::examples
