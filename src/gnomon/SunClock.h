// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace gnomon {

/// Where the sun stands. Degrees; azimuth from north through east, 0 to 360, elevation above level.
struct SunPosition {
    double azimuth, elevation;
};

/// The Julian day, UTC, of "2026-06-21T15:00:00Z"; nullopt if there is no such moment. Seconds may have decimals.
std::optional<double> julianDay(const std::string& moment);

/// The other way, to the second: "2026-06-21T15:00:00Z".
std::string momentOf(double julianDay);

/// Where the sun is seen from one place on earth, at any time.
///
///     const gnomon::SunClock clock(36.6, -84.3);
///     const glm::dvec3 towards = clock.towards(*gnomon::julianDay("2026-06-21T15:00:00Z"));
///
/// Cost    some 20 microseconds a moment.
/// Limits  good to a hundredth of a degree from 1900 to 2100; the air is that of 10 degrees Celsius and 1010 mbar at sea level.
/// Threads one at a time: libnova keeps its last results.
/// Source: VSOP87 and J. Meeus, "Astronomical Algorithms", 1991, by libnova; refraction by G. G. Bennett, 1982.
class SunClock {
public:
    /// @param latitude,longitude  degrees, north and east positive, -90 to 90 and -180 to 180.
    /// @throws std::invalid_argument, one sentence, for any other.
    SunClock(double latitude, double longitude);

    /// Its centre as it is seen: raised by the air's refraction, half a degree at the horizon.
    SunPosition at(double julianDay) const;
    /// The way towards it, unit length; x east, y north, z up.
    glm::dvec3 towards(double julianDay) const;

    double latitude() const { return _latitude; }
    double longitude() const { return _longitude; }

private:
    double _latitude, _longitude;
};

} // namespace gnomon
