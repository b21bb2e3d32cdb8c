// SPDX-License-Identifier: MIT
#include "TracedCases.h"

#include <gnomon/Convert.h>

#include <osg/Math>

#include <cmath>

namespace test {
namespace {

/// A level square of `side` × `side` small ones.
Mesh tiles(double half, int side) {
    Mesh mesh;
    const double pitch = 2.0 * half / side;
    for (int i = 0; i < side * side; ++i) {
        const Mesh tile =
            quad({i % side * pitch - half, i / side * pitch - half, 0.0}, {pitch, 0.0, 0.0}, {0.0, pitch, 0.0});
        mesh.insert(mesh.end(), tile.begin(), tile.end());
    }
    return mesh;
}

} // namespace

Scene TracedCase::build() const {
    Scene result = test::scene(light);
    for (std::size_t i = 0; i < meshes.size(); ++i)
        result.content->addChild(test::node(meshes[i], i ? "caster" : "ground"));
    return result;
}

osg::Vec4d sunAt(double azimuth, double elevation) {
    const double turn = osg::DegreesToRadians(azimuth), rise = osg::DegreesToRadians(elevation);
    return {std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise), std::sin(rise), 0.0};
}

TracedCase turned(TracedCase given, const osg::Matrixd& turn) {
    const glm::dmat3 matrix(gnomon::toGlm(turn));
    for (Mesh& mesh : given.meshes)
        for (glm::dvec3& corner : mesh) corner = matrix * corner;
    given.light = given.light * turn;
    given.view.view = osg::Matrixd::inverse(turn) * given.view.view;
    return given;
}

TracedCase tilted(TracedCase given) {
    given.name += ", tilted";
    return turned(std::move(given), osg::Matrixd::rotate(0.6, osg::Vec3d(1.0, 2.0, 0.5)));
}

TracedCase labEight() {
    return {"lab 8",
            {square(8.0), sphere({-2.0, 0.0, 2.5}, 1.0, 64), house({2.0, 0.0}, {2.0, 2.0, 2.0}, 30.0)},
            {1.0, 0.3, 1.2, 0.0},
            perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 640, 480)};
}

TracedCase townOfHouses() {
    std::vector<Mesh> meshes = town(20);
    meshes.insert(meshes.begin(), square(55.0));
    return {"town",
            meshes,
            {1.0, 0.3, 0.7, 0.0},
            perspective({-50.0, -70.0, 40.0}, {0.0, 0.0, 0.0}, 640, 480, 40.0, 1.0, 300.0)};
}

TracedCase room() {
    return {"room",
            {square(5.0, 0.001), insideOut(box({-5.0, -5.0, 0.0}, {5.0, 5.0, 4.0})),
             house({1.5, 1.0}, {1.5, 1.0, 1.2}, 25.0), house({-1.8, 0.5}, {1.0, 1.0, 2.0}, -40.0),
             sphere({0.2, -0.5, 1.5}, 0.5, 64)},
            {0.3, 0.4, 3.2, 1.0},
            perspective({-3.5, -4.7, 3.0}, {0.5, 1.0, 0.8}, 640, 480, 70.0, 0.1, 30.0)};
}

TracedCase longStreet(double azimuth, double elevation) {
    std::vector<Mesh> meshes{quad({-50.0, -200.0, 0.0}, {2100.0, 0.0, 0.0}, {0.0, 400.0, 0.0})};
    for (int i = 0; i < 4 * 130; ++i) {
        const int variety = (i * 7919) % 97;
        const glm::dvec2 place(15.0 * (i / 4), 12.0 * (i % 4) - 18.0 + (i % 4 < 2 ? -2.0 : 2.0));
        meshes.push_back(
            house(place, {5.0 + variety % 5 * 0.8, 5.0 + variety % 7 * 0.5, 3.0 + variety % 11 * 0.6}, variety * 3.7));
    }
    return {"street", meshes, sunAt(azimuth, elevation),
            perspective({-10.0, 0.0, 2.5}, {100.0, 0.0, 0.0}, 640, 480, 40.0, 0.2, 3000.0)};
}

TracedCase flatGround(double half, double height, double elevation, double near, double far, int side) {
    constexpr double azimuth = 11.0;
    return {"flat",
            {tiles(half, side)},
            sunAt(azimuth, elevation),
            perspective({-half / 2.0, -half / 2.0, height}, {0.0, 0.0, 0.0}, 320, 240, 40.0, near, far)};
}

Judge::Judge(const TracedCase& of) : given(of) {
    Scene in = given.build(), out = given.build();
    out.takeLightAway();
    lit = render(in.root, given.view);
    dark = render(out.root, given.view);
}

Picture Judge::with(const osg::ref_ptr<gnomon::ShadowTechnique>& technique) const {
    Scene shadowed = given.build();
    shadowed.addShadow(technique.get());
    return render(shadowed.root, given.view);
}

const gnomon::TruthImage& Judge::truth() const {
    if (!_truth) _truth = given.truth();
    return *_truth;
}

int differingBlocks(const Picture& a, const Picture& b) {
    int blocks = 0;
    for (int y = 1; y + 1 < a.height; ++y)
        for (int x = 1; x + 1 < a.width; ++x) {
            bool all = true;
            for (int i = 0; i < 9; ++i) {
                const int u = x + i % 3 - 1, v = y + i / 3 - 1;
                all = all && a.at(u, v) != b.at(u, v);
            }
            blocks += all;
        }
    return blocks;
}

} // namespace test
