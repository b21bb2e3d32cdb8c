// SPDX-License-Identifier: MIT
// OSG's round shapes, and balls of files, as convex parts.
#include <gnomon/VertexTraverser.h>
#include <gnomon/geometry/ConvexParts.h>

#include <osg/Geode>
#include <osg/ShapeDrawable>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

std::vector<gnomon::ConvexPart> partsOf(osg::Shape* shape) {
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(shape));
    gnomon::VertexTraverser traverser;
    geode->accept(traverser);
    std::vector<glm::vec3> positions;
    for (const osg::Vec3d& p : traverser.getVertices()) positions.emplace_back(p.x(), p.y(), p.z());
    const std::vector<unsigned>& triangles = traverser.getTriangles();
    return gnomon::convexParts(positions.data(), positions.size(), triangles.data(), triangles.size());
}

TEST(RoundCasters, OfOsgAreOneConvexPartEach) {
    EXPECT_EQ(partsOf(new osg::Sphere({1.0f, 2.0f, 3.0f}, 1.5f)).size(), 1u);
    EXPECT_EQ(partsOf(new osg::Sphere({0.0f, 0.0f, 0.0f}, 1.0f)).size(), 1u);
    EXPECT_EQ(partsOf(new osg::Cylinder({5.0f, 2.0f, 1.0f}, 0.7f, 3.0f)).size(), 1u);
    EXPECT_LE(partsOf(new osg::Cone({-4.0f, 0.0f, 1.0f}, 0.7f, 3.0f)).size(), 2u); // its floor is apart
    EXPECT_EQ(partsOf(new osg::Capsule({-4.0f, 9.0f, 1.0f}, 0.7f, 3.0f)).size(), 1u);
}

// Its corners are those of the ball: about the middle, by its radius.
TEST(RoundCasters, HaveTheCornersThatTheyAreMadeOf) {
    const auto parts = partsOf(new osg::Sphere({10.0f, 0.0f, 2.0f}, 1.0f));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_GT(parts[0].hull.vertices.size(), 100u);
    for (const glm::dvec3& corner : parts[0].hull.vertices)
        EXPECT_NEAR(glm::distance(corner, glm::dvec3(10.0, 0.0, 2.0)), 1.0, 1e-5);
}

/// A ball by latitudes; one latitude is drawn in by `dent`.
std::vector<gnomon::ConvexPart> ball(double dent) {
    constexpr int rows = 24, columns = 48;
    constexpr double half = 3.14159265358979;
    const auto at = [&](int row, int column) {
        const double rise = half * row / rows, turn = 2.0 * half * (column % columns) / columns;
        const double out = std::sin(rise) * (row == rows / 2 ? 1.0 - dent : 1.0);
        return glm::vec3(glm::dvec3(3.0 + out * std::cos(turn), out * std::sin(turn), 1.0 + std::cos(rise)));
    };
    std::vector<glm::vec3> positions;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            for (const auto& [r, c] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
                positions.push_back(at(row + r, column + c));
    std::vector<unsigned> triangles(positions.size());
    for (unsigned i = 0; i < triangles.size(); ++i) triangles[i] = i;
    return gnomon::convexParts(positions.data(), positions.size(), triangles.data(), triangles.size());
}

TEST(RoundCasters, OfFilesAreOnePartUnlessTheyHaveADent) {
    EXPECT_EQ(ball(0.0).size(), 1u);
    EXPECT_GT(ball(0.03).size(), 1u);
}

} // namespace
