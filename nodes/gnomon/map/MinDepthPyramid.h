// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>
#include <osg/State>
#include <osg/StateSet>
#include <osg/Texture2D>

#include <string>

namespace gnomon {

/// The least depth in each block of a depth map: of 8 × 8 texels, and of blocks of twice the side a mipmap level, up to
/// 256 × 256.
///
/// Needs   what UncomparedSampler needs, and textures of floats that can be drawn to.
/// Threads one a context.
/// Source: G. Guennebaud, L. Barthe and M. Paulin, "Real-time Soft Shadow Mapping by Backprojection", EGSR 2006: a
///         hierarchical map tells how near what blocks the light can be.
class MinDepthPyramid : public osg::Referenced {
public:
    /// @param texels  of the map.
    explicit MinDepthPyramid(const glm::ivec2& texels);

    /// Makes them those of a depth map as it is now. Leaves its program applied.
    /// @param program  see blocks.frag.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    std::string update(osg::State& state, const osg::StateSet& program, const osg::Texture2D& map);
    void bind(osg::State& state, unsigned unit) const { state.applyTextureAttribute(unit, _texture); }

    void resizeGLObjectBuffers(unsigned maxSize) { _texture->resizeGLObjectBuffers(maxSize); }
    void release(osg::State* state) { _texture->releaseGLObjects(state); }

protected:
    ~MinDepthPyramid() override = default;

private:
    bool drawLevel(osg::State& state, int level) const;

    const osg::ref_ptr<osg::Texture2D> _texture;
};

} // namespace gnomon
