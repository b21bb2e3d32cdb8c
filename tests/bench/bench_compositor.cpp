// SPDX-License-Identifier: MIT
// What the compositor adds to a frame for a shadow that covers a given part of the screen, whatever found it, beside all
// that osgShadow::ShadowMap adds, in one interleaved run; the pictures are checked.
#include "Contenders.h"

#include <support/DiscShadow.h>

#include <osg/Geode>
#include <osg/Geometry>

#include <cmath>
#include <cstdio>

namespace {

constexpr int width = 800, height = 600;
constexpr double pi = 3.14159265358979323846;

osg::Vec3 hill(double x, double y) {
    return osg::Vec3d(x, y, 3.0 * std::sin(x * 0.07) * std::cos(y * 0.09) + 1.2 * std::sin(x * 0.31 + y * 0.23));
}

/// Cells [x, x + cells) × [y, y + cells) of a square of 120 m with `side` cells a side.
osg::ref_ptr<osg::Geometry> tile(int side, int x0, int y0, int cells) {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    const double step = 120.0 / side;
    for (int y = y0; y <= y0 + cells; ++y)
        for (int x = x0; x <= x0 + cells; ++x) {
            const double u = x * step - 60.0, v = y * step - 60.0;
            vertices->push_back(hill(u, v));
            osg::Vec3 normal = (hill(u + step, v) - hill(u - step, v)) ^ (hill(u, v + step) - hill(u, v - step));
            normal.normalize();
            normals->push_back(normal);
        }
    for (unsigned y = 0; y < static_cast<unsigned>(cells); ++y)
        for (unsigned x = 0; x < static_cast<unsigned>(cells); ++x) {
            const unsigned row = static_cast<unsigned>(cells) + 1, a = y * row + x;
            for (const unsigned corner : {a, a + 1, a + row, a + row, a + 1, a + row + 1}) triangles->push_back(corner);
        }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(triangles);
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    return geometry;
}

/// @param tiles  a side.
osg::ref_ptr<osg::Group> terrain(int side, int tiles) {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    const int cells = side / tiles;
    for (int y = 0; y < tiles; ++y)
        for (int x = 0; x < tiles; ++x) {
            osg::ref_ptr<osg::Geode> geode = new osg::Geode;
            geode->addDrawable(tile(side, x * cells, y * cells, cells));
            group->addChild(geode);
        }
    return group;
}

osg::ref_ptr<osg::Group> townOnGround() {
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(test::node(test::square(55.0)));
    for (const test::Mesh& house : test::town(20)) group->addChild(test::node(house));
    return group;
}

test::Scene sceneOf(osg::Group* things) {
    test::Scene scene = test::scene({1.0, 0.3, 1.2, 0.0});
    scene.content->addChild(things);
    return scene;
}

/// @param share  of the screen.
osg::ref_ptr<test::DiscShadow> disc(double share) {
    osg::ref_ptr<test::DiscShadow> result =
        new test::DiscShadow({0.5 * width, 0.45 * height}, std::sqrt(share * width * height / pi));
    result->size.set(width, height);
    return result;
}

/// Lit outside the disc, dark inside, to the bit.
bool rightPicture(osg::Group* things, const test::View& view, double share) {
    test::Scene lit = sceneOf(things), dark = sceneOf(things), shadowed = sceneOf(things);
    dark.takeLightAway();
    const auto shadow = disc(share);
    shadowed.addShadow(shadow);
    const test::Picture a = test::render(lit.root, view), b = test::render(dark.root, view),
                        c = test::render(shadowed.root, view);
    int wrong = 0, shaded = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool in = shadow->arriving(x, y) < 0.5;
            shaded += in;
            wrong += c.at(x, y) != (in ? b : a).at(x, y);
        }
    std::printf("  picture: %.1f %% of the screen in shadow, %d pixels wrong\n", 100.0 * shaded / (width * height),
                wrong);
    return wrong == 0;
}

bool run(const std::string& name, osg::Group* things, int frames) {
    const test::View view = test::perspective({-50.0, -70.0, 50.0}, {0.0, 0.0, 0.0}, width, height, 40.0, 1.0, 300.0);
    std::vector<bench::Contender> contenders;
    contenders.push_back(bench::contender("none", sceneOf(things).root, view));
    for (const double share : {0.07, 0.4})
        for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
            test::Scene scene = sceneOf(things);
            scene.addShadow(disc(share));
            scene.group->setComposite(composite);
            const bool blends = composite == gnomon::ShadowCasterGroup::BLEND;
            contenders.push_back(bench::contender(
                (blends ? "blend " : "relight ") + std::string(share < 0.1 ? "7 %" : "40 %"), scene.root, view));
        }
    contenders.push_back(bench::contender("ShadowMap", sceneOf(things).root, view, true));
    std::printf("%s, %dx%d\n", name.c_str(), width, height);
    bench::race(contenders, frames);
    return rightPicture(things, view, 0.07);
}

int measure(osg::ArgumentParser& arguments) {
    const auto frames =
        bench::framesAsked(arguments, "Cost of the compositor for a shadow of 7 % and of 40 % of the screen, beside "
                                      "osgShadow::ShadowMap as a whole; medians of interleaved frames.");
    if (!frames) return 0;
    bool right = run("town of 400 boxes", townOnGround(), *frames);
    right = run("terrain of 200,000 triangles, one drawable", terrain(316, 1), *frames) && right;
    const int few = std::max(3, *frames / 10);
    right = run("terrain of 3,000,000 triangles, one drawable", terrain(1224, 1), few) && right;
    right = run("terrain of 3,000,000 triangles, 256 tiles", terrain(1216, 16), few) && right;
    return right ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_compositor", argc, argv, measure); }
