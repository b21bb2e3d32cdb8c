// SPDX-License-Identifier: MIT
// Clusters of a big geometry: what a part of the screen needs of it, and no other picture.
#include <support/DiscShadow.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/gl/TriangleClusters.h>
#include <gtest/gtest.h>
#include <osg/PrimitiveSetIndirect>
#include <osg/VertexProgram>

#include <cmath>
#include <functional>
#include <set>

using namespace test;

namespace {

constexpr int side = 160; // 160² cells, 51,200 triangles, 26 clusters
const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 200, 150);

osg::ref_ptr<osg::Vec3Array> hills() {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            const double u = x * 12.0 / side - 6.0, v = y * 12.0 / side - 6.0;
            vertices->push_back(osg::Vec3d(u, v, 0.4 * std::sin(2.0 * u) * std::cos(1.5 * v)));
        }
    return vertices;
}

unsigned at(int x, int y) { return static_cast<unsigned>(y * (side + 1) + x); }

template <typename List>
osg::ref_ptr<osg::PrimitiveSet> cells(GLenum mode) {
    osg::ref_ptr<List> list = new List(mode);
    const auto add = [&list](std::initializer_list<unsigned> corners) {
        for (const unsigned corner : corners) list->push_back(static_cast<typename List::value_type>(corner));
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            if (mode == GL_QUADS)
                add({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
            else
                add({at(x, y), at(x + 1, y), at(x, y + 1), at(x, y + 1), at(x + 1, y), at(x + 1, y + 1)});
        }
    return list;
}

osg::ref_ptr<osg::Geometry> geometryWith(osg::PrimitiveSet* primitives) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    const osg::ref_ptr<osg::Vec3Array> vertices = hills();
    geometry->setVertexArray(vertices);
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array;
    for (const osg::Vec3& v : *vertices) {
        osg::Vec3 normal(-0.8f * std::cos(2.0f * v.x()), 0.6f * std::sin(1.5f * v.y()), 1.0f);
        normal.normalize();
        normals->push_back(normal);
    }
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    if (primitives) geometry->addPrimitiveSet(primitives);
    return geometry;
}

/// One strip over all rows, with triangles of no area between them.
osg::ref_ptr<osg::Geometry> strip() {
    osg::ref_ptr<osg::DrawElementsUInt> list = new osg::DrawElementsUInt(GL_TRIANGLE_STRIP);
    for (int y = 0; y < side; ++y) {
        if (y) list->push_back(at(0, y + 1));
        for (int x = 0; x <= side; ++x) {
            list->push_back(at(x, y + 1));
            list->push_back(at(x, y));
        }
        list->push_back(at(side, y));
    }
    return geometryWith(list);
}

/// The same triangles without indices, after three corners that are not drawn, an overall colour, in two sets.
osg::ref_ptr<osg::Geometry> arrays() {
    const osg::ref_ptr<osg::Geometry> indexed = geometryWith(cells<osg::DrawElementsUInt>(GL_TRIANGLES));
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(3), normals = new osg::Vec3Array(3);
    const auto& list = static_cast<const osg::DrawElementsUInt&>(*indexed->getPrimitiveSet(0));
    for (const unsigned corner : list) {
        vertices->push_back((*static_cast<osg::Vec3Array*>(indexed->getVertexArray()))[corner]);
        normals->push_back((*static_cast<osg::Vec3Array*>(indexed->getNormalArray()))[corner]);
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    const auto first = static_cast<GLsizei>(list.size() / 6 * 3);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 3, first));
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 3 + first, static_cast<GLsizei>(list.size()) - first));
    return geometry;
}

struct Case {
    std::string name;
    std::function<osg::ref_ptr<osg::Geometry>()> make;
    bool buffers;
};

std::ostream& operator<<(std::ostream& out, const Case& given) { return out << given.name; }

class TriangleClusters : public testing::TestWithParam<Case> {
protected:
    static osg::ref_ptr<osg::Geometry> make() {
        osg::ref_ptr<osg::Geometry> geometry = GetParam().make();
        geometry->setUseDisplayList(!GetParam().buffers);
        geometry->setUseVertexBufferObjects(GetParam().buffers);
        return geometry;
    }
};

Scene sceneOf(osg::Geometry* geometry) {
    Scene scene = test::scene();
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName("hills");
    geode->addDrawable(geometry);
    scene.content->addChild(geode);
    return scene;
}

osg::ref_ptr<DiscShadow> disc(double radius) {
    osg::ref_ptr<DiscShadow> result = new DiscShadow({120.0, 60.0}, radius);
    result->size.set(view.width, view.height);
    return result;
}

/// Corners that `runs` draw, as (primitive set, corner).
std::set<std::pair<unsigned, unsigned>> cornersOf(const std::vector<gnomon::TriangleClusters::Run>& runs) {
    std::set<std::pair<unsigned, unsigned>> corners;
    for (const auto& run : runs)
        for (unsigned i = 0; i < run.count; ++i) corners.insert({run.primitiveSet, run.first + i});
    return corners;
}

} // namespace

TEST_P(TriangleClusters, RedrawnInPartGivesThePictureOfAFullRedraw) {
    const osg::ref_ptr<osg::Geometry> geometry = make();
    ASSERT_TRUE(gnomon::TriangleClusters::of(*geometry)) << "the case is not cut at all";
    for (const bool named : {false, true}) {
        Scene lit = sceneOf(geometry), gone = sceneOf(geometry), shadowed = sceneOf(geometry);
        gone.takeLightAway();
        const auto shadow = disc(25.0);
        if (named) shadow->setReceiver({find(*shadowed.root, "hills")});
        shadowed.addShadow(shadow);
        const Picture a = render(lit.root, view), b = render(gone.root, view);
        int wrong = 0, shaded = 0;
        const Picture c = render(shadowed.root, view);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const bool dark = shadow->arriving(x, y) < 0.5;
                shaded += dark && a.at(x, y) != b.at(x, y);
                wrong += c.at(x, y) != (dark ? b : a).at(x, y);
            }
        EXPECT_GT(shaded, 1000);
        EXPECT_EQ(wrong, 0) << "named " << named;
        EXPECT_EQ(render(test::unfiltered(shadowed.root), view).different(c), 0);
    }
}

TEST_P(TriangleClusters, RunsHoldAllThatTouchesThePartAndLeaveOutMost) {
    const osg::ref_ptr<osg::Geometry> geometry = make();
    const osg::ref_ptr<const gnomon::TriangleClusters> clusters = gnomon::TriangleClusters::of(*geometry);
    const osg::Matrixd clip = view.view * view.projection;
    const gnomon::ScreenRect part{{0.1, -0.3}, {0.2, -0.1}};
    const auto drawn = cornersOf(clusters->touching(part, clip));
    const auto& vertices = static_cast<const osg::Vec3Array&>(*geometry->getVertexArray());
    std::size_t all = 0, missed = 0;
    for (unsigned set = 0; set < geometry->getNumPrimitiveSets(); ++set) {
        const osg::PrimitiveSet& primitives = *geometry->getPrimitiveSet(set);
        all += primitives.getNumIndices();
        for (unsigned i = 0; i < primitives.getNumIndices(); ++i) {
            const osg::Vec4d p = osg::Vec4d(osg::Vec3d(vertices[primitives.index(i)]), 1.0) * clip;
            const bool inside = p.x() >= part.low.x * p.w() && p.x() <= part.high.x * p.w() &&
                                p.y() >= part.low.y * p.w() && p.y() <= part.high.y * p.w();
            missed += inside && !drawn.count({set, i});
        }
    }
    EXPECT_EQ(missed, 0u);
    EXPECT_GT(drawn.size(), 0u);
    EXPECT_LT(drawn.size(), all / 2);
}

TEST_P(TriangleClusters, AreMadeAnewOnlyWhenTheGeometryChanged) {
    const osg::ref_ptr<osg::Geometry> geometry = make();
    const auto first = gnomon::TriangleClusters::of(*geometry);
    EXPECT_EQ(gnomon::TriangleClusters::of(*geometry), first);
    for (osg::Vec3& v : static_cast<osg::Vec3Array&>(*geometry->getVertexArray())) v.z() += 100.0f;
    geometry->getVertexArray()->dirty();
    const auto second = gnomon::TriangleClusters::of(*geometry);
    EXPECT_NE(second, first);
    EXPECT_TRUE(second->touching({{-1.0, -1.0}, {1.0, 1.0}}, view.view * view.projection).empty()); // out of sight
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, TriangleClusters,
    testing::Values(
        Case{"Triangles", [] { return geometryWith(cells<osg::DrawElementsUInt>(GL_TRIANGLES)); }, false},
        Case{"TrianglesInBuffers", [] { return geometryWith(cells<osg::DrawElementsUInt>(GL_TRIANGLES)); }, true},
        Case{"ShortQuads", [] { return geometryWith(cells<osg::DrawElementsUShort>(GL_QUADS)); }, false},
        Case{"ShortQuadsInBuffers", [] { return geometryWith(cells<osg::DrawElementsUShort>(GL_QUADS)); }, true},
        Case{"Strip", strip, false}, Case{"StripInBuffers", strip, true}, Case{"Arrays", arrays, false},
        Case{"ArraysInBuffers", arrays, true}),
    [](const auto& given) { return given.param.name; });

TEST(TriangleClusters, WhatCannotBeCutIsDrawnWhole) {
    const auto make = [] { return geometryWith(cells<osg::DrawElementsUInt>(GL_TRIANGLES)); };
    struct Callback : osg::Drawable::DrawCallback {};
    osg::ref_ptr<osg::Geometry> geometry = make();
    geometry->setDrawCallback(new Callback);
    EXPECT_FALSE(gnomon::TriangleClusters::of(*geometry));
    geometry = make();
    geometry->getPrimitiveSet(0)->setNumInstances(2);
    EXPECT_FALSE(gnomon::TriangleClusters::of(*geometry));
    geometry = make();
    geometry->setInitialBound(osg::BoundingBox(-9.0f, -9.0f, -9.0f, 9.0f, 9.0f, 9.0f)); // a program may move it so far
    EXPECT_FALSE(gnomon::TriangleClusters::of(*geometry));
    geometry = make();
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 5));
    EXPECT_FALSE(gnomon::TriangleClusters::of(*geometry));
    geometry = make();
    geometry->addPrimitiveSet(new osg::DrawElementsIndirectUInt(GL_TRIANGLES));
    EXPECT_FALSE(gnomon::TriangleClusters::of(*geometry));
    EXPECT_FALSE(gnomon::TriangleClusters::of(*node(square(1.0))->getDrawable(0)));
}

// A vertex program of assembly moves what it draws away from the boxes of its clusters.
TEST(TriangleClusters, WhatAProgramMovesIsDrawnWhole) {
    osg::ref_ptr<osg::Geometry> geometry = geometryWith(cells<osg::DrawElementsUInt>(GL_TRIANGLES));
    osg::ref_ptr<osg::VertexProgram> moving = new osg::VertexProgram;
    moving->setVertexProgram("!!ARBvp1.0\n"
                             "PARAM mvp[4] = { state.matrix.mvp };\n"
                             "TEMP p;\n"
                             "ADD p, vertex.position, { -3.0, 0.0, 0.0, 0.0 };\n"
                             "DP4 result.position.x, mvp[0], p;\n"
                             "DP4 result.position.y, mvp[1], p;\n"
                             "DP4 result.position.z, mvp[2], p;\n"
                             "DP4 result.position.w, mvp[3], p;\n"
                             "ADD result.color, state.light[0].diffuse, state.light[0].ambient;\nEND\n");
    geometry->getOrCreateStateSet()->setAttributeAndModes(moving);
    Scene scene = sceneOf(geometry);
    scene.addShadow(disc(25.0));
    const Picture filtered = render(scene.root, view);
    const Picture whole = render(test::unfiltered(scene.root), view);
    EXPECT_EQ(filtered.different(whole), 0);
    Scene lit = sceneOf(geometry);
    EXPECT_GT(render(lit.root, view).different(whole), 1000) << "there is no shadow to compare";
}
