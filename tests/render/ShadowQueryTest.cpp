// SPDX-License-Identifier: MIT
// Questions about points and lines, against the picture of the technique that is asked, and against the truth.
#include <support/Scene.h>
#include <support/Truth.h>

#include <gnomon/ShadowQuery.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>

#include <limits>
#include <random>

using gnomon::ShadowQuery;
using gnomon::ShadowTechnique;

namespace {

const osg::Vec4d sun(1.0, 0.3, 1.2, 0.0), lamp(-1.0, 1.0, 7.0, 1.0);

std::vector<test::Mesh> meshes() {
    return {test::square(8.0), test::sphere({-2.0, 0.0, 2.5}, 1.0, 32), test::house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0)};
}

test::Scene sceneFor(const osg::Vec4d& light, ShadowTechnique* technique) {
    const std::vector<test::Mesh> all = meshes();
    test::Scene scene = test::groundScene({all.begin() + 1, all.end()}, 8.0, light);
    if (!technique) return scene;
    if (dynamic_cast<gnomon::TerrainShadowGeode*>(technique))
        technique->setReceiver({test::find(*scene.root, "ground")});
    scene.addShadow(technique);
    return scene;
}

/// Marked or not, and the same all around.
bool isCertain(const test::Picture& a, const test::Picture& b, int x, int y) {
    if (x < 1 || y < 1 || x + 1 >= a.width || y + 1 >= a.height) return false;
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
            if ((a.at(u, v) == b.at(u, v)) != (a.at(x, y) == b.at(x, y))) return false;
    return true;
}

/// Of 10,000 points of the picture those at which the query says something else, half a pixel from edges at least.
int disagreements(const osg::Vec4d& light, ShadowTechnique* technique) {
    const test::View view = test::perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 480, 360);
    test::Scene plain = sceneFor(light, nullptr), shadowed = sceneFor(light, technique);
    const test::Picture lit = test::render(plain.root, view), picture = test::render(shadowed.root, view);
    const gnomon::TruthImage places = test::truthOf(meshes(), light, view);
    const ShadowQuery query(*technique, {0, light});
    std::mt19937 random(1);
    int asked = 0, wrong = 0, dark = 0;
    while (asked < 10000) {
        const int x = static_cast<int>(random() % 480), y = static_cast<int>(random() % 360);
        const gnomon::TruthPixel& place = places.at(x, y);
        if (!(place.facing > 0.02) || !isCertain(picture, lit, x, y)) continue;
        const bool marked = picture.at(x, y) != lit.at(x, y);
        wrong += query.isLit({place.position.x, place.position.y, place.position.z}) == marked;
        dark += marked;
        ++asked;
    }
    EXPECT_GT(dark, 300);
    return wrong;
}

TEST(ShadowQuery, SaysWhatThePictureOfItsTechniqueShows) {
    for (const osg::Vec4d& light : {sun, lamp}) {
        EXPECT_LE(disagreements(light, osg::ref_ptr<ShadowTechnique>(new gnomon::TracedShadowTechnique)), 1);
        EXPECT_LE(disagreements(light, test::planar()), 1);
        EXPECT_LE(disagreements(light, osg::ref_ptr<ShadowTechnique>(new gnomon::TerrainShadowGeode)), 1);
    }
}

TEST(ShadowQuery, IsTheTruthWhenExactWhateverIsDrawn) {
    const test::View view = test::perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 320, 240);
    const osg::Vec4d low(-1.0, 0.0, 0.5, 0.0);
    const gnomon::TruthImage truth = test::truthOf(meshes(), low, view);
    const osg::ref_ptr<ShadowTechnique> technique = test::planar();
    test::Scene scene = sceneFor(low, technique);
    const ShadowQuery planar(*technique, {0, low}), exact = planar.exact();
    int asked = 0, wrong = 0, planarWrong = 0;
    for (const gnomon::TruthPixel& pixel : truth.pixels) {
        if (!(pixel.facing > 0.02)) continue;
        const osg::Vec3d point(pixel.position.x, pixel.position.y, pixel.position.z);
        wrong += exact.isLit(point) != pixel.litCentre;
        planarWrong += planar.isLit(point) != pixel.litCentre;
        ++asked;
    }
    EXPECT_LE(wrong, asked / 10000);
    EXPECT_GT(planarWrong, 20) << "the house's wall in the shadow of the sphere is lit in planar's picture";
}

TEST(ShadowQuery, KnowsThePlaneWhereTransformsPutIt) {
    const osg::ref_ptr<ShadowTechnique> technique = test::planar(); // z = 0 of its own frame
    test::Scene scene = sceneFor(sun, osg::ref_ptr<ShadowTechnique>(new gnomon::TracedShadowTechnique));
    osg::ref_ptr<osg::MatrixTransform> raised = new osg::MatrixTransform(osg::Matrixd::translate(0.0, 0.0, 1.0));
    raised->addChild(technique);
    scene.group->addChild(raised);
    const ShadowQuery query(*technique, {0, sun});
    const double t = 1.5 / 1.2; // from the sphere's middle down to z = 1
    EXPECT_FALSE(query.isLit({-2.0 - t, -0.3 * t, 1.0}));
    EXPECT_TRUE(query.isLit({-2.0 - t, -0.3 * t, 1.1}));
    EXPECT_TRUE(query.isLit({-2.0 - 2.5 / 1.2, -0.3 * 2.5 / 1.2, 0.0}));
    EXPECT_TRUE(query.isLit({5.0, -5.0, 1.0}));
}

TEST(ShadowQuery, KnowsWhichLinesAreBlocked) {
    const osg::ref_ptr<ShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    test::Scene scene = sceneFor(sun, technique);
    const ShadowQuery query(*technique, {0, sun});
    EXPECT_TRUE(query.isBlocked({-2.0, -3.0, 2.5}, {-2.0, 3.0, 2.5}));
    EXPECT_FALSE(query.isBlocked({-2.0, -3.0, 4.0}, {-2.0, 3.0, 4.0}));
    EXPECT_FALSE(query.isBlocked({-2.0, -3.0, 2.5}, {-2.0, -2.0, 2.5}));
    EXPECT_TRUE(query.isBlocked({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}));
    EXPECT_FALSE(query.isBlocked({0.0, 0.0, 0.0}, {0.0, -5.0, 3.0})) << "from the ground itself";
    EXPECT_FALSE(query.isBlocked({0.0, -5.0, 3.0}, {0.0, 0.0, 0.0})) << "to the ground itself";
    EXPECT_FALSE(query.isBlocked({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}));
}

// Rays are about the middle of all casters, where a saddle has a corner. So far from the origin a point's doubles are off by a
// nanometre. From 3 above one sees the corner: the saddle rises by a quarter of the way from there.
TEST(ShadowQuery, EndsALineAtASurfaceInTheMiddleOfAllCasters) {
    const osg::Vec3d middle(432100.3, 6400000.7, 812.1);
    const glm::dvec3 rim[] = {{4.0, 0.0, 1.0}, {0.0, 4.0, -1.0}, {-4.0, 0.0, 1.0}, {0.0, -4.0, -1.0}};
    test::Mesh saddle;
    for (int i = 0; i < 4; ++i) saddle.insert(saddle.end(), {glm::dvec3(0.0), rim[i], rim[(i + 1) % 4]});
    const osg::ref_ptr<ShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    test::Scene scene = test::scene(sun);
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(middle));
    place->addChild(test::node(saddle));
    scene.content->addChild(place);
    scene.addShadow(technique);
    const ShadowQuery query(*technique, {0, sun});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> across(-3.0, 3.0), off(-1e-9, 1e-9);
    int blocked = 0;
    for (int i = 0; i < 1000; ++i) {
        const double x = across(random), y = across(random), u = off(random), v = off(random), w = off(random);
        blocked += query.isBlocked(middle + osg::Vec3d(x, y, 3.0), middle + osg::Vec3d(u, v, w));
    }
    EXPECT_EQ(blocked, 0);
    EXPECT_TRUE(query.isBlocked(middle + osg::Vec3d(1.0, 2.0, 3.0), middle - osg::Vec3d(0.1, 0.2, 0.3)));
}

TEST(ShadowQuery, TellsTheLitShareOfABox) {
    const osg::ref_ptr<ShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    test::Scene scene = test::groundScene({test::quad({-4.0, 0.0, 3.0}, {8.0, 0.0, 0.0}, {0.0, 4.0, 0.0})});
    scene.addShadow(technique);
    const ShadowQuery query(*technique, {0, {0.0, 0.0, 1.0, 0.0}});
    EXPECT_DOUBLE_EQ(query.litShare({-1.0, -1.0, 1.0, 1.0, 1.0, 2.0}), 0.5);
    EXPECT_DOUBLE_EQ(query.litShare({-1.0, -1.5, 1.0, 1.0, 0.5, 2.0}, 16), 0.75);
    EXPECT_DOUBLE_EQ(query.litShare({-1.0, 1.0, 1.0, 1.0, 2.0, 2.0}, 0), 0.0);
    EXPECT_DOUBLE_EQ(query.litShare({-1.0, 1.0, 4.0, 1.0, 2.0, 5.0}), 1.0);
    const ShadowQuery underRoof(*technique, {0, {0.0, 2.0, 2.5, 1.0}});
    EXPECT_DOUBLE_EQ(underRoof.litShare({-1.0, 1.0, 1.0, 1.0, 2.0, 2.0}), 1.0)
        << "what is behind the lamp does not block";
}

TEST(ShadowQuery, AnswersManyAsItAnswersOne) {
    const osg::ref_ptr<ShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    test::Scene scene = sceneFor(lamp, technique);
    const ShadowQuery query(*technique, {0, lamp});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-5.0, 5.0);
    std::vector<osg::Vec3d> points;
    for (int i = 0; i < 5000; ++i) points.emplace_back(place(random), place(random), place(random) / 2.0 + 2.5);
    const std::vector<std::uint8_t> lit = query.areLit(points), blocked = query.areBlocked(points[0], points);
    int different = 0, dark = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        different += lit[i] != query.isLit(points[i]) || blocked[i] != query.isBlocked(points[0], points[i]);
        dark += !lit[i];
    }
    EXPECT_EQ(different, 0);
    EXPECT_GT(dark, 50);
}

TEST(ShadowQuery, IsTheSameFarFromTheOrigin) {
    const osg::ref_ptr<ShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    test::Scene scene = sceneFor(sun, technique);
    const osg::Vec3d utm(432100.25, 6400000.5, 812.0);
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(utm));
    scene.group->replaceChild(scene.content, place);
    place->addChild(scene.content);
    const ShadowQuery query(*technique, {0, sun});
    EXPECT_FALSE(query.isLit(utm + osg::Vec3d(-2.0 - 2.5 / 1.2, -0.3 * 2.5 / 1.2, 0.0)));
    EXPECT_TRUE(query.isLit(utm + osg::Vec3d(5.0, -5.0, 0.0)));
}

TEST(ShadowQuery, SharesTheTreeOfTheCastersWithWhoeverTraces) {
    const osg::ref_ptr<ShadowTechnique> floor = test::planar();
    const osg::ref_ptr<gnomon::TracedShadowTechnique> drawnLater = new gnomon::TracedShadowTechnique;
    test::Scene scene = sceneFor(sun, floor);
    scene.addShadow(drawnLater);
    test::Camera camera(scene.root, test::fromAbove(4.0, 64));
    {
        const ShadowQuery query(*floor, {0, sun}), exact = query.exact();
        camera.frame();
        EXPECT_EQ(drawnLater->builds(), 0u);
    }
    const ShadowQuery shares(*drawnLater, {0, sun});
    scene.content->addChild(test::node(test::box({3.0, 3.0, 0.0}, {4.0, 4.0, 1.0})));
    camera.frame();
    EXPECT_EQ(drawnLater->builds(), 1u) << "other casters, another tree";
    const ShadowQuery after(*drawnLater, {0, sun});
    const osg::Vec3d behindTheBox(2.5, 3.4, 0.25);
    EXPECT_TRUE(shares.isLit(behindTheBox)) << "it keeps the casters that it was made with";
    EXPECT_FALSE(after.isLit(behindTheBox));
    camera.frame();
    EXPECT_EQ(drawnLater->builds(), 1u);
}

TEST(ShadowQuery, IsOfTheNearestOfTheGroupsAboveItsTechnique) {
    const osg::ref_ptr<ShadowTechnique> technique = test::planar();
    test::Scene scene = sceneFor(sun, technique);
    const osg::ref_ptr<gnomon::ShadowCasterGroup> outer = new gnomon::ShadowCasterGroup;
    outer->setCasters({test::node(test::box({5.0, 5.0, 1.0}, {6.0, 6.0, 2.0}))});
    outer->addChild(scene.root);
    EXPECT_FALSE(ShadowQuery(*technique, {0, sun}).isLit({-2.0 - 2.5 / 1.2, -0.3 * 2.5 / 1.2, 0.0})) << "the sphere";
}

TEST(ShadowQuery, RefusesWhatCannotBeAsked) {
    const osg::ref_ptr<ShadowTechnique> lonely = new gnomon::TracedShadowTechnique;
    EXPECT_THROW(ShadowQuery(*lonely, {0, sun}), std::invalid_argument);
    const osg::ref_ptr<ShadowTechnique> technique = new gnomon::TracedShadowTechnique;
    test::Scene scene = sceneFor(sun, technique);
    EXPECT_THROW(ShadowQuery(*technique, {0, {0.0, 0.0, 0.0, 0.0}}), std::invalid_argument);
    EXPECT_THROW(ShadowQuery(*technique, {0, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 1.0}}),
                 std::invalid_argument);
}

} // namespace
