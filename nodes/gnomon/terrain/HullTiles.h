// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ViewFrame.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/VolumeGeometry.h>
#include <gnomon/ground/HullSolids.h>
#include <gnomon/terrain/CasterTiles.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// The shadows of one tile's casters in one light. Never changed.
struct TileShadows : public osg::Referenced {
    TileShadows(HullSolids from, const glm::dvec4& light) : solids(std::move(from)), found(light) {
        geometry->set(solids.vertices, solids.corners);
    }

    const HullSolids solids;
    const osg::ref_ptr<VolumeGeometry> geometry = new VolumeGeometry;
    const glm::dvec4 found; ///< the light that they were found for, ground's frame.

protected:
    ~TileShadows() override = default;
};

/// What a view shows of shadows on terrain. With CompositorOptions::skipsUntouched off all counts as seen, and as seen exactly.
class TileView {
public:
    /// @param origin  of the tiles' scene, see SceneFrame.
    TileView(const ViewFrame& view, const glm::dvec3& origin);

    const glm::dmat4& clipFromScene() const { return _clipFromScene; }
    struct Shown {
        std::optional<ScreenRect> bounds; ///< nullopt: out of sight, or smaller than a pixel.
        double pixels = 0.0;              ///< that a length of 1 can be there.
        bool isBeforeEye = false;         ///< all of it is.
    };
    Shown shown(const HullSolids& solids) const;
    /// Whether anything can be seen of the shadows of what is in a box: false only of a sun that has risen.
    /// @param low,high,lowest  about the origin; the last one of the ground.
    bool maySeeShadowsOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light, double lowest) const;

private:
    const bool _skipsUntouched;
    const glm::dmat4 _clipFromScene;
    double _mostPixels = 0.0; ///< that a length of 1 can be where w is 1.
};

/// The shadows of one light on a town's ground, tile by tile, kept while the light moves.
///
/// A vertex is drawn by the light as it is now. So a sun that turns a little takes all shadows with it; only what its
/// silhouettes miss of them grows, and where their solids end. A tile that may be seen is found anew at once where its
/// casters changed, where that is seen to be off, and where a solid might end above the ground. The others are brought up to
/// date a few a frame, those that are off most first.
class HullTiles {
public:
    using List = std::vector<osg::ref_ptr<const TileShadows>>;

    /// @param ground  the same until groundChanged().
    void update(const CasterTiles& town, const HullGround& ground, const glm::dvec4& light, const TileView& view);
    void groundChanged() { _states.clear(); }

    const List& shadows() const { return _shadows; } ///< null: not found yet.
    std::vector<std::string> causes() const;         ///< of all that are kept.
    unsigned found() const { return _found; }        ///< how many tiles' shadows, so far.

    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    bool isDue(std::size_t tile, const CasterTiles& town, const HullGround& ground, const TileView& view);
    void find(const CasterTiles& town, const HullGround& ground, const std::vector<std::size_t>& tiles);

    List _shadows;
    std::vector<std::uint64_t> _states; ///< revisions of the tiles that the shadows are of.
    struct Late {
        std::size_t tile;
        double off; ///< of what it may be.
    };
    std::vector<Late> _late;
    glm::dvec4 _light{0.0};
    bool _groundShadowsItself = false;
    unsigned _found = 0;
};

/// Shadows of one tile without a view. @param light  ground's frame.
HullSolids shadowsOf(std::size_t tile, const CasterTiles& town, const HullGround& ground, const glm::dvec4& light);

} // namespace gnomon
