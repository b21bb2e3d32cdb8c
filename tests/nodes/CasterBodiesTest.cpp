// SPDX-License-Identifier: MIT
// Drawables that move as a whole: which mesh they have, and where it is.
#include "Scene.h"

#include <gnomon/Convert.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <osg/observer_ptr>

using gnomon::CasterMesh;
using gnomon::Casters;
using gnomon::PlacedMesh;

namespace {

/// A bent strip of that many triangles, about (100, 0, 0) of its own frame.
osg::ref_ptr<osg::Geometry> strip(unsigned triangles) {
    osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (unsigned i = 0; i < triangles + 2; ++i) {
        const auto step = static_cast<float>(i);
        corners->push_back({100.0f + 0.01f * step, float(i % 2), 0.00001f * step * step});
    }
    return scene::geometryOf(corners, new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, int(triangles) + 2));
}

struct Bodies {
    osg::MatrixTransform& add(osg::Node* node, const osg::Matrixd& matrix) {
        const auto place = scene::under(matrix, node);
        group->addChild(place);
        return *place;
    }
    osg::ref_ptr<const Casters> casters() const {
        const osg::ref_ptr<const Casters> now = group->casters();
        now->layers();
        return now;
    }
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
};

const osg::Matrixd turned = osg::Matrixd::rotate(0.8, osg::Vec3d(1, 2, 3)) * osg::Matrixd::translate(5, 6, 7);

TEST(CasterBodies, KeepTheirMeshWhileTheyMove) {
    Bodies bodies;
    osg::MatrixTransform& place = bodies.add(strip(300), osg::Matrixd());
    bodies.add(strip(20), osg::Matrixd::translate(0, 9, 0));
    const auto first = bodies.casters();
    ASSERT_EQ(first->layers().still->meshes.size(), 2u);
    const osg::ref_ptr<const CasterMesh> mesh = first->layers().still->meshes[1].mesh,
                                         joined = first->layers().still->loose;
    EXPECT_TRUE(first->layers().still->meshes[1].isBody);
    EXPECT_EQ(mesh->triangles->size(), 900u);
    EXPECT_EQ(joined->triangles->size(), 60u);
    for (int step = 1; step < 5; ++step) {
        place.setMatrix(osg::Matrixd::translate(step, 0, 0));
        const auto now = bodies.casters();
        ASSERT_EQ(now->layers().moving->meshes.size(), 1u);
        EXPECT_EQ(now->layers().moving->meshes[0].mesh, mesh);
        EXPECT_EQ(now->layers().still->loose, joined) << "what stands is not made again";
    }
}

TEST(CasterBodies, OfOneGeometryShareAMeshWhereverTheyAre) {
    Bodies bodies;
    const osg::ref_ptr<osg::Geometry> one = strip(300);
    for (int i = 0; i < 5; ++i) bodies.add(one, osg::Matrixd::translate(0, 3 * i, 0));
    const auto casters = bodies.casters();
    ASSERT_EQ(casters->layers().still->meshes.size(), 5u);
    for (const PlacedMesh& placed : casters->layers().still->meshes)
        EXPECT_EQ(placed.mesh, casters->layers().still->meshes[0].mesh);
    EXPECT_EQ(casters->layers().triangles(), 1500u);
}

// The vertices that an extraction in the group's frame finds, in double. Floats about the mesh's origin are off by a
// step of 2 units (1.5 from its middle): 2.4e-7 / 2, by each axis.
TEST(CasterBodies, AreWhereTheirTransformsPutThem) {
    for (const osg::Matrixd& matrix :
         {turned, osg::Matrixd::scale(-1, 1, 1) * turned, osg::Matrixd::scale(2, 2, 0.5) * turned,
          turned * osg::Matrixd::translate(6.4e6, -6.4e6, 6.4e6)}) {
        Bodies bodies;
        bodies.add(strip(300), matrix);
        const auto casters = bodies.casters();
        gnomon::CasterExtraction expected;
        bodies.group->accept(expected);
        const PlacedMesh& placed = casters->layers().still->meshes.at(0);
        ASSERT_EQ(placed.mesh->triangles->size(), expected.getTriangles().size());
        for (std::size_t i = 0; i < expected.getTriangles().size(); ++i) {
            const std::size_t other = !placed.mirrored || i % 3 == 0 ? i
                                      : i % 3 == 1                   ? i + 1
                                                                     : i - 1; // corners turn round
            const osg::Vec3& vertex = (*placed.mesh->vertices)[(*placed.mesh->triangles)[i]];
            const glm::dvec3 found(placed.sceneFromMesh * glm::dvec4(vertex.x(), vertex.y(), vertex.z(), 1.0));
            const osg::Vec3d& meant = expected.getVertices()[expected.getTriangles()[other]];
            ASSERT_LE(glm::distance(found, gnomon::toGlm(meant - casters->layers().origin)), 2e-6) << i;
        }
    }
}

TEST(CasterBodies, HaveTheirNewBoundsWhereTheyMoved) {
    Bodies bodies;
    osg::MatrixTransform& place = bodies.add(strip(300), osg::Matrixd());
    bodies.casters();
    place.setMatrix(turned);
    const auto now = bodies.casters();
    Bodies fresh;
    fresh.add(strip(300), turned);
    const osg::BoundingBoxd expected = fresh.casters()->bounds;
    EXPECT_LE((now->bounds._min - expected._min).length(), 2e-6);
    EXPECT_LE((now->bounds._max - expected._max).length(), 2e-6);
}

TEST(CasterBodies, ThatCannotBePlacedAreJoined) {
    osg::Matrixd projective = turned;
    projective(0, 3) = 0.001;
    for (const osg::Matrixd& matrix : {osg::Matrixd::scale(1, 1, 0) * turned, projective}) {
        Bodies bodies;
        bodies.add(strip(300), matrix);
        const auto casters = bodies.casters();
        ASSERT_EQ(casters->layers().still->meshes.size(), 1u);
        EXPECT_FALSE(casters->layers().still->meshes[0].isBody);
        EXPECT_EQ(casters->layers().triangles(), 300u);
    }
}

TEST(CasterBodies, WhoseArraysChangeAreReadAgain) {
    Bodies bodies;
    const osg::ref_ptr<osg::Geometry> geometry = strip(300);
    bodies.add(geometry, osg::Matrixd());
    const osg::ref_ptr<const CasterMesh> before = bodies.casters()->layers().still->meshes[0].mesh;
    auto& vertices = static_cast<osg::Vec3Array&>(*geometry->getVertexArray());
    vertices[0].z() = 3.0f;
    vertices.dirty();
    const auto now = bodies.casters();
    ASSERT_EQ(now->layers().moving->meshes.size(), 1u);
    EXPECT_NE(now->layers().moving->meshes[0].mesh, before);
    EXPECT_EQ(now->bounds.zMax(), 3.0);
}

TEST(CasterBodies, ThatLeaveTheGraphLeaveMemory) {
    Bodies bodies;
    bodies.add(strip(20), osg::Matrixd());
    osg::observer_ptr<osg::Geometry> gone = bodies.add(strip(300), osg::Matrixd()).getChild(0)->asGeometry();
    const osg::observer_ptr<osg::Array> vertices = gone->getVertexArray();
    bodies.casters();
    bodies.group->removeChild(1);
    for (int frame = 0; frame < 3; ++frame) bodies.casters();
    EXPECT_FALSE(gone.valid());
    EXPECT_FALSE(vertices.valid());
}

} // namespace
