// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon::examples {

/// Where the sun stands. Degrees; azimuth from north through east, elevation from level.
struct SunPosition {
    double azimuth, elevation;
};

/// The sun's centre as seen from the ground, by the spherical triangle of pole, zenith and sun:
///     sin elevation = sin φ sin δ + cos φ cos δ cos H        H = 15° (hour − 12)
/// @param latitude     φ, degrees, north positive, −90 to 90.
/// @param declination  δ, the sun's, degrees, −23.44 (December) to 23.44 (June); 0 at the equinoxes.
/// @param hour         solar time, 0 to 24; 12 when the sun is due south or north.
/// Limits  neither refraction (half a degree at the horizon) nor the equation of time.
SunPosition sunPosition(double latitude, double declination, double hour);

} // namespace gnomon::examples
