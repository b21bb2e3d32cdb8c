// SPDX-License-Identifier: MIT
// The sun's place against published almanac values.
#include <gnomon/SunClock.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using gnomon::julianDay;
using gnomon::SunClock;

constexpr double degree = 0.01; // what the class promises

double dayOf(const std::string& moment) { return julianDay(moment).value(); }

/// Seen from the north pole the sun's elevation is its declination, and where it is low the air raises it: from there
/// or from the south pole, whichever has it above the horizon.
void expectDeclination(const std::string& moment, double declination, double refraction) {
    const SunClock pole(declination < 0.0 ? -90.0 : 90.0, 0.0);
    EXPECT_NEAR(pole.at(dayOf(moment)).elevation - refraction, std::abs(declination), degree) << moment;
}

} // namespace

/// I. Reda and A. Andreas, "Solar Position Algorithm for Solar Radiation Applications", NREL/TP-560-34302, 2004, the
/// worked example: zenith 50.11162, azimuth 194.34024. Its air is thinner by a fifth, its eye 1,830 m up: 0.004 degrees.
TEST(SunClock, SeesTheSunWhereTheSolarPositionAlgorithmDoes) {
    const auto sun = SunClock(39.742476, -105.1786).at(dayOf("2003-10-17T19:30:30Z"));
    EXPECT_NEAR(sun.azimuth, 194.34024, degree);
    EXPECT_NEAR(90.0 - sun.elevation, 50.11162, degree);
}

TEST(SunClock, HasTheDeclinationOfTheAlmanac) {
    // J. Meeus, "Astronomical Algorithms", example 25.b: declination -7°47'01.74", 13 October 1992 at 0 h. Refraction at
    // that elevation is 6.7 minutes of arc by any almanac's table (Bennett 1982).
    expectDeclination("1992-10-13T00:00:00Z", -(7.0 + 47.0 / 60.0 + 1.74 / 3600.0), 6.7 / 60.0);
    // The Astronomical Almanac: solstice of 21 June 2026 at 08:24 UTC, obliquity 23.4362; refraction there 2.2 minutes.
    expectDeclination("2026-06-21T08:24:00Z", 23.4362, 2.2 / 60.0);
    // Equinox of 20 March 2026 at 14:46 UTC: overhead is a place on the equator, 90 degrees from both poles. There the air
    // raises it by 29 minutes of arc (T. Saemundsson, 1986); a quarter of an hour's motion is 0.004 degrees.
    for (const double nothing : {0.0, -0.001}) expectDeclination("2026-03-20T14:46:00Z", nothing, 29.0 / 60.0);
}

/// Noon in the north is due south, in the south due north; mornings are in the east; x is east, y north, z up.
TEST(SunClock, PointsEastInTheMorningAndAcrossTheEquatorAtNoon) {
    const SunClock greenwich(51.48, 0.0), cape(-33.9, 18.4);
    EXPECT_GT(greenwich.towards(dayOf("2026-06-21T06:00:00Z")).x, 0.7);
    EXPECT_LT(greenwich.towards(dayOf("2026-06-21T12:00:00Z")).y, 0.0);
    EXPECT_GT(cape.towards(dayOf("2026-06-21T10:46:00Z")).y, 0.0);
    EXPECT_LT(greenwich.towards(dayOf("2026-06-21T23:00:00Z")).z, 0.0);
    EXPECT_NEAR(glm::dvec3(greenwich.towards(dayOf("2026-06-21T12:00:00Z"))).z,
                std::sin((90 - 51.48 + 23.44) * M_PI / 180),
                1e-3); // two minutes of time before it culminates
}

TEST(JulianDay, IsTheAlmanacs) {
    EXPECT_EQ(dayOf("2000-01-01T12:00:00Z"), 2451545.0); // the epoch J2000
    EXPECT_EQ(dayOf("1999-01-01T00:00:00Z"), 2451179.5); // Meeus, chapter 7
    EXPECT_NEAR(dayOf("2026-06-21T15:00:00.5Z") - dayOf("2026-06-21T15:00:00Z"), 0.5 / 86400.0, 1e-9);
    EXPECT_EQ(dayOf("2024-02-29T00:00:00Z") + 1.0, dayOf("2024-03-01T00:00:00Z"));
}

TEST(JulianDay, IsToldAsTheMomentThatItWas) {
    for (const char* moment : {"2026-06-21T15:00:00Z", "2024-02-29T23:59:59Z", "1999-12-31T00:00:01Z"})
        EXPECT_EQ(gnomon::momentOf(dayOf(moment)), moment);
    EXPECT_EQ(gnomon::momentOf(dayOf("2023-12-31T23:59:59.8Z")), "2024-01-01T00:00:00Z");
}

TEST(JulianDay, IsNoneForAMomentThatIsNone) {
    for (const char* text :
         {"", "noon", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z", "2026-06-21T24:00:00Z", "2026-06-21T15:60:00Z",
          "2026-06-21T15:00:60Z", "2026-06-21T15:00:00", "2026-06-21T15:00:00Zulu", "2026-06-00T15:00:00Z",
          "2026-06-21T15:00:nanZ", "2026-06-21T-1:00:00Z"})
        EXPECT_FALSE(julianDay(text)) << text;
}

TEST(SunClock, RefusesAPlaceThatIsNotOnEarth) {
    EXPECT_THROW(SunClock(90.1, 0.0), std::invalid_argument);
    EXPECT_THROW(SunClock(0.0, -180.1), std::invalid_argument);
    EXPECT_THROW(SunClock(std::numeric_limits<double>::quiet_NaN(), 0.0), std::invalid_argument);
}
