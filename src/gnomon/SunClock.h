// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace gnomon {

/// Position of the sun in the sky, degrees.
struct SunPosition {
    double azimuth;   ///< From north through east, 0 … 360.
    double elevation; ///< Above the horizon.
};

/// Converts a moment, "2026-06-21T15:00:00Z", to a Julian day, UTC. Seconds may have decimals.
/// @return nullopt if there is no such moment.
GNOMON_EXPORT std::optional<double> julianDay(const std::string& moment);

/// Converts a Julian day, UTC, to a moment, to the nearest second: "2026-06-21T15:00:00Z".
GNOMON_EXPORT std::string momentOf(double julianDay);

/// Computes the sun's position for a place on earth at any time.
///
/// Use it to light a scene as on a given day. Pass towards() as a light with w = 0 to ShadowLight.
///
///     const gnomon::SunClock clock(36.6, -84.3);
///     const glm::dvec3 towards = clock.towards(*gnomon::julianDay("2026-06-21T15:00:00Z"));
///
/// Cost
/// - Microseconds a moment.
/// Needs
/// - libnova: see OptionalPart::Sun. No OpenGL.
/// Limits
/// - The error is below a hundredth of a degree from 1900 to 2100.
/// - Refraction is that of air at 10 °C and 1010 mbar, at sea level.
/// Threads
/// - One at a time: libnova keeps its last results.
/// Source
/// - VSOP87 and J. Meeus, "Astronomical Algorithms", 1991, by libnova.
/// - Refraction: G. G. Bennett, 1982.
class GNOMON_EXPORT SunClock {
public:
    /// A clock for one place.
    /// @param latitude,longitude  degrees, north and east positive, -90 … 90 and -180 … 180.
    /// @throws std::invalid_argument with one sentence if either is out of range.
    /// @throws std::runtime_error with one sentence if libnova is missing.
    SunClock(double latitude, double longitude);

    /// Apparent position of the sun's centre. Refraction raises it by half a degree at the horizon.
    SunPosition at(double julianDay) const;
    /// Apparent direction towards the sun, unit length: x east, y north, z up.
    glm::dvec3 towards(double julianDay) const;

    /// Latitude, degrees.
    double latitude() const { return _latitude; }
    /// Longitude, degrees.
    double longitude() const { return _longitude; }

private:
    double _latitude, _longitude;
};

} // namespace gnomon
