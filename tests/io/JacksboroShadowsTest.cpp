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
    const std::vector<test::Contestant> contestants{{"box", test::boxMethod()},
                                                    {"hull", test::hullMethod()},
                                                    {"drape 0.5", test::drapeMethod(0.5), 0.5},
                                                    {"drape 0.1", test::drapeMethod(0.1), 0.1},
                                                    {"exact", test::drapeMethod(0.0)}};
    const struct {
        double elevation, pooled, fifth, triangles;
    } wanted[] = {
        {60.0, 0.995, 0.98, 12.0}, {30.0, 0.995, 0.98, 12.0}, {10.0, 0.985, 0.97, 12.0}, {8.0, 0.95, 0.95, 1e9}};
    test::printHead(std::cout);
    for (const auto& [elevation, pooled, fifth, triangles] : wanted) {
        const auto found = test::figures(*ground, prisms, elevation, contestants, 1600, test::Places::sunlit);
        for (std::size_t i = 0; i < found.size(); ++i)
            test::printRow(std::cout, elevation, contestants[i].name, found[i]);
        const test::Figures &hull = found[1], &fine = found[3], &exact = found[4];
        EXPECT_GE(hull.pooled, pooled) << elevation;
        EXPECT_GE(hull.fifth, fifth) << elevation;
        EXPECT_LE(hull.triangles, triangles) << elevation;
        EXPECT_GE(fine.pooled, 0.998) << elevation;
        EXPECT_EQ(exact.least, 1.0) << elevation;
        EXPECT_EQ(found[2].beyond + fine.beyond, 0) << elevation;
    }
}

} // namespace
