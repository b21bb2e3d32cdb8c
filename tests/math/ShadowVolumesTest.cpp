// SPDX-License-Identifier: MIT
// Volumes behind meshes: how many hold a point is how many triangles are between it and the light.
#include <support/Soup.h>

#include <gnomon/geometry/TerminatorOffset.h>
#include <gnomon/silhouette/ShadowVolumes.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

using gnomon::ShadowVolumes;
using gnomon::SilhouetteMesh;

namespace {

using test::Soup;

Soup box(const glm::dvec3& low, const glm::dvec3& high) {
    Soup soup;
    soup.box(low, high);
    return soup;
}

SilhouetteMesh edgesOf(const Soup& soup) {
    return SilhouetteMesh({soup.vertices.data(), soup.vertices.size(), soup.indices.data(), soup.indices.size()});
}

glm::dvec3 drawn(const glm::vec4& vertex, const glm::dvec4& light) {
    const glm::dvec3 place(vertex);
    return place + double(vertex.w) * gnomon::awayFrom(light, place);
}

/// Of a triangle, as seen from a point (A. van Oosterom, J. Strackee, 1983).
double solidAngle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, const glm::dvec3& from) {
    a -= from, b -= from, c -= from;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double numerator = glm::dot(a, glm::cross(b, c));
    return 2.0 * std::atan2(numerator, la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

/// How often closed surfaces go round a point.
double winding(const std::vector<glm::vec4>& vertices, const std::vector<unsigned>& corners, const glm::dvec4& light,
               const glm::dvec3& point) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); i += 3)
        sum += solidAngle(drawn(vertices[corners[i]], light), drawn(vertices[corners[i + 1]], light),
                          drawn(vertices[corners[i + 2]], light), point);
    return sum / (4.0 * std::acos(-1.0));
}

/// Triangles between a point and the light.
int between(const Soup& soup, const glm::dvec3& point, const glm::dvec4& light) {
    int count = 0;
    for (std::size_t i = 0; i < soup.size(); ++i) {
        const auto t = test::met(soup, i, point, -gnomon::awayFrom(light, point));
        count += t && *t > 0.0 && (light.w == 0.0 || *t < 1.0);
    }
    return count;
}

struct Case {
    const char* name;
    Soup mesh;
    bool closed;
};

Soup randomTriangles() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    const auto any = [&] { return glm::dvec3(place(random), place(random), place(random)); };
    Soup soup;
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 at = any() + glm::dvec3(0.0, 0.0, 2.0);
        soup.triangle(at + 0.6 * any(), at + 0.6 * any(), at + 0.6 * any());
    }
    return soup;
}

std::vector<Case> cases() {
    const Soup house = box({-0.5, -0.4, 0.1}, {1.0, 0.6, 2.0});
    Soup ball, both = house, sheet, mixed, fins;
    ball.sphere({0.0, 0.0, 2.0}, 1.0, 12);
    both.sphere({0.5, 0.0, 2.5}, 1.0, 12);
    sheet.quad({-1.0, -1.0, 1.0}, {2.0, 0.3, 0.5}, {0.0, 2.0, -0.4});
    mixed = ball;
    for (std::size_t i = 0; i < mixed.indices.size(); i += 9) std::swap(mixed.indices[i + 1], mixed.indices[i + 2]);
    const glm::dvec3 a(0.0, -1.0, 2.0), b(0.0, 1.0, 2.0); // three on one edge, as no surface has them
    fins.triangle(a, b, {1.0, 0.0, 2.3});
    fins.triangle(a, b, {-1.0, 0.0, 2.2});
    fins.triangle(b, a, {0.1, 0.0, 3.0});
    return {{"a house", house, true},
            {"a ball", ball, true},
            {"a house turned inside out", house.turned(), true},
            {"two bodies", both, true},
            {"a sheet", sheet, false},
            {"a ball of mixed winding", mixed, false},
            {"fins", fins, false},
            {"random triangles", randomTriangles(), false}};
}

std::vector<glm::dvec4> lights() {
    return {{glm::normalize(glm::dvec3(0.3, 0.2, 1.0)), 0.0},
            {glm::normalize(glm::dvec3(-1.0, 0.4, 0.35)), 0.0},
            {0.4, -0.3, 6.0, 1.0}};
}

TEST(ShadowVolumes, HoldAPointAsOftenAsTrianglesAreBetweenItAndTheLight) {
    const auto planes = gnomon::endPlanes({-3.0, -3.0, -1.0}, {3.0, 3.0, 4.0});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-2.0, 2.0);
    for (const Case& given : cases())
        for (const glm::dvec4& light : lights()) {
            const SilhouetteMesh mesh = edgesOf(given.mesh);
            ShadowVolumes volumes;
            gnomon::findShadowVolumes(mesh, light, planes, volumes);
            gnomon::VolumeCaps caps;
            for (unsigned i = 0; i < mesh.parts.size(); ++i) {
                gnomon::appendLightCap(mesh, volumes, i, caps);
                gnomon::appendDarkCap(mesh, volumes, i, caps);
            }
            int held = 0;
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 point(place(random), place(random), 1.2 * place(random) + 1.5);
                const double count = winding(volumes.vertices, volumes.corners, light, point) +
                                     winding(caps.vertices, caps.corners, light, point);
                const int hidden = between(given.mesh, point, light);
                EXPECT_NEAR(count, std::round(count), 1e-3) << given.name << ": they are closed";
                if (given.closed)
                    EXPECT_EQ(count > 0.5, hidden > 0) << given.name;
                else
                    EXPECT_NEAR(count, hidden, 1e-3) << given.name;
                held += hidden > 0;
            }
            EXPECT_GT(held, 2) << given.name;
        }
}

/// The triangles of a ball of smooth normals that the light sees, each where it casts.
Soup moved(const Soup& ball, const std::vector<glm::vec4>& offsets, const glm::dvec4& light) {
    Soup result;
    for (std::size_t i = 0; i < ball.size(); ++i) {
        glm::dvec3 at[3];
        for (int k = 0; k < 3; ++k) at[k] = ball.corner(i, k);
        const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
        if (!(glm::dot(normal, gnomon::awayFrom(light, at[0])) < 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 away = glm::normalize(gnomon::awayFrom(light, at[k]));
            at[k] += gnomon::terminatorOffset(offsets[ball.indices[3 * i + k]], -away) * away;
        }
        result.triangle(at[0], at[1], at[2]);
    }
    return result;
}

TEST(ShadowVolumes, BeginWhereSmoothBodiesCast) {
    const auto planes = gnomon::endPlanes({-3.0, -3.0, -1.0}, {3.0, 3.0, 4.0});
    const glm::dvec3 centre(0.0, 0.0, 2.0);
    Soup ball;
    ball.sphere(centre, 1.0, 24);
    std::vector<glm::dvec3> places(ball.vertices.begin(), ball.vertices.end());
    std::vector<glm::vec3> normals;
    for (const glm::dvec3& place : places) normals.emplace_back(place - centre);
    const std::vector<glm::vec4> offsets = gnomon::terminatorOffsets(places, normals, ball.indices);
    ASSERT_EQ(offsets.size(), places.size());
    const SilhouetteMesh mesh({ball.vertices.data(), ball.vertices.size(), ball.indices.data(), ball.indices.size(),
                               nullptr, offsets.data()});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.96, 1.01); // just within and without, where facets are behind others
    for (const glm::dvec4& light : lights()) {
        ShadowVolumes volumes;
        gnomon::findShadowVolumes(mesh, light, planes, volumes);
        gnomon::VolumeCaps caps, rim;
        gnomon::appendLightCap(mesh, volumes, 0, caps);
        gnomon::appendDarkCap(mesh, volumes, 0, caps);
        gnomon::appendRim(mesh, volumes, 0, rim);
        EXPECT_GT(rim.corners.size(), 0u);
        // What moves is within one and a half facets of the terminator, and of a facet more a corner is: of a sphere the sine of that.
        EXPECT_LT(double(rim.corners.size()), std::sin(5.0 * std::acos(-1.0) / 24.0) * double(caps.corners.size()));
        const Soup there = moved(ball, offsets, light);
        int before = 0;
        for (int i = 0; i < 400; ++i) {
            const glm::dvec3 point = centre + share(random) * test::randomDirection(random);
            const double count = winding(volumes.vertices, volumes.corners, light, point) +
                                 winding(caps.vertices, caps.corners, light, point);
            const int hidden = between(there, point, light);
            EXPECT_NEAR(count, hidden, 1e-3);
            before += hidden == 0 && between(ball, point, light) > 0;
        }
        EXPECT_GT(before, 10) << "points that the ball would shadow from where it is";
    }
}

TEST(ShadowVolumes, OfABoxHaveTheSixSidesOfItsOutline) {
    const SilhouetteMesh mesh = edgesOf(box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0}));
    ASSERT_EQ(mesh.parts.size(), 1u);
    EXPECT_TRUE(mesh.parts[0].closed);
    ShadowVolumes volumes;
    gnomon::findShadowVolumes(mesh, {glm::normalize(glm::dvec3(1.0, 0.5, 1.0)), 0.0},
                              gnomon::endPlanes({-5.0, -5.0, 0.0}, {5.0, 5.0, 3.0}), volumes);
    EXPECT_EQ(volumes.parts[0].edges, 6u);
    EXPECT_LE(volumes.parts[0].mostOver, 3u);
    EXPECT_EQ(volumes.corners.size(), 6u * 6u);
    EXPECT_EQ(volumes.vertices.size(), 2u * 6u);
}

TEST(ShadowVolumes, AnEdgeOnWallFacesTheLight) {
    const SilhouetteMesh mesh = edgesOf(box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0}));
    for (const double tilt : {-1e-6, 0.0, 1e-6}) {
        ShadowVolumes volumes;
        gnomon::findShadowVolumes(mesh, {glm::normalize(glm::dvec3(1.0, tilt, 1.0)), 0.0}, {}, volumes);
        for (std::size_t i = 0; i < mesh.triangles(); ++i)
            if (std::abs(mesh.planeY[i]) > 0.5) EXPECT_EQ(int(volumes.weights[i]), 1) << tilt;
    }
}

TEST(ShadowVolumes, TellWhetherASideLiesInAFaceAlongTheLight) {
    const SilhouetteMesh mesh = edgesOf(box({-1.0, -1.0, 0.0}, {1.0, 1.0, 3.0}));
    for (const auto& [along, grazed] : {std::pair(0.0, true), {1e-6, true}, {1e-3, false}, {0.5, false}}) {
        ShadowVolumes volumes;
        gnomon::findShadowVolumes(mesh, {glm::normalize(glm::dvec3(1.0, along, 1.0)), 0.0}, {}, volumes);
        EXPECT_EQ(volumes.parts[0].edges, 6u);
        EXPECT_EQ(volumes.parts[0].grazed, grazed) << along;
    }
}

TEST(ShadowVolumes, EndAtThePlaneThatIsNearest) {
    const auto planes = gnomon::endPlanes({-100.0, -100.0, 0.0}, {100.0, 100.0, 10.0});
    const glm::dvec4 high =
        gnomon::nearestEnd(planes, {0.0, 0.0, 0.0}, {1.0, 1.0, 5.0}, {glm::normalize(glm::dvec3(1.0, 0.0, 1.0)), 0.0});
    EXPECT_EQ(glm::dvec3(high), glm::dvec3(0.0, 0.0, 1.0));
    const glm::dvec4 level = gnomon::nearestEnd(planes, {0.0, 0.0, 0.0}, {1.0, 1.0, 5.0}, {1.0, 0.0, 0.0, 0.0});
    EXPECT_EQ(glm::dvec3(level), glm::dvec3(1.0, 0.0, 0.0));
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(gnomon::endPlanes({-inf, 0.0, 0.0}, {inf, 1.0, 1.0}).empty());
    EXPECT_EQ(gnomon::nearestEnd({}, {0.0, 0.0, 0.0}, {1.0, 1.0, 5.0}, {0.0, 0.0, 1.0, 0.0}), glm::dvec4(0.0));
    EXPECT_EQ(gnomon::nearestEnd(planes, {-5.0, -5.0, 0.0}, {5.0, 5.0, 5.0}, {0.0, 0.0, 2.0, 1.0}), glm::dvec4(0.0))
        << "a lamp among it";
}

} // namespace
