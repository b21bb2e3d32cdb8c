// SPDX-License-Identifier: MIT
#include <gnomon/SunClock.h>

#include <glm/trigonometric.hpp>

#include <libnova/julian_day.h>
#include <libnova/precession.h>
#include <libnova/refraction.h>
#include <libnova/solar.h>
#include <libnova/transform.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr double secondsADay = 86400.0;
constexpr double pressure = 1010.0, temperature = 10.0; // mbar and degrees Celsius, as almanacs have it
constexpr double lowest = -1.0; // degrees: what is lower is not seen, and the formula has a pole there

bool isThere(const ln_date& date) {
    if (!(date.hours >= 0 && date.hours < 24 && date.minutes >= 0 && date.minutes < 60)) return false;
    if (!(date.seconds >= 0.0 && date.seconds < 60.0) || date.months < 1 || date.months > 12) return false;
    ln_date day = date, same;
    day.hours = 12;
    day.minutes = 0;
    day.seconds = 0.0;
    ln_get_date(ln_get_julian_day(&day), &same); // of 30 February it makes 2 March
    return same.days == date.days && same.months == date.months && same.years == date.years;
}

/// Degrees. The air's refraction is known for the elevation that is seen: so that is found by steps, each of which is at most a
/// fifth as wrong as the one before.
double seenElevation(double elevation) {
    if (!(elevation > lowest)) return elevation;
    double seen = std::max(elevation, 0.0);
    for (int step = 0; step < 8; ++step) seen = elevation + ln_get_refraction_adj(seen, pressure, temperature);
    return seen;
}

/// libnova gives the place among the stars of the year 2000; the sky has turned since.
ln_equ_posn sunOfDate(double julianDay) {
    ln_equ_posn of2000, ofDate;
    ln_get_solar_equ_coords(julianDay, &of2000);
    ln_get_equ_prec(&of2000, julianDay, &ofDate);
    return ofDate;
}

} // namespace

std::optional<double> julianDay(const std::string& moment) {
    ln_date date{};
    char zone = 0;
    int end = 0;
    const int read = std::sscanf(moment.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf%c%n", &date.years, &date.months, &date.days,
                                 &date.hours, &date.minutes, &date.seconds, &zone, &end);
    if (read != 7 || zone != 'Z' || std::size_t(end) != moment.size() || !isThere(date)) return std::nullopt;
    return ln_get_julian_day(&date);
}

std::string momentOf(double julianDay) {
    ln_date date;
    ln_get_date(julianDay + 0.5 / secondsADay, &date); // to the nearest second, whatever is carried
    char text[32];
    std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02dZ", date.years, date.months, date.days, date.hours,
                  date.minutes, static_cast<int>(date.seconds));
    return text;
}

SunClock::SunClock(double latitude, double longitude) : _latitude(latitude), _longitude(longitude) {
    if (!(std::abs(latitude) <= 90.0)) throw std::invalid_argument("The latitude must be from -90 to 90 degrees.");
    if (!(std::abs(longitude) <= 180.0)) throw std::invalid_argument("The longitude must be from -180 to 180 degrees.");
}

SunPosition SunClock::at(double julianDay) const {
    ln_equ_posn sun = sunOfDate(julianDay);
    ln_lnlat_posn observer{_longitude, _latitude};
    ln_hrz_posn seen;
    ln_get_hrz_from_equ(&sun, &observer, julianDay, &seen);
    return {std::fmod(seen.az + 180.0, 360.0), seenElevation(seen.alt)}; // libnova counts from the south
}

glm::dvec3 SunClock::towards(double julianDay) const {
    const SunPosition sun = at(julianDay);
    const double azimuth = glm::radians(sun.azimuth), elevation = glm::radians(sun.elevation);
    return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

} // namespace gnomon
