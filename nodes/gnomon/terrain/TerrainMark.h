// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/overlay/ShadowDecals.h>
#include <gnomon/terrain/TileBitmap.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/StateSet>

#include <memory>
#include <vector>

namespace gnomon {

class PlanCoverage;
struct LayerSlice;
struct ShadowPrisms;
struct TileShadows;

/// Prisms over shadows on the ground, or decals on it, ready to be drawn.
class TerrainMesh : public osg::Referenced {
public:
    TerrainMesh();
    /// In place of those before, in the same buffers. Not while they are drawn.
    void set(const ShadowPrisms& prisms);
    void set(const ShadowDecals& decals); ///< as a layer.

    unsigned triangles() const { return _ends.empty() ? 0 : _ends.back() / 3; }
    unsigned layers() const { return static_cast<unsigned>(_ends.size()); }
    void draw(osg::RenderInfo& renderInfo, unsigned firstLayer, unsigned count) const;
    void resizeGLObjectBuffers(unsigned maxSize) { _geometry->resizeGLObjectBuffers(maxSize); }
    void releaseGLObjects(osg::State* state) const { _geometry->releaseGLObjects(state); }

    glm::dvec3 low{0.0}, high{0.0}; ///< bounds, about the casters' origin.
    unsigned mostOver = 0;          ///< see ShadowPrisms.

protected:
    ~TerrainMesh() override = default;

private:
    template <typename Shadows, typename Append>
    void setFrom(const Shadows& of, Append append);
    osg::Vec3Array& vertices();
    osg::DrawElementsUInt& corners();
    osg::ref_ptr<osg::Geometry> _geometry;
    std::vector<unsigned> _ends; ///< of each layer among the corners.
};

/// Decals in one view.
struct SeenDecals {
    const TerrainMesh* mesh;
    osg::ref_ptr<const TileBitmap> bitmap; ///< that may be drawn in place of the mesh; or null.
};

/// Marks of one light in one view: all that decals cover, and all that stands in a prism. What of that is ground is for
/// the compositor to tell, which cuts the marks to the receiver.
class TerrainMark : public MarkJob {
public:
    std::vector<osg::ref_ptr<const TileShadows>> tiles; ///< whose meshes these are, so that none is changed:
    std::vector<SeenDecals> decals;
    std::vector<const TerrainMesh*> prisms;                   ///< each with a layer or more.
    osg::ref_ptr<const osg::StateSet> program, bitmapProgram; ///< see shaderProgram().
    glm::dmat4 clipFromPrisms{1.0};
    /// Of the depth in clip space: decals are drawn so much nearer, on the same pixels, for the ground is drawn by other
    /// numbers than they are.
    double decalsNearer = 0.0;
    bool fromAbove = false; ///< decals that are turned away are on ground that is not seen.
    osg::Matrixd prismsFromEye;
    std::shared_ptr<const PlanCoverage> coverage; ///< of the tiles; null: not known.

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool counts() const override { return !prisms.empty(); }
    BoxTest boxTest(const osg::Matrixd& eyeFromBox) const override;

protected:
    ~TerrainMark() override = default;

private:
    std::vector<std::vector<LayerSlice>> roundsOf(unsigned counters) const;
    glm::dmat4 clipFromDecals() const;
    std::string markDecals(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const;
    bool drawBitmaps(osg::RenderInfo& renderInfo) const;
};

} // namespace gnomon
