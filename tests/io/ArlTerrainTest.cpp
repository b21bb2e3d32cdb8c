// SPDX-License-Identifier: MIT
// arl_terrain as users run it: pictures of the town by each technique and time of day, the window's keys.
#include "ExampleProgram.h"

#include <Town.h>

#include <osg/Vec2d>
#include <osgDB/ReadFile>

#include <algorithm>
#include <cmath>

namespace {

using namespace gnomon::testing;

constexpr int width = 480, height = 360;

class ArlTerrain : public ExampleProgram {
protected:
    ArlTerrain() : ExampleProgram(ARL_TERRAIN) {}
    osg::ref_ptr<osg::Image> town(const std::string& shadow, const std::string& hour) {
        return picture({"--shadow", shadow, "--hour", hour, "--size", "480x360"});
    }
};

/// Pixels of `with` that differ from `without`: how many, and the middle of them, pixels from the lower left.
struct Difference {
    int count = 0;
    int lighter = 0;   ///< in any channel.
    int offGround = 0; ///< without is no shade of the grass there.
    osg::Vec2d middle;
};

/// Grass is 0.50 : 0.58 : 0.38 under white light; walls, roofs and the sky have less green than red or blue.
bool isGrass(const osg::Vec4& c) { return c.g() > c.r() && c.g() > c.b(); }

Difference difference(const osg::Image& with, const osg::Image& without) {
    Difference result;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const osg::Vec4 a = with.getColor(x, y), b = without.getColor(x, y);
            if (a == b) continue;
            ++result.count;
            result.lighter += a.r() > b.r() || a.g() > b.g() || a.b() > b.b();
            result.offGround += !isGrass(b);
            result.middle += osg::Vec2d(x, y);
        }
    result.middle /= std::max(result.count, 1);
    return result;
}

} // namespace

/// Posts 50 apart: rough in the west, in the east a valley along x = 2000 … 4000 whose floor is y = 2000.
TEST(TownSite, IsGentleAndRisesToTheNorthAndHasNoHole) {
    const osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(81, 81);
    field->setXInterval(50.0f);
    field->setYInterval(50.0f);
    for (unsigned row = 0; row < 81; ++row)
        for (unsigned column = 0; column < 81; ++column)
            field->setHeight(column, row,
                             column < 40 ? float(30 * ((row + column) % 2)) : 2.0f * std::abs(float(row) - 40.0f));
    const glm::dvec2 best = gnomon::examples::townSite(*field, 900.0);
    EXPECT_GE(best.x, 2000.0 + 450.0);
    EXPECT_GE(best.y, 2000.0 + 450.0);
    for (unsigned row = 0; row < 81; row += 3)
        for (unsigned column = 0; column < 81; ++column) field->setHeight(column, row, -9999.0f);
    EXPECT_THROW(gnomon::examples::townSite(*field, 900.0), std::runtime_error);
}

TEST_F(ArlTerrain, HullDarkensGroundAndNothingElse) {
    const auto none = town("none", "8");
    const Difference shadow = difference(*town("hull", "8"), *none);
    EXPECT_GT(shadow.count, width * height / 20);
    EXPECT_LT(shadow.count, width * height / 2);
    EXPECT_EQ(shadow.lighter, 0);
    EXPECT_EQ(shadow.offGround, 0);
    EXPECT_EQ(difference(*town("none", "8"), *none).count, 0) << "the same town every time";
}

TEST_F(ArlTerrain, BoxIsNotCloseToHull) {
    const auto none = town("none", "8"), hull = town("hull", "8");
    const int shadow = difference(*hull, *none).count;
    EXPECT_GT(difference(*town("box", "8"), *hull).count, shadow / 20) << "box is elsewhere 3 % off, 23 % at worst";
}

/// The camera looks to azimuth 60: what lies west is nearer, lower in the picture, than what lies east.
TEST_F(ArlTerrain, ShadowsLieWestInTheMorningAndEastInTheEveningAndAreShortAtNoon) {
    const auto shadowAt = [this](const char* hour) { return difference(*town("hull", hour), *town("none", hour)); };
    const Difference morning = shadowAt("8"), noon = shadowAt("12"), evening = shadowAt("16");
    EXPECT_LT(morning.middle.y(), noon.middle.y());
    EXPECT_LT(morning.middle.y(), evening.middle.y());
    EXPECT_LT(noon.count, morning.count * 2 / 3) << "tan 24° / tan 53° is a third, and more of it lies behind walls";
    EXPECT_LT(noon.count, evening.count);
}

TEST_F(ArlTerrain, ReportsMorningNoonAndEveningWithEachTechnique) {
    const Ending ending = run({"--size", "40x30", "--report", "new/pictures"});
    ASSERT_EQ(ending.status, 0) << ending.err;
    for (const std::string time : {"morning", "noon", "evening"})
        for (const std::string technique : {"none", "box", "hull"}) {
            const auto path = folder.path() / "new/pictures" / (time + "-" + technique + ".png");
            const auto image = osgDB::readRefImageFile(path.string());
            ASSERT_TRUE(image) << path;
            EXPECT_EQ(image->s(), 40);
        }
}

/// In the evening it stands; k, half an hour a stroke, leads there as well. Without text, which is longer now and then.
TEST_F(ArlTerrain, ASunThatRunsEndsInTheEvening) {
    open({"--size", "480x360"});
    Screenshot evening;
    for (int i = 0; i < 17; ++i) evening = pressed("k");
    start({"--size", "480x360", "--sun-speed", "20000"});
    desktop->pictureWhere(
        "the town is drawn", [](const Screenshot& p) { return p.width == width && p.at(width / 2, height / 2) != 0u; },
        false);
    desktop->press("g");
    EXPECT_NO_THROW(desktop->pictureWhere("it is evening", [&](const Screenshot& p) { return p == evening; }));
}

TEST_F(ArlTerrain, KeysChangeTechniqueTimeAndComposite) {
    open({"--shadow", "none", "--size", "480x360"});
    const Screenshot box = pressed("n"), hull = pressed("n"), later = pressed("k");
    EXPECT_NE(box, first);
    EXPECT_NE(hull, first);
    EXPECT_NE(later, hull);
    EXPECT_EQ(pressed("j"), hull);
    EXPECT_NE(pressed("r"), hull);
    EXPECT_EQ(pressed("r"), hull);
    EXPECT_EQ(pressed("n"), first) << "n leads back";
}
