// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/BlockDepths.h>
#include <gnomon/MapCasters.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osg/Texture2D>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// What one light's maps are to show. Never changed once made, so that a frame that is still drawn keeps its own.
struct MapPicture : public osg::Referenced {
    /// A square part of the texture, and what is drawn there.
    struct Tile {
        glm::ivec2 corner{0};
        glm::dmat4 clipFromCaster{1.0}; ///< caster: about their mesh's origin.
    };
    osg::ref_ptr<const CasterFaces> casters;         ///< whole ones; null if there are none.
    bool outside = true;                             ///< the light is in no solid of them.
    std::vector<MapCasters::Cutout> cutouts;         ///< those that textures cut out.
    osg::ref_ptr<const osg::StateSet> program;       ///< see markProgram().
    osg::ref_ptr<const osg::StateSet> cutoutProgram; ///< the same with CUTOUT.
    int size = 0;                                    ///< of a tile's side, texels.
    double slopeOffset = 0.0; ///< how many texels of each surface's own slope it is drawn deeper.
    std::vector<Tile> tiles;

    /// True if a tile of another picture shows the same here, so that it need not be drawn again.
    bool shows(const Tile& tile, const MapPicture& other) const;

protected:
    ~MapPicture() override = default;
};

/// A depth texture that pictures are drawn into, in every context that asks for them.
///
/// Threads one a context.
class DepthMap : public osg::Referenced {
public:
    /// @param filter  GL_LINEAR compares 2 × 2 texels at once, GL_NEAREST one.
    DepthMap(const glm::ivec2& size, osg::Texture::FilterMode filter);

    const glm::ivec2 size; ///< texels.

    /// Makes the texture of this context show the picture, unless it does.
    /// @param drawn  counts tiles drawn.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    std::string show(osg::RenderInfo& renderInfo, const MapPicture& picture, unsigned& drawn);
    void bind(osg::State& state, unsigned unit) const;
    osg::Texture2D* texture() const { return _texture.get(); }

    /// Makes the blocks of this context those of what it shows, unless they are. After show().
    /// @return as BlockDepths::update().
    std::string updateBlocks(osg::State& state, const osg::StateSet& program);
    void bindBlocks(osg::State& state, unsigned unit) const { _blocks->bind(state, unit); }

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

protected:
    ~DepthMap() override;

private:
    struct Target {
        GLuint framebuffer = 0;
        const osg::Texture::TextureObject* texture = nullptr; ///< attached to it.
        osg::ref_ptr<const MapPicture> shown;
        const MapPicture* inBlocks = nullptr; ///< what its blocks are of: `shown`, or none.
    };
    Target& targetOf(unsigned context);
    bool bindTarget(osg::State& state, Target& target) const;
    std::string draw(osg::RenderInfo& renderInfo, Target& target, const MapPicture& picture, unsigned& drawn) const;
    std::string drawCutouts(osg::RenderInfo& renderInfo, const MapPicture& picture,
                            const std::vector<MapPicture::Tile>& tiles) const;

    osg::ref_ptr<osg::Texture2D> _texture;
    osg::ref_ptr<BlockDepths> _blocks; ///< null until they are asked for.
    OpenThreads::Mutex _mutex;
    std::map<unsigned, Target> _targets; ///< by context.
};

} // namespace gnomon
