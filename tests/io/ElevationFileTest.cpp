// SPDX-License-Identifier: MIT
// Elevation models by OpenSceneGraph's readers: what is known of them without Gnomon, what is said of bad ones, and shadows
// on the mountains of Jacksboro.
#include "Program.h"

#include <InputFile.h>

#include <gnomon/TerrainGround.h>
#include <gnomon/ground/HeightPyramid.h>

#include <gtest/gtest.h>
#include <osg/Shape>
#include <support/TerrainTrial.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

namespace {

using gnomon::groundOf;
using gnomon::examples::readElevation;
using gnomon::testing::TemporaryFolder;

const std::string jacksboro = GNOMON_DATA "/jacksboro.vrt.gdal";

/// 3 × 3 posts, 10 apart. OpenSceneGraph puts posts on the north-west corners of GDAL's cells: the south-west one on
/// (100, 210).
std::string grid(const std::string& heights) {
    return "ncols 3\nnrows 3\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n" + heights;
}

/// What is said of a file, once it is written with these bytes.
std::string refusal(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    if (!bytes.empty()) folder.write(name, bytes);
    try {
        readElevation((folder.path() / (name + ".gdal")).string(), "test");
    } catch (const std::runtime_error& error) {
        std::string sentence = error.what();
        const std::string path = folder.path().string() + "/";
        return sentence.erase(sentence.find(path), path.size());
    }
    return "read";
}

std::string damaged(const std::string& name) {
    return "\"" + name +
           ".gdal\" cannot be read as an elevation model: it is damaged, or it does not match its name. "
           "Allowed: tif.gdal, asc.gdal, hgt.gdal, vrt.gdal, ….";
}

/// 99 × 99 posts of 2 bytes in a file beside it, from a byte of it on.
std::string rawGrid(const std::string& source, int first) {
    return "<VRTDataset rasterXSize=\"99\" rasterYSize=\"99\"><VRTRasterBand dataType=\"Int16\" band=\"1\" "
           "subClass=\"VRTRawRasterBand\"><SourceFilename relativeToVRT=\"1\">" +
           source + "</SourceFilename><ImageOffset>" + std::to_string(first) +
           "</ImageOffset><PixelOffset>2</PixelOffset><LineOffset>198</LineOffset></VRTRasterBand></VRTDataset>";
}

} // namespace

TEST(ElevationFile, TheJacksboroModelHasItsHeightsWithNorthUp) {
    const auto field = readElevation(jacksboro, "test");
    EXPECT_EQ(field->getNumColumns(), 403u);
    EXPECT_EQ(field->getNumRows(), 344u);
    const auto& heights = field->getHeightList();
    EXPECT_EQ(*std::min_element(heights.begin(), heights.end()), 236.0f);
    EXPECT_EQ(*std::max_element(heights.begin(), heights.end()), 1076.0f);
    // By unzip and od, the file's rows from north to south.
    EXPECT_EQ(field->getHeight(0, 343), 483.0f) << "north-west";
    EXPECT_EQ(field->getHeight(402, 343), 444.0f) << "north-east";
    EXPECT_EQ(field->getHeight(0, 0), 545.0f) << "south-west";
    EXPECT_EQ(field->getHeight(402, 0), 272.0f) << "south-east";
    EXPECT_EQ(field->getHeight(219, 343 - 297), 1076.0f);
}

TEST(ElevationFile, TheJacksboroModelsPostsAreThreeSecondsOfArcApart) {
    const auto field = readElevation(jacksboro, "test");
    const double radians = 3.14159265358979323846 / 180.0, latitude = 36.58958 * radians, second3 = radians / 1200.0;
    // WGS 84: half axis and squared eccentricity; radii of curvature along the meridian and across it.
    const double a = 6378137.0, e2 = 0.00669438, w = 1.0 - e2 * std::sin(latitude) * std::sin(latitude);
    EXPECT_NEAR(double(field->getXInterval()), second3 * a / std::sqrt(w) * std::cos(latitude), 0.001);
    EXPECT_NEAR(double(field->getYInterval()), second3 * a * (1.0 - e2) / (w * std::sqrt(w)), 0.001);
    EXPECT_EQ(field->getOrigin(), osg::Vec3(0, 0, 0));
}

TEST(ElevationFile, BecomesGroundThatAdapts) {
    const auto ground = groundOf(*readElevation(jacksboro, "test"));
    EXPECT_TRUE(dynamic_cast<const gnomon::HeightPyramid*>(ground.get()));
    // The file's step is a float: 219 of them are off by less than 1 mm, its slope there is below 1.
    EXPECT_NEAR(ground->height(219 * 74.574, 46 * 92.475).value_or(0.0), 1076.0, 1e-3);
    EXPECT_FALSE(ground->height(-1.0, 100.0));
    EXPECT_TRUE(ground->hit({16000.0, 16000.0, 3000.0}, {1.0, 1.0, -0.5}));
}

TEST(ElevationFile, NothingMeasuredIsAHole) {
    const TemporaryFolder folder;
    folder.write("dem.asc", grid("7 8 9\n4 5 6\n1 2 -9999\n"));
    const auto ground = groundOf(*readElevation((folder.path() / "dem.asc.gdal").string(), "test"));
    EXPECT_EQ(ground->height(105.0, 215.0).value_or(0.0), 3.0) << "amid 1, 2, 4 and 5, cut from 1 to 5";
    EXPECT_EQ(ground->height(105.0, 225.0).value_or(0.0), 6.0);
    EXPECT_FALSE(ground->height(115.0, 215.0));
}

TEST(ElevationFile, BadOnesAreRefusedInOneSentence) {
    EXPECT_EQ(refusal("none.asc", ""), "there is no file \"none.asc.gdal\".");
    EXPECT_EQ(refusal("text.vrt", "not a model"), damaged("text.vrt"));
    EXPECT_EQ(refusal("half.vrt", "<VRTDataset rasterXSize=\"3\" raster"), damaged("half.vrt"));
    EXPECT_EQ(refusal("nowhere.vrt", rawGrid("nowhere.raw", 0)), damaged("nowhere.vrt"));
    EXPECT_EQ(refusal("line.asc", "ncols 3\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n"),
              damaged("line.asc"));
    EXPECT_EQ(refusal("level.asc", grid("0 0 0\n0 0 0\n0 0 0\n")),
              "\"level.asc.gdal\" has the height 0 everywhere. The data that it refers to may be missing or damaged.");
    EXPECT_EQ(refusal("beyond.vrt", rawGrid("beyond.vrt", 5000)),
              "\"beyond.vrt.gdal\" has the height 0 everywhere. The data that it refers to may be missing or damaged.")
        << "its posts begin after the last byte";
    EXPECT_EQ(refusal("good.asc", grid("7 8 9\n4 5 6\n1 2 3\n")), "read");
}

TEST(ElevationFile, AFolderOrASceneIsNoElevationModel) {
    const TemporaryFolder folder;
    EXPECT_THROW(readElevation(folder.path().string(), "test"), std::runtime_error);
    EXPECT_THROW(readElevation(GNOMON_DATA "/lab8.osgt", "test"), std::runtime_error);
    EXPECT_THROW(readElevation(GNOMON_DATA "/lab8.osgt.gdal", "test"), std::runtime_error);
}

/// Shadows of 400 objects in plan, against rays in double that share nothing with the code. Places that the mountains themselves
/// keep from the sun are not judged: there a shadow is not seen, and the polygon ends at the crest.
TEST(JacksboroShadows, OfFourHundredObjectsKeepToTheTruth) {
    const auto field = readElevation(jacksboro, "test");
    const auto ground = groundOf(*field);
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
