// SPDX-License-Identifier: MIT
// The mountains of Jacksboro, an elevation model of 3 arc-seconds: shadows of 400 objects in plan, against rays in double
// that share nothing with the code. Places that the mountains themselves keep from the sun are not judged: there a shadow
// is not seen, and the polygon ends at the crest.
#include "ElevationFile.h"

#include <gnomon/TerrainGround.h>
#include <gtest/gtest.h>
#include <osg/Shape>
#include <support/TerrainTrial.h>

#include <iostream>

namespace {

TEST(JacksboroShadows, OfFourHundredObjectsKeepToTheTruth) {
    const auto field = gnomon::examples::readElevation(GNOMON_DATA "/jacksboro.vrt.gdal", "JacksboroShadowsTest");
    const auto ground = gnomon::groundOf(*field);
    const glm::dvec2 low(field->getOrigin().x(), field->getOrigin().y()),
        size(double(field->getXInterval()) * field->getNumColumns(),
             double(field->getYInterval()) * field->getNumRows());
    const auto prisms = test::prismsOn(*ground, low + 0.1 * size, low + 0.9 * size, 400, 1);
    test::printHead(std::cout);
    for (const double elevation : {60.0, 30.0, 10.0, 8.0}) {
        const auto found =
            test::figures(*ground, prisms, elevation, {{"box", test::boxMethod()}, {"hull", test::hullMethod()}}, 1600,
                          test::Places::sunlit);
        test::printRow(std::cout, elevation, "box", found[0]);
        test::printRow(std::cout, elevation, "hull", found[1]);
        EXPECT_GE(found[1].pooled, 0.9995) << elevation;
        EXPECT_GE(found[1].fifth, 0.9995) << elevation;
        EXPECT_LE(found[1].triangles, 45.0) << elevation;
    }
}

} // namespace
