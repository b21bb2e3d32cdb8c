// SPDX-License-Identifier: MIT
// What is known of how a terrain is drawn: only what is drawn as it was found takes decals.
#include "Scene.h"

#include <gnomon/terrain/GroundRevision.h>

#include <osg/LOD>

#include <gtest/gtest.h>

using gnomon::TerrainPlace;

namespace {

/// A square, as one primitive of four corners or as two triangles.
osg::ref_ptr<osg::Geode> square(GLenum mode) {
    osg::ref_ptr<osg::DrawElementsUInt> corners = new osg::DrawElementsUInt(mode);
    const std::vector<GLuint> four = {0, 1, 2, 3}, twice = {0, 1, 2, 0, 2, 3};
    for (const GLuint corner : mode == GL_TRIANGLES ? twice : four) corners->push_back(corner);
    return scene::geodeOf(scene::geometryOf(scene::vec3s({{0, 0, 0}, {9, 0, 0}, {9, 9, 1}, {0, 9, 0}}), corners));
}

osg::ref_ptr<const gnomon::GroundRevision> drawn(osg::Node& node) {
    return TerrainPlace::inFrameOf(node, gnomon::Selection()).drawn(nullptr);
}

} // namespace

TEST(GroundRevision, TellsLevelsOfDetailThoughTheyAreDrawnOutsideToo) {
    const osg::ref_ptr<osg::Geode> fine = square(GL_TRIANGLES);
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(fine, 0.0f, 1e6f);
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(fine);
    EXPECT_FALSE(drawn(*root)->hasLevels);
    root->addChild(lod);
    EXPECT_TRUE(drawn(*root)->hasLevels);
}
