// SPDX-License-Identifier: MIT
#include "Scene.h"

#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterMesh.h>

#include <osg/ShapeDrawable>
#include <osg/observer_ptr>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <random>
#include <thread>

using namespace scene;
using gnomon::CasterExtraction;
using gnomon::CasterMesh;
using Mode = osg::PrimitiveSet::Mode;

namespace {

osg::ref_ptr<CasterMesh> meshOf(osg::Node& root) {
    CasterExtraction casters;
    root.accept(casters);
    return new CasterMesh(casters);
}

osg::ref_ptr<CasterMesh> meshUnder(const osg::Matrixd& matrix, osg::Node* node) { return meshOf(*under(matrix, node)); }

/// 300 vertices anywhere in a cube of side 20.
osg::ref_ptr<osg::Geometry> scattered() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> side(-10.0f, 10.0f);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(300);
    for (osg::Vec3& v : *vertices) v.set(side(random), side(random), side(random));
    return geometryOf(vertices, new osg::DrawArrays(Mode::TRIANGLES, 0, 300));
}

float ulp(float value) { return std::nextafter(std::abs(value), INFINITY) - std::abs(value); }

} // namespace

TEST(CasterMesh, VerticesAreAboutTheCentreOfTheBounds) {
    const osg::ref_ptr<CasterMesh> mesh =
        meshOf(*geometryOf(vec3s({{2, 0, 0}, {6, 0, 0}, {2, 8, 1}}), new osg::DrawArrays(Mode::TRIANGLES, 0, 3)));
    EXPECT_EQ(mesh->bounds._min, osg::Vec3d(2, 0, 0));
    EXPECT_EQ(mesh->bounds._max, osg::Vec3d(6, 8, 1));
    EXPECT_EQ(mesh->origin, osg::Vec3d(4, 4, 0.5));
    EXPECT_EQ((*mesh->vertices)[0], osg::Vec3(-2, -4, -0.5f));
    EXPECT_EQ((*mesh->vertices)[1], osg::Vec3(2, -4, -0.5f));
    EXPECT_EQ((*mesh->vertices)[2], osg::Vec3(-2, 4, 0.5f));
}

// Floats about the middle of the bounds, half a million metres off, would have steps of 3 cm.
TEST(CasterMesh, VerticesAreAboutThoseThatAreMostWhereOneIsFarAway) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    for (int i = 0; i < 5; ++i) root->addChild(triangle());
    root->addChild(geometryOf(vec3s({{1e6f, 0, 0}, {1e6f + 1.0f, 0, 0}, {1e6f, 1, 0}}),
                              new osg::DrawArrays(Mode::TRIANGLES, 0, 3)));
    const osg::ref_ptr<CasterMesh> mesh = meshOf(*root);
    EXPECT_LE((mesh->origin - osg::Vec3d(0.5, 0.5, 0)).length(), 1.0);
}

TEST(CasterMesh, PointsAndLinesAreNeitherInTheMeshNorInItsBoundsAndVerticesStayShared) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(geometryOf(vec3s({{900, 900, 900}}), new osg::DrawArrays(Mode::POINTS, 0, 1)));
    root->addChild(new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 2.0f)));
    const osg::ref_ptr<CasterMesh> mesh = meshOf(*root);
    EXPECT_EQ(mesh->vertices->size(), 24u); // four a side
    EXPECT_EQ(mesh->triangles->size(), 36u);
    EXPECT_EQ(mesh->bounds._max, osg::Vec3d(1, 1, 1));
    EXPECT_EQ(*std::max_element(mesh->triangles->begin(), mesh->triangles->end()), 23u);
}

TEST(CasterMesh, ASceneMovedByAnEarthRadiusGivesTheSameFloats) {
    const osg::ref_ptr<CasterMesh> here = meshOf(*scattered());
    const osg::ref_ptr<CasterMesh> there = meshUnder(osg::Matrix::translate(6.4e6, -6.4e6, 6.4e6), scattered().get());
    // At 6.4e6 doubles are 2^-30 apart: a vertex is off by half of that, the two ends of the bounds and their mean by
    // as much.
    const float absolute = std::ldexp(1.0f, -29);
    int same = 0;
    for (unsigned i = 0; i < 300; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const float a = (*here->vertices)[i][axis], b = (*there->vertices)[i][axis];
            EXPECT_LE(std::abs(a - b), std::max(ulp(a), absolute));
            same += a == b ? 1 : 0;
        }
    EXPECT_GT(same, 870);                                                                        // of 900
    EXPECT_LT((there->origin - here->origin - osg::Vec3d(6.4e6, -6.4e6, 6.4e6)).length(), 2e-9); // as `absolute`
}

TEST(CasterMesh, AGridOfHalvesIsTheSameToTheBitAnywhere) {
    const osg::ref_ptr<osg::ShapeDrawable> box = new osg::ShapeDrawable(new osg::Box(osg::Vec3(1, 2, 3), 0.5f));
    const osg::ref_ptr<CasterMesh> here = meshOf(*box);
    const osg::ref_ptr<CasterMesh> there = meshUnder(osg::Matrix::translate(6.4e6, 6.4e6, 6.4e6), box.get());
    EXPECT_TRUE(std::equal(here->vertices->begin(), here->vertices->end(), there->vertices->begin()));
}

TEST(CasterMesh, ASceneScaledByAPowerOfTwoIsScaledExactly) {
    const osg::ref_ptr<CasterMesh> one = meshOf(*scattered());
    for (double scale : {std::ldexp(1.0, 10), std::ldexp(1.0, -10)}) {
        const osg::ref_ptr<CasterMesh> scaled = meshUnder(osg::Matrix::scale(scale, scale, scale), scattered().get());
        EXPECT_EQ(scaled->origin, one->origin * scale);
        EXPECT_EQ(scaled->rounding, one->rounding * scale);
        for (unsigned i = 0; i < 300; ++i)
            EXPECT_EQ((*scaled->vertices)[i], (*one->vertices)[i] * static_cast<float>(scale));
    }
}

TEST(CasterMesh, LacksTrianglesThatAreNotFinite) {
    osg::ref_ptr<osg::Geometry> broken = triangle();
    (*static_cast<osg::Vec3Array*>(broken->getVertexArray()))[1].x() = NAN;
    EXPECT_TRUE(meshOf(*broken)->empty());
}

TEST(CasterMesh, HoldsTheArraysItWasMadeOfSoThatNoLaterOneTakesTheirPlace) {
    const osg::ref_ptr<osg::Geometry> geometry = triangle();
    const osg::observer_ptr<osg::Array> vertices = geometry->getVertexArray();
    const osg::observer_ptr<osg::PrimitiveSet> primitives = geometry->getPrimitiveSet(0);
    osg::ref_ptr<CasterMesh> mesh = meshOf(*geometry);
    geometry->setVertexArray(nullptr);
    geometry->removePrimitiveSet(0);
    EXPECT_TRUE(vertices.valid());
    EXPECT_TRUE(primitives.valid());
    mesh = nullptr;
    EXPECT_FALSE(vertices.valid());
    EXPECT_FALSE(primitives.valid());
}

TEST(CasterMesh, KeepsWhatIsDerivedAndLendsWhatIsLent) {
    osg::ref_ptr<CasterMesh> mesh = meshOf(*triangle());
    int made = 0;
    const auto make = [&made] { return std::make_shared<const int>(++made); };
    EXPECT_EQ(mesh->known<int>(), nullptr);
    EXPECT_EQ(*mesh->lent<int>(make), 1);
    EXPECT_EQ(mesh->known<int>(), nullptr) << "nobody has it";
    EXPECT_EQ(*mesh->derived<int>(make), 2);
    EXPECT_EQ(*mesh->derived<int>(make), 2);
    EXPECT_EQ(*mesh->lent<int>(make), 2) << "it is there";
    EXPECT_EQ(*mesh->derived<double>([] { return std::make_shared<const double>(0.5); }), 0.5) << "of another type";
    const std::weak_ptr<const int> kept = mesh->known<int>();
    EXPECT_FALSE(kept.expired());
    mesh = nullptr;
    EXPECT_TRUE(kept.expired());
}

// Each of two makers waits until the other has begun. Who asks while one is made gets the same.
TEST(CasterMesh, MakesTwoAtOnceAndEachOnce) {
    const osg::ref_ptr<CasterMesh> mesh = meshOf(*triangle()), other = meshOf(*triangle());
    for (const auto& second : {mesh, other}) {
        std::promise<void> begun[2];
        const auto waits = [&begun](int own, double value) {
            begun[own].set_value();
            const auto met = begun[1 - own].get_future().wait_for(std::chrono::seconds(20));
            EXPECT_EQ(met, std::future_status::ready) << own;
            return value;
        };
        const auto ask = [&] {
            return *mesh->lent<int>([&] { return std::make_shared<const int>(int(waits(0, 3.0))); });
        };
        auto first = std::async(std::launch::async, ask);
        EXPECT_EQ(*second->lent<double>([&] { return std::make_shared<const double>(waits(1, 4.0)); }), 4.0);
        EXPECT_EQ(first.get(), 3);
    }
    int made = 0;
    const auto slow = [&made] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return std::make_shared<const float>(float(++made));
    };
    auto first = std::async(std::launch::async, [&] { return mesh->derived<float>(slow); });
    EXPECT_EQ(mesh->derived<float>(slow), first.get());
    EXPECT_EQ(made, 1);
}
