// SPDX-License-Identifier: MIT
// Which volumes are counted together: none that lie over one another, where a counter tells odd from even alone.
#include <gnomon/volume/LightVolumes.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <support/Mesh.h>

using gnomon::LightVolumes;

namespace {

/// Behind a cube of 2 m about a place in its own frame, which stands somewhere in the scene.
osg::ref_ptr<LightVolumes> behindCube(const glm::dvec3& inFrame, const glm::dmat4& sceneFromFrame,
                                      const glm::dvec4& light) {
    std::vector<glm::vec3> vertices;
    std::vector<unsigned> triangles;
    for (const glm::dvec3& corner : test::box(inFrame - 1.0, inFrame + 1.0)) {
        triangles.push_back(static_cast<unsigned>(vertices.size()));
        vertices.emplace_back(corner);
    }
    const gnomon::SilhouetteMesh::Source source{vertices.data(), vertices.size(), triangles.data(), triangles.size()};
    const osg::ref_ptr<LightVolumes> volumes = new LightVolumes;
    volumes->set({std::make_shared<const gnomon::SilhouetteMesh>(source), sceneFromFrame}, light,
                 {glm::dvec3(-100.0), glm::dvec3(100.0)});
    return volumes;
}

glm::dmat4 moved(double x, double y, double z) { return glm::translate(glm::dmat4(1.0), {x, y, z}); }

} // namespace

/// Two cubes in frames of their own, of which one lies 50 m from its origin: over one another, or apart, in the scene.
TEST(VolumeRounds, OfBodiesInFramesOfTheirOwnGoByTheScene) {
    for (const glm::dvec4& light : {glm::dvec4(0.0, 0.0, 1.0, 0.0), glm::dvec4(0.0, 0.0, 40.0, 1.0)}) {
        const auto first = behindCube(glm::dvec3(0.0), glm::dmat4(1.0), light);
        const auto above = behindCube({50.0, 0.0, 0.0}, moved(-50.0, 0.0, 5.0), light);
        const auto beside = behindCube(glm::dvec3(0.0), moved(20.0, 0.0, 0.0), light);
        const osg::ref_ptr<const gnomon::VolumeRounds> rounds = new gnomon::VolumeRounds({first, above, beside});
        const std::vector<unsigned> apart = rounds->of(1), together = rounds->of(63);
        EXPECT_NE(apart[rounds->firstOf(0)], apart[rounds->firstOf(1)]);
        EXPECT_EQ(apart[rounds->firstOf(0)], apart[rounds->firstOf(2)]);
        EXPECT_EQ(together, std::vector<unsigned>(3, 0u)) << "as many as six bits can count";
    }
}

/// Neighbours of a row of four lie over one another. The first and the last share a round unless those between are asked for.
TEST(VolumeRounds, OfSomePartsAreNoMoreThanTheseNeed) {
    const glm::dvec4 sun(0.0, 0.0, 1.0, 0.0);
    std::vector<osg::ref_ptr<LightVolumes>> row;
    for (const double x : {0.0, 1.5, 4.5, 3.0}) row.push_back(behindCube(glm::dvec3(0.0), moved(x, 0.0, x), sun));
    const osg::ref_ptr<const gnomon::VolumeRounds> rounds = new gnomon::VolumeRounds(row);
    EXPECT_EQ(rounds->of(1, {0, 2}), std::vector<unsigned>(2, 0u));
    EXPECT_EQ(rounds->of(1, {0, 1}), (std::vector<unsigned>{0, 1}));
}
