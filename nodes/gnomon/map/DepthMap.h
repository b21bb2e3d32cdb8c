// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/GlState.h>
#include <gnomon/map/MapCasters.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <osg/RenderInfo>
#include <osg/State>
#include <osg/StateSet>
#include <osg/Texture2D>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

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

class ScratchFramebuffer;

/// What one light's maps are to show. Never changed once made, so that a frame that is still drawn keeps its own.
struct MapPicture : public osg::Referenced {
    /// A square part of the texture, and what is drawn there.
    struct Tile {
        glm::ivec2 corner{0};
        glm::dmat4 clipFromScene{1.0}; ///< The map's clip space. Scene: see SceneFrame.
        double nearest = 0.0;          ///< w of clip space before which nothing is drawn; 0 for a sun.
        PixelRect movers;              ///< texels outside which nothing moves.
    };
    /// A tile, and what of it is drawn.
    struct Part {
        const Tile* tile;
        PixelRect texels;
    };
    /// What is drawn of a layer of the casters. Two are equal if they look alike.
    struct Layer {
        osg::ref_ptr<const MapLayer> of;
        std::vector<MapLayer::Drawn> meshes;   ///< whole ones.
        std::vector<MapLayer::Cutout> cutouts; ///< those that textures cut out.

        bool operator==(const Layer& other) const;
    };
    Layer still, moving;
    OwnCasters own;                                  ///< they count as moving.
    osg::ref_ptr<const osg::StateSet> program;       ///< see shaderProgram().
    osg::ref_ptr<const osg::StateSet> cutoutProgram; ///< the same with CUTOUT.
    int size = 0;                                    ///< of a tile's side, texels.
    std::vector<Tile> tiles;

    /// True if what moves looks as in another picture.
    bool hasSameMoving(const MapPicture& other) const { return moving == other.moving && own.areSame(other.own); }
    /// The tile here that shows, of what stands still, the same as one of another picture; null if there is none.
    const Tile* findStill(const Tile& tile, const MapPicture& other) const;

protected:
    ~MapPicture() override = default;
};

/// A depth texture that pictures are drawn into, in every context that asks for them.
///
/// Where something moves, the depths of what stands still are saved before it is drawn over them, in a texture of the same
/// size that is made when first something moves; and put back before it is drawn elsewhere.
///
/// Threads one a context.
class DepthMap : public osg::Referenced {
public:
    /// @param filter  GL_LINEAR compares 2 × 2 texels at once, GL_NEAREST one.
    DepthMap(const glm::ivec2& size, osg::Texture::FilterMode filter);

    const glm::ivec2 size; ///< texels.

    /// Makes the texture of this context show the picture, unless it does.
    /// @param drawn  counts tiles in which anything is drawn.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    std::string show(osg::RenderInfo& renderInfo, const MapPicture& picture, unsigned& drawn);
    void bind(osg::State& state, unsigned unit) const;
    osg::Texture2D* texture() const { return _texture.get(); }

    /// Makes the blocks of this context those of what it shows, unless they are. After show().
    /// @return as MinDepthPyramid::update().
    std::string updateBlocks(osg::State& state, const osg::StateSet& program);
    void bindBlocks(osg::State& state, unsigned unit) const { _blocks->bind(state, unit); }

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

protected:
    ~DepthMap() override;

private:
    struct Target {
        osg::ref_ptr<const osg::Texture::TextureObject> texture; ///< that shows it.
        osg::ref_ptr<const MapPicture> shown;
        bool inBlocks = false; ///< its blocks are those of what it shows.
    };
    Target& targetOf(unsigned context);
    osg::ref_ptr<osg::Texture2D> savedTexture();
    bool attach(osg::State& state, Target& target, const ScratchFramebuffer& framebuffer) const;
    std::string draw(osg::RenderInfo& renderInfo, Target& target, const MapPicture& picture, unsigned& drawn);
    std::string drawMoving(osg::RenderInfo& renderInfo, const ScratchFramebuffer& framebuffer,
                           const MapPicture& picture, const std::vector<PixelRect>& hidden,
                           const std::vector<MapPicture::Part>& parts);

    osg::ref_ptr<osg::Texture2D> _texture;
    osg::ref_ptr<osg::Texture2D> _saved;   ///< null until something moves.
    osg::ref_ptr<MinDepthPyramid> _blocks; ///< null until they are asked for.
    OpenThreads::Mutex _mutex;
    std::map<unsigned, Target> _targets; ///< by context.
};

} // namespace gnomon
