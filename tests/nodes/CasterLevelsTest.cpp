// SPDX-License-Identifier: MIT
// Levels of detail: each view's casters are those that its cull shows, and no level is read twice.
#include "Scene.h"

#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/CasterTable.h>
#include <gnomon/casters/Casting.h>

#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/LOD>
#include <osg/PagedLOD>
#include <osg/Sequence>
#include <osg/Switch>
#include <osg/observer_ptr>
#include <osgUtil/CullVisitor>

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

using namespace scene;
using gnomon::CasterView;

namespace {

using Drawables = std::multiset<const osg::Drawable*>;

/// A triangle that counts how often its vertices are read.
class Counted : public osg::Geometry {
public:
    explicit Counted(double x) {
        setVertexArray(
            vec3s({{static_cast<float>(x), 0, 0}, {static_cast<float>(x) + 1, 0, 0}, {static_cast<float>(x), 1, 0}}));
        addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
        _box = osg::BoundingBox(static_cast<float>(x), 0, 0, static_cast<float>(x) + 1, 1, 1);
        setInitialBound(_box);
    }
    osg::BoundingBox computeBoundingBox() const override { return _box; } // without a read
    void accept(osg::PrimitiveFunctor& functor) const override {
        ++reads;
        osg::Geometry::accept(functor);
    }
    using osg::Geometry::accept;
    mutable int reads = 0;

private:
    osg::BoundingBox _box;
};

CasterView viewFrom(const osg::Vec3d& eye, const void* key = nullptr) {
    CasterView view;
    view.eyeFromGroup = osg::Matrixd::lookAt(eye, osg::Vec3d(), osg::Vec3d(0, 1, 0));
    view.projection = osg::Matrixd::perspective(40.0, 4.0 / 3.0, 1.0, 1000.0);
    view.viewport = new osg::Viewport(0, 0, 400, 300);
    view.key = key;
    return view;
}

Drawables castersOf(const gnomon::ShadowCasterGroup& group, const CasterView* view) {
    Drawables result;
    for (const auto& piece : group.casters(view)->list) result.insert(piece->drawable.get());
    return result;
}

/// Drawables that a cull of a view goes to, in sight or not.
class Shown : public osg::Drawable::CullCallback {
public:
    bool cull(osg::NodeVisitor*, osg::Drawable* drawable, osg::RenderInfo*) const override {
        drawn.insert(drawable);
        return true;
    }
    mutable Drawables drawn;
};

/// Goes through a graph as a view's cull does. @return where it draws what, in the group's frame.
std::map<const osg::Drawable*, osg::Matrixd> culled(osg::Node& root, const CasterView& view) {
    osg::ref_ptr<osgUtil::CullVisitor> cull = new osgUtil::CullVisitor;
    cull->setCullingMode(osg::CullSettings::NO_CULLING);
    cull->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    cull->setLODScale(view.lodScale);
    osg::ref_ptr<osgUtil::StateGraph> graph = new osgUtil::StateGraph;
    osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    cull->setStateGraph(graph);
    cull->setRenderStage(stage);
    cull->pushViewport(view.viewport);
    cull->pushProjectionMatrix(new osg::RefMatrix(view.projection));
    cull->pushModelViewMatrix(new osg::RefMatrix(view.eyeFromGroup), osg::Transform::ABSOLUTE_RF);
    root.accept(*cull);
    cull->popModelViewMatrix();
    cull->popProjectionMatrix();
    cull->popViewport();
    std::map<const osg::Drawable*, osg::Matrixd> drawn;
    for (const auto& leaf : graph->_leaves)
        drawn[leaf->getDrawable()] = *leaf->_modelview * osg::Matrixd::inverse(view.eyeFromGroup);
    return drawn;
}

Drawables shownBy(osg::Node& root, const CasterView& view, Shown& shown) {
    shown.drawn.clear();
    culled(root, view);
    return shown.drawn;
}

/// Random transforms, levels by distance and by pixels, and levels within levels.
class RandomGraph {
public:
    explicit RandomGraph(unsigned seed) : _random(seed) {}

    osg::ref_ptr<osg::Node> node(int depth) {
        if (depth == 0) return leaf();
        const int kind = std::uniform_int_distribution(0, 3)(_random);
        osg::ref_ptr<osg::Group> group;
        if (kind == 0) {
            const osg::Vec3d by(number(-30, 30), number(-30, 30), number(-5, 5));
            group = new osg::MatrixTransform(osg::Matrixd::scale(number(0.5, 2), 1, 1) *
                                             osg::Matrixd::rotate(number(0, 6), osg::Vec3d(1, 2, 3)) *
                                             osg::Matrixd::translate(by));
        } else if (kind == 1) {
            group = new osg::Group;
        } else {
            return levels(kind == 2, depth);
        }
        for (int i = 0; i < 2; ++i) group->addChild(node(depth - 1));
        return group;
    }
    const osg::ref_ptr<Shown> shown = new Shown;

private:
    double number(double low, double high) { return std::uniform_real_distribution(low, high)(_random); }

    osg::ref_ptr<osg::Node> levels(bool byPixels, int depth) {
        const osg::ref_ptr<osg::LOD> lod = number(0, 1) < 0.5 ? new osg::LOD : new osg::PagedLOD;
        lod->setRangeMode(byPixels ? osg::LOD::PIXEL_SIZE_ON_SCREEN : osg::LOD::DISTANCE_FROM_EYE_POINT);
        const auto cut = static_cast<float>(byPixels ? number(5, 200) : number(20, 120));
        lod->addChild(node(depth - 1), 0.0f, cut);
        lod->addChild(node(depth - 1), cut, 1e9f);
        return lod;
    }

    osg::ref_ptr<osg::Node> leaf() {
        const osg::ref_ptr<osg::Geometry> geometry = triangle();
        geometry->setCullCallback(shown);
        return geodeOf(geometry.get());
    }

    std::mt19937 _random;
};

/// A ground, and four levels of detail that are coarse beyond 50.
struct Flight {
    Flight() {
        group->addChild(geodeOf(ground.get()));
        for (int i = 0; i < 4; ++i) {
            const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
            lod->setCenter(osg::Vec3(100.0f * static_cast<float>(i), 0, 0));
            for (const bool coarse : {false, true}) {
                levels.push_back(new Counted(100.0 * i));
                lod->addChild(geodeOf(levels.back().get()), coarse ? 50.0f : 0.0f, coarse ? 1e9f : 50.0f);
            }
            lods.push_back(lod);
            group->addChild(lod);
        }
    }
    int reads() const {
        int sum = 0;
        for (const auto& level : levels) sum += level->reads;
        return sum;
    }

    osg::ref_ptr<Counted> ground = new Counted(0.0);
    std::vector<osg::ref_ptr<Counted>> levels;
    std::vector<osg::ref_ptr<osg::LOD>> lods;
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
};

} // namespace

TEST(CasterLevels, AreThoseThatACullOfTheViewShows) {
    int choices = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        RandomGraph graph(seed);
        const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
        group->addChild(graph.node(5));
        const Drawables finest = castersOf(*group, nullptr);
        for (const double far : {3.0, 40.0, 90.0, 400.0})
            for (const float scale : {1.0f, 0.4f, 3.0f}) {
                CasterView view = viewFrom({far, 0.3 * far, 0.2 * far}, &view);
                view.lodScale = scale;
                const Drawables casters = castersOf(*group, &view);
                EXPECT_EQ(casters, shownBy(*group, view, *graph.shown)) << seed << " " << far << " " << scale;
                choices += casters != finest;
            }
    }
    EXPECT_GT(choices, 100) << "too few cases choose";
}

/// Signs by each mode, one of them on another and under a level, and trees by each mode.
osg::ref_ptr<osg::Group> turningScene() {
    const osg::ref_ptr<osg::Group> content =
        new osg::MatrixTransform(osg::Matrixd::rotate(0.4, osg::Vec3d(1, 2, 3)) * osg::Matrixd::translate(3, -2, 5));
    osg::ref_ptr<osg::AutoTransform> last;
    double x = 0.0;
    for (const auto mode : {osg::AutoTransform::ROTATE_TO_SCREEN, osg::AutoTransform::ROTATE_TO_CAMERA,
                            osg::AutoTransform::ROTATE_TO_AXIS, osg::AutoTransform::ROTATE_TO_CAMERA}) {
        const osg::ref_ptr<osg::AutoTransform> sign = new osg::AutoTransform;
        sign->setPosition({x, 2.0 * x, -x});
        sign->setAxis({0, 0, 1});
        sign->setNormal({0, -1, 0});
        sign->setAutoRotateMode(mode);
        const osg::ref_ptr<osg::LOD> level = new osg::LOD;
        level->addChild(triangle(), 0.0f, 1e6f);
        sign->addChild(level);
        (x == 9.0 ? last.get() : content.get())->addChild(sign);
        last = sign;
        x += 3.0;
    }
    for (const auto mode :
         {osg::Billboard::POINT_ROT_EYE, osg::Billboard::POINT_ROT_WORLD, osg::Billboard::AXIAL_ROT}) {
        const osg::ref_ptr<osg::Billboard> trees = new osg::Billboard;
        trees->setMode(mode);
        trees->setNormal({0, -1, 0});
        for (const float y : {0.0f, 7.0f}) trees->addDrawable(triangle(), osg::Vec3(static_cast<float>(x), y, 1.0f));
        content->addChild(trees);
        x += 3.0;
    }
    return content;
}

TEST(TurningCasters, StandAsACullOfEachViewDrawsThem) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(turningScene());
    EXPECT_TRUE(group->casters()->list.empty()) << "without a view nothing turns";
    const CasterView views[] = {viewFrom({30, 20, 40}, &views[0]), viewFrom({-50, 3, 20}, &views[1])};
    for (const CasterView& view : views) {
        auto drawn = culled(*group, view);
        const auto casters = group->casters(&view);
        ASSERT_EQ(drawn.size(), 10u);
        ASSERT_EQ(casters->list.size(), 10u);
        for (const auto& piece : casters->list)
            for (int i = 0; i < 16; ++i) // a billboard turns by floats
                EXPECT_NEAR(piece->groupFromLocal.ptr()[i], drawn[piece->drawable.get()].ptr()[i], 1e-4) << i;
    }
    const unsigned before = group->revision();
    for (const CasterView& view : views) group->casters(&view);
    EXPECT_EQ(group->revision(), before) << "two views that rest change nothing";
}

TEST(CasterLevels, WithoutAViewAreTheFinest) {
    const Flight flight;
    const Drawables casters = castersOf(*flight.group, nullptr);
    for (std::size_t i = 0; i < flight.levels.size(); ++i)
        EXPECT_EQ(casters.count(flight.levels[i]), i % 2 ? 0u : 1u) << i;
    EXPECT_EQ(flight.group->casters()->layers().triangles(), 5u);
}

TEST(CasterLevels, AreReadOnceOnAFlightToAndFro) {
    const Flight flight;
    for (int round = 0; round < 5; ++round)
        for (int step = 0; step < 80; ++step) {
            const double x = 10.0 * (step < 40 ? step : 80 - step) - 40.0;
            const CasterView view = viewFrom({x, 0.0, 20.0}, &flight);
            const auto casters = flight.group->casters(&view);
            EXPECT_EQ(casters->layers().triangles(), 5u);
            EXPECT_EQ(casters->list.size(), 5u);
        }
    EXPECT_EQ(flight.reads(), 8) << "two levels at four places";
}

/// It plays to the end and again, as an animation does.
TEST(CasterLevels, OfASequenceAreReadOnce) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    const osg::ref_ptr<osg::Sequence> sequence = new osg::Sequence;
    std::vector<osg::ref_ptr<Counted>> all;
    for (int i = 0; i < 8; ++i) {
        all.push_back(new Counted(i));
        sequence->addChild(geodeOf(all.back().get()));
    }
    group->addChild(sequence);
    const CasterView view = viewFrom({0, 0, 20}, group.get());
    for (int step = 0; step < 40; ++step) {
        sequence->setValue(step % 8);
        const auto casters = group->casters(&view);
        ASSERT_EQ(casters->list.size(), 1u);
        EXPECT_EQ(casters->list.front()->drawable, all[std::size_t(step % 8)]);
        EXPECT_EQ(casters->layers().triangles(), 1u);
    }
    for (const auto& each : all) EXPECT_EQ(each->reads, 1);
}

TEST(CasterLevels, OfEachViewAreItsOwnAndStay) {
    const Flight flight;
    const CasterView near = viewFrom({0, 0, 20}, &near), far = viewFrom({0, 0, 500}, &far);
    const auto nearOnes = flight.group->casters(&near), farOnes = flight.group->casters(&far);
    EXPECT_NE(nearOnes, farOnes);
    const unsigned revision = flight.group->revision();
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_EQ(flight.group->casters(&near), nearOnes);
        EXPECT_EQ(flight.group->casters(&far), farOnes);
    }
    EXPECT_EQ(flight.group->revision(), revision);
}

TEST(CasterLevels, ThatLeaveTheGraphLeaveMemory) {
    Flight flight;
    const CasterView near = viewFrom({0, 0, 20}, &near), far = viewFrom({0, 0, 500}, &near);
    for (const CasterView* view : {&near, &far}) flight.group->casters(view);
    const osg::observer_ptr<Counted> fine = flight.levels[0].get(), coarse = flight.levels[1].get();
    flight.group->removeChild(flight.lods[0]);
    flight.lods.erase(flight.lods.begin());
    flight.levels.erase(flight.levels.begin(), flight.levels.begin() + 2);
    for (int frame = 0; frame < 300; ++frame) flight.group->casters(&near);
    EXPECT_FALSE(fine.valid());
    EXPECT_FALSE(coarse.valid());
}

TEST(CasterLevels, AreRetiredOnceTheyAreReplaced) {
    const osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    const osg::ref_ptr<osg::MatrixTransform> body = triangleAt(1.0);
    group->addChild(body);
    const osg::ref_ptr<const gnomon::Casters> casters = group->casters();
    casters->layers();
    EXPECT_FALSE(casters->isRetired());
    body->setMatrix(osg::Matrixd::translate(2.0, 0.0, 0.0));
    group->casters();
    EXPECT_TRUE(casters->isRetired());
    EXPECT_TRUE(casters->layers().still->loose->sources.empty()) << "whoever keeps the mesh keeps no removed caster";
}
