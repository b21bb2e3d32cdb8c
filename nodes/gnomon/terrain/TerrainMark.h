// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/terrain/TileBitmap.h>
#include <gnomon/terrain/TileShadows.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/StateSet>

#include <memory>
#include <vector>

namespace gnomon {

class PlanCoverage;
struct LayerSlice;

/// Decals in one view.
struct SeenDecals {
    const TileMesh* mesh;
    osg::ref_ptr<const TileBitmap> bitmap; ///< that may be drawn in place of the mesh; or null.
};

/// Marks of one light in one view: all that decals cover, and all that stands in a prism. What of that is ground is for
/// the compositor to tell, which cuts the marks to the receiver.
class TerrainMark : public MarkJob {
public:
    std::vector<osg::ref_ptr<const TileShadows>> tiles; ///< whose meshes these are, so that none is changed:
    std::vector<SeenDecals> decals;
    std::vector<const TileMesh*> prisms;                      ///< each with a layer or more.
    osg::ref_ptr<const osg::StateSet> program, bitmapProgram; ///< see shaderProgram().
    glm::dmat4 clipFromScene{1.0};                            ///< see SceneFrame.
    /// Of the depth in clip space: decals are drawn so much nearer, on the same pixels, for the ground is drawn by other
    /// numbers than they are.
    double decalsNearer = 0.0;
    bool fromAbove = false; ///< decals that are turned away are on ground that is not seen.
    osg::Matrixd sceneFromEye;
    std::shared_ptr<const PlanCoverage> coverage; ///< of the tiles; null: not known.

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool counts() const override { return !prisms.empty(); }
    double depthSteps() const override { return prisms.empty() ? 0.0 : 1.0; }
    BoxTest boxTest(const osg::Matrixd& eyeFromBox) const override;

protected:
    ~TerrainMark() override = default;

private:
    std::vector<std::vector<LayerSlice>> roundsOf(unsigned counters) const;
    glm::dmat4 clipFromNearerScene() const;
    std::string markDecals(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const;
    bool drawBitmaps(osg::RenderInfo& renderInfo) const;
};

} // namespace gnomon
