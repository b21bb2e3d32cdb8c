// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/terrain/HullTiles.h>

#include <osg/StateSet>

#include <vector>

namespace gnomon {

/// Marks of one light in one view: all that stands in a solid. What of that is ground is for the compositor to tell, which
/// cuts the marks to the receiver.
class TerrainMark : public MarkJob {
public:
    struct Tile {
        osg::ref_ptr<const TileShadows> shadows;
        glm::dvec4 light;   ///< as it is now, in the scene.
        bool endsAreUnseen; ///< by lines of sight to the ground.
    };
    std::vector<Tile> tiles;
    osg::ref_ptr<const osg::StateSet> program; ///< see shaderProgram().
    glm::dmat4 clipFromScene{1.0};             ///< see SceneFrame.
    osg::Matrixd sceneFromEye;
    bool testsBoxes = true; ///< boxTest() knows something.

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool counts() const override { return true; }
    BoxTest boxTest(const osg::Matrixd& eyeFromBox) const override;

protected:
    ~TerrainMark() override = default;
};

} // namespace gnomon
