// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/GlState.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/map/MapPrograms.h>
#include <gnomon/mapfit/MapFit.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <osg/RenderInfo>
#include <osg/State>
#include <osg/Texture2D>

#include <map>
#include <string>
#include <vector>

namespace gnomon {

/// What one light's maps are to show. Never changed once made, so that a frame that is still drawn keeps its own.
struct MapPicture : public osg::Referenced {
    /// A map, in a square part of the texture.
    struct Tile {
        glm::ivec2 corner{0};
        glm::dmat4 mapFromScene{1.0}; ///< see MapFit. Scene: see SceneFrame.
        MapErrors errors{};
        MapSpread spread{};
        double nearest = 0.0; ///< w of clip space before which nothing is drawn; 0 for a sun.
        PixelRect movers{};   ///< texels outside which nothing moves.

        glm::dmat4 clipFromScene() const; ///< The map's clip space.
    };
    /// A tile, and what of it is drawn.
    struct Window {
        const Tile* tile;
        PixelRect texels;
    };
    /// A mesh, or some of its triangles, at a place.
    struct Mesh {
        osg::ref_ptr<const CullableFaces> triangles;
        glm::dmat4 sceneFromMesh{1.0};
        AlignedBox box;      ///< in the scene.
        bool outside = true; ///< see CullableFaces::isOutside().

        bool operator==(const Mesh& other) const {
            return triangles == other.triangles && sceneFromMesh == other.sceneFromMesh && outside == other.outside;
        }
    };
    /// What is drawn of a layer of the casters. Two are equal if they look alike.
    struct Layer {
        osg::ref_ptr<const MapLayer> of;
        std::vector<Mesh> meshes{};       ///< whole ones.
        std::vector<MapCutout> cutouts{}; ///< those that textures cut out.

        bool operator==(const Layer& other) const;
    };
    Layer still, moving;
    SelfDrawnCasters selfDrawn; ///< they count as moving.
    int size = 0;               ///< of a tile's side, texels.
    std::vector<Tile> tiles;    ///< the finest comes first, for pixels take the first that holds them.
    bool divided = false;       ///< several may hold a place of their light's frame, but not its depth.

    /// True if what moves looks as in another picture.
    bool hasSameMoving(const MapPicture& other) const {
        return moving == other.moving && selfDrawn.areSame(other.selfDrawn);
    }
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
/// Blocks are the least depths in 8 × 8 texels, and, a mipmap level each, in blocks of twice the side up to 256 × 256.
/// Source: G. Guennebaud, L. Barthe and M. Paulin, "Real-time Soft Shadow Mapping by Backprojection", EGSR 2006: a
///         hierarchical map tells how near what blocks the light can be.
///
/// Threads one a context.
class DepthMap : public osg::Referenced {
public:
    /// @param filter  GL_LINEAR compares 2 × 2 texels at once, GL_NEAREST one.
    DepthMap(const glm::ivec2& size, osg::Texture::FilterMode filter);

    const glm::ivec2 size; ///< texels.

    /// Makes the texture of this context show the picture, unless it does.
    /// @return why that cannot be, as a cause for ShadowTechnique::report(); empty if all is well.
    std::string show(osg::RenderInfo& renderInfo, const MapPicture& picture, MapPrograms& programs);
    void bind(osg::State& state, unsigned unit) const { state.applyTextureAttribute(unit, _texture); }
    osg::Texture2D* texture() const { return _texture.get(); }

    /// Makes the blocks of this context those of what it shows, unless they are. After show(). Leaves its program applied.
    /// @return as show(): UncomparedSampler and textures of floats that can be drawn to are needed.
    std::string updateBlocks(osg::State& state, const MapPrograms& programs);
    void bindBlocks(osg::State& state, unsigned unit) const { state.applyTextureAttribute(unit, _blocks); }

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
    Target& targetOf(const osg::State& state);
    std::string draw(osg::RenderInfo& renderInfo, Target& target, const MapPicture& picture, MapPrograms& programs);
    bool drawLevel(osg::State& state, int level) const;

    const osg::ref_ptr<osg::Texture2D> _texture, _saved, _blocks; ///< OpenGL makes each at its first use.
    OpenThreads::Mutex _mutex;
    std::map<unsigned, Target> _targets; ///< by context.
};

} // namespace gnomon
