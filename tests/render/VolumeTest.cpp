// SPDX-License-Identifier: MIT
// Shadow volumes against the truth image: hard scenes, views and lights.
#include "VolumeTrial.h"

#include <gtest/gtest.h>

using test::expectFloor;
using test::labEight;
using test::room;
using test::townOfHouses;
using test::TracedCase;

namespace {

TracedCase small(TracedCase given) { return test::sized(std::move(given), 320, 240); }

TEST(Volume, IsAsGoodAsOneRayAPixelCanBe) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) expectFloor(small(given));
}

TEST(Volume, IsSoInTiltedScenesAndUnderLowSuns) {
    TracedCase low = small(townOfHouses());
    low.name = "town, low sun";
    low.light = test::sunAt(17.0, 15.0);
    for (const TracedCase& given : {small(tilted(labEight())), small(tilted(room())), low}) expectFloor(given);
}

TEST(Volume, CountsFromBehindWhereTheEyeIsInShadow) {
    TracedCase given = small(townOfHouses());
    given.name = "in a street";
    given.light = test::sunAt(-100.0, 25.0);
    given.view = test::perspective({1.0, -20.0, 1.7}, {4.0, 20.0, 1.5}, 320, 240, 60.0, 0.1, 300.0);
    expectFloor(given);
}

} // namespace
