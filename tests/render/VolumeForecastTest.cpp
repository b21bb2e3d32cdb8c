// SPDX-License-Identifier: MIT
// What auto expects of volumes, counted against what ShadowVolumeTechnique draws.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/volume/VolumeCache.h>
#include <gnomon/volume/VolumeForecast.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <osg/observer_ptr>

#include <numeric>
#include <random>

using namespace test;

namespace {

const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0), lamp(3.0, 1.0, 9.0, 1.0);

struct Work {
    double sides = 0.0, caps = 0.0;
};

double cornersOf(const std::vector<gnomon::VolumeGeometry::Range>& ranges) {
    const auto add = [](double sum, const gnomon::VolumeGeometry::Range& range) { return sum + range.count; };
    return std::accumulate(ranges.begin(), ranges.end(), 0.0, add);
}

/// Of all volumes that a view sees: a side is two triangles.
Work drawnOf(const gnomon::SeenVolumes& seen) {
    Work work;
    for (const gnomon::VolumeRound& round : seen.rounds(~0u))
        for (const auto& [mesh, share] : round.shares) {
            for (const auto* sides : {&share.entered, &share.left})
                work.sides += (cornersOf(sides->usual) + cornersOf(sides->grazed)) / 6.0;
            work.caps += (cornersOf(share.lightCaps) + cornersOf(share.darkCaps) + cornersOf(share.backs) +
                          2.0 * cornersOf(share.bothCaps)) /
                         3.0;
        }
    return work;
}

/// Finds volumes as ShadowVolumeTechnique does, and what auto expects of them.
class Counting : public gnomon::ShadowTechnique {
public:
    std::vector<osg::ref_ptr<gnomon::Mark>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                    const gnomon::Casters& casters) const override {
        const gnomon::CasterLayers& layers = casters.layers();
        const gnomon::SceneFrame scene(layers.origin);
        const auto seen =
            gnomon::VolumeCache().see(layers, view, light.number, *gnomon::lightInScene(light.inGroup, scene), scene);
        if (seen) drawn = drawnOf(*seen);
        gnomon::OpenCasters known;
        const auto inGroup = gnomon::lightInScene(light.inGroup, gnomon::SceneFrame(osg::Vec3d()));
        expected = gnomon::forecastVolumes(view, layers, *inGroup, known);
        again = gnomon::forecastVolumes(view, layers, *inGroup, known);
        return {};
    }

    mutable Work drawn;
    mutable gnomon::VolumeForecast expected, again; ///< the second without a look at edges.
};

/// Boards of all directions, none connected with another.
Mesh leaves(int count, const glm::dvec3& low, const glm::dvec3& high) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const auto any = [&] { return glm::dvec3(share(random), share(random), share(random)); };
    Mesh all;
    for (int i = 0; i < count; ++i) {
        const Mesh leaf = quad(low + any() * (high - low), 0.3 * (any() - 0.5), 0.3 * (any() - 0.5));
        all.insert(all.end(), leaf.begin(), leaf.end());
    }
    return all;
}

/// A box's triangles from `first` on, `count` of them.
Mesh partOfBox(std::size_t first, std::size_t count) {
    const Mesh all = box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0});
    return {all.begin() + std::ptrdiff_t(3 * first), all.begin() + std::ptrdiff_t(3 * (first + count))};
}

View usual() { return perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 160, 120); }

/// @param more  below the group besides, if it is not null.
osg::ref_ptr<Counting> counted(const std::vector<Mesh>& casters, const osg::Vec4d& light, const View& view,
                               osg::Node* more = nullptr) {
    Scene scene = groundScene(casters, 8.0, light);
    if (more) scene.content->addChild(more);
    osg::ref_ptr<Counting> counting = new Counting;
    scene.addShadow(counting);
    render(scene.root, view);
    return counting;
}

void expectSame(const osg::ref_ptr<Counting>& counting) {
    const double rounding = 1e-9 * (1.0 + counting->drawn.sides + counting->drawn.caps);
    for (const gnomon::VolumeForecast& each : {counting->expected, counting->again}) {
        EXPECT_NEAR(each.sides, counting->drawn.sides, rounding);
        EXPECT_NEAR(each.caps, counting->drawn.caps, rounding);
    }
    EXPECT_NEAR(counting->again.pixels, counting->expected.pixels, 1e-9 * counting->expected.pixels);
}

} // namespace

TEST(VolumeForecast, CountsTheFreeEdgesOfSheetsAndTheirBacks) {
    for (const osg::Vec4d& light : {sun, lamp}) {
        const auto counting = counted({leaves(60, {-2.0, -2.0, 1.0}, {2.0, 2.0, 3.0})}, light, usual());
        expectSame(counting);
        EXPECT_EQ(counting->drawn.sides, 4.0 * 61.0) << "with those of the ground";
        EXPECT_GT(counting->drawn.caps, 20.0);
        EXPECT_GT(counting->expected.pixels, 0.0);
    }
}

TEST(VolumeForecast, CountsSheetsThatAreBodiesInTheirOwnFrame) {
    const osg::ref_ptr<osg::MatrixTransform> turned =
        new osg::MatrixTransform(osg::Matrixd::rotate(0.7, osg::Vec3d(0.3, 1.0, 0.2)) *
                                 osg::Matrixd::scale(1.5, 1.5, 1.5) * osg::Matrixd::translate(0.0, 0.0, 3.0));
    turned->addChild(node(leaves(200, {-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0})));
    const auto counting = counted({}, sun, usual(), turned);
    expectSame(counting);
    EXPECT_EQ(counting->drawn.sides, 4.0 * 201.0);
    EXPECT_GT(counting->drawn.caps, 60.0);
}

TEST(VolumeForecast, CountsWhatClosesVolumesThatTheNearPlaneCuts) {
    const View view = perspective({-3.0, -3.0, 3.0}, {0.0, 0.0, 1.5}, 160, 120, 40.0, 3.0, 40.0);
    const auto counting = counted({leaves(60, {-2.0, -2.0, 1.0}, {2.0, 2.0, 3.0})}, sun, view);
    const auto uncut = counted({leaves(60, {-2.0, -2.0, 1.0}, {2.0, 2.0, 3.0})}, sun,
                               perspective({-3.0, -3.0, 3.0}, {0.0, 0.0, 1.5}, 160, 120, 40.0, 0.1, 40.0));
    expectSame(counting);
    EXPECT_GT(counting->drawn.caps, uncut->drawn.caps);
}

TEST(VolumeForecast, TakesDrawablesThatCloseEachOtherForOneBody) {
    const auto counting = counted({partOfBox(0, 5), partOfBox(5, 7)}, sun, usual());
    expectSame(counting);
    EXPECT_EQ(counting->drawn.sides, 6.0 + 4.0);
    EXPECT_EQ(counting->drawn.caps, 0.0) << "nobody sees a back";
    const auto open = counted({partOfBox(0, 10)}, sun, usual());
    expectSame(open);
}

// 48 slices have an outline of some hundred edges. A factor of 3 is what auto allows for.
TEST(VolumeForecast, LooksAtNoEdgeOfClosedCasters) {
    const auto counting = counted({sphere({0.0, 0.0, 2.0}, 1.0)}, sun, usual());
    EXPECT_LT(counting->expected.sides, 3.0 * counting->drawn.sides);
    EXPECT_GT(counting->expected.sides, counting->drawn.sides / 3.0);
    EXPECT_EQ(counting->expected.caps, 0.0);
}

namespace {

/// As in a program that counts no frames.
class Uncounted : public gnomon::ShadowTechnique {
public:
    std::vector<osg::ref_ptr<gnomon::Mark>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                    const gnomon::Casters& casters) const override {
        const gnomon::CasterLayers& layers = casters.layers();
        const gnomon::SceneFrame scene(layers.origin);
        gnomon::ViewFrame uncounted = view;
        uncounted.frameNumber = 0;
        _cache.see(layers, uncounted, light.number, *gnomon::lightInScene(light.inGroup, scene), scene);
        if (!first.valid()) first = layers.meshes().front().mesh.get();
        return {};
    }

    mutable osg::observer_ptr<const gnomon::CasterMesh> first;

private:
    mutable gnomon::VolumeCache _cache;
};

} // namespace

TEST(VolumeCache, LetsGoWhatIsGoneWhereNobodyCountsFrames) {
    Scene scene = groundScene({box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})}, 8.0, sun);
    const osg::ref_ptr<Uncounted> technique = new Uncounted;
    scene.addShadow(technique);
    Camera camera(scene.root, usual());
    camera.frame();
    const osg::observer_ptr<const gnomon::CasterMesh> first = technique->first;
    ASSERT_TRUE(first.valid());
    scene.content->removeChild(find(*scene.root, "caster"));
    for (int i = 0; i < 80; ++i) camera.frame();
    EXPECT_FALSE(first.valid());
}
