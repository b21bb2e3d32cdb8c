// SPDX-License-Identifier: MIT
// How well depth alone tells what lies in the plane: a shadow without a named receiver beside one with it.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/Geometry>

#include <cmath>

using namespace test;

namespace {

struct Range {
    double groundHalf, near, far, eyeHeight, eyeDistance;
};

struct Difference {
    int shadow = 0, missing = 0, extra = 0;
};

Difference unnamedAgainstNamed(const Range& range) {
    const double size = range.eyeDistance / 10.0;
    std::vector<Mesh> houses;
    for (int i = 0; i < 42; ++i)
        houses.push_back(
            house({(i % 7 - 3) * size * 2.0, (i / 7 - 1) * size * 3.0}, {size, size, size * 1.5}, i * 20.0));
    const View view =
        perspective({0.0, -range.eyeDistance, range.eyeHeight}, {0.0, 0.0, 0.0}, 800, 600, 40.0, range.near, range.far);
    const auto picture = [&](bool shadow, bool named) {
        Scene scene = groundScene(houses, range.groundHalf, {1.0, 0.3, 1.2, 0.0});
        if (shadow) scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
        return render(scene.root, view);
    };
    const Picture lit = picture(false, false), named = picture(true, true), unnamed = picture(true, false);
    Difference result;
    for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
        const bool expected = named.pixels[i] != lit.pixels[i], found = unnamed.pixels[i] != lit.pixels[i];
        result.shadow += expected;
        result.missing += expected && !found;
        result.extra += found && !expected;
    }
    return result;
}

/// Grids of this many quads to a side; `height` gives z.
template <class Height>
Mesh grid(int quads, double half, Height height) {
    const auto corner = [&](int i, int j) {
        const double x = half * (2.0 * i / quads - 1.0), y = half * (2.0 * j / quads - 1.0);
        return glm::dvec3(x, y, height(x, y));
    };
    Mesh mesh;
    for (int i = 0; i < quads; ++i)
        for (int j = 0; j < quads; ++j)
            for (const glm::dvec3& place : {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j),
                                            corner(i + 1, j + 1), corner(i, j + 1)})
                mesh.push_back(place);
    return mesh;
}

Mesh scaled(Mesh mesh, double by) {
    for (glm::dvec3& place : mesh) place *= by;
    return mesh;
}

/// A box on a floor of 16 m, in another unit; planar's plane is z = 0.
struct OnFloor {
    OnFloor(const Mesh& floor, double unit, bool named, const char* spec = "planar") {
        scene.content->addChild(node(scaled(floor, unit), "ground"));
        scene.content->addChild(node(scaled(box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}), unit), "caster"));
        technique = planar(named ? find(*scene.root, "ground") : nullptr);
        if (spec) scene.addShadow(technique);
        picture =
            render(scene.root, perspective(osg::Vec3d(-6.0, -10.0, 8.0) * unit, {}, 96, 72, 40.0, unit, 100.0 * unit));
    }
    Scene scene = test::scene();
    osg::ref_ptr<gnomon::PlanarShadowNode> technique;
    Picture picture;
};

std::string causesOf(const OnFloor& drawn) {
    std::string all;
    for (const std::string& cause : drawn.technique->diagnose()) all += cause;
    return all;
}

} // namespace

/// In millimetres, metres and kilometres. A millimetre is a hundredth of a pixel: it moves few of the some 50 pixels at the edge.
TEST(PlanarBand, AFloorCloseToThePlaneReceivesAndDoesNotCastInAnyUnit) {
    for (const double unit : {1000.0, 1.0, 0.001})
        for (const bool named : {true, false}) {
            const OnFloor lit(square(8.0), unit, named, nullptr), exact(square(8.0), unit, named);
            EXPECT_GT(exact.picture.different(lit.picture), 100);
            for (const double height : {1e-5, 1e-3, -1e-4}) {
                const OnFloor off(square(8.0, height), unit, named);
                EXPECT_LE(off.picture.different(exact.picture), 5) << height << " " << unit << named;
                EXPECT_EQ(causesOf(off), "") << height << " " << unit << named;
            }
            for (const int quads : {4, 20}) { // joined, and as a body
                if (unit != 1.0) continue;
                const OnFloor uneven(
                    grid(quads, 8.0, [](double x, double y) { return 1e-5 * std::sin(7.0 * x + 3.0 * y); }), unit,
                    named);
                EXPECT_LE(uneven.picture.different(exact.picture), 2) << quads << " " << unit << named;
            }
        }
}

TEST(PlanarBand, AReceiverThatIsNotInThePlaneIsNamedWithTheDistance) {
    for (const double height : {0.01, 0.05, -0.01})
        for (const bool named : {true, false}) {
            const OnFloor off(square(8.0, height), 1.0, named);
            const std::string side = height > 0.0 ? " above" : " below", is = height == 0.05 ? "0.05" : "0.01";
            EXPECT_NE(causesOf(off).find("'ground' is " + is + side + " the plane (0 0 1 0)"), std::string::npos)
                << height << named << causesOf(off);
        }
    const OnFloor crater(grid(20, 8.0, [](double x, double y) { return std::min(0.0, std::hypot(x - 4.0, y) - 2.0); }),
                         1.0, true);
    EXPECT_NE(causesOf(crater).find("'ground' is 2 below the plane (0 0 1 0) in places"), std::string::npos)
        << causesOf(crater);
    Scene scene = test::groundScene({box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})});
    const osg::ref_ptr<osg::Geometry> cloud = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> places = new osg::Vec3Array;
    for (const float x : {-3.0f, -2.5f, -2.0f}) places->push_back({x, 0.0f, 0.5f});
    cloud->setVertexArray(places);
    cloud->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, 3));
    const osg::ref_ptr<osg::Geode> points = new osg::Geode;
    points->setName("cloud");
    points->addDrawable(cloud);
    scene.content->addChild(points);
    const auto technique = planar(points);
    scene.addShadow(technique);
    render(scene.root, fromAbove(4.0, 64));
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("'cloud' is 0.5 above the plane"), std::string::npos);
}

TEST(PlanarBand, NoShadowIsMissingOnGroundsFromMetresToKilometres) {
    for (const Range& range : {Range{8, 1, 100, 10, 14}, Range{8, 0.5, 100, 1.0, 4}, Range{20, 0.1, 100, 0.3, 2},
                               Range{2, 0.05, 10, 0.05, 1}, Range{2, 0.05, 10, 0.03, 0.5}, Range{8, 0.1, 1000, 10, 14},
                               Range{100, 1, 1000, 10, 30}, Range{1000, 1, 5000, 20, 60},
                               Range{9000, 1, 20000, 20, 300}, Range{9000, 1, 20000, 400, 900}}) {
        const Difference found = unnamedAgainstNamed(range);
        EXPECT_GT(found.shadow, 5000);
        EXPECT_EQ(found.missing, 0) << range.groundHalf << " near " << range.near;
        // The feet of walls: the margin is a pixel high at most in these views, and the feet are some
        // thousand pixels long beside tens of thousands of shadow.
        EXPECT_LE(found.extra, found.shadow / 100) << range.groundHalf << " near " << range.near;
    }
}
