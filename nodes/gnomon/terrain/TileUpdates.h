// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/TurnedAwaySearch.h>
#include <gnomon/onterrain/PackedShadows.h>
#include <gnomon/onterrain/ShadowDrift.h>
#include <gnomon/terrain/CasterTiles.h>
#include <gnomon/terrain/TerrainSettings.h>
#include <gnomon/terrain/TileBitmap.h>
#include <gnomon/terrain/TileShadows.h>
#include <gnomon/terrain/TileVisibility.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// The ground that shadows are found on, and how it is drawn.
struct TileGround {
    const Ground& found;
    const HeightPyramid* drawn; ///< it, if it is drawn triangle by triangle; null: otherwise, or not known.
    double margin;              ///< of what is not, see shadowPrisms().
};

/// Finds the shadows of one tile. @param into  whose memory is used again; its meshes are made anew if it has any.
void findShadows(const TileGround& ground, const CasterTiles::Tile& tile, const glm::dvec4& light,
                 const TerrainSettings& settings, const glm::dvec3& origin, TileShadows& into);

/// The shadows of one light on a town's ground, tile by tile, kept while the light moves.
///
/// A tile that may be seen is found anew at once where its casters changed, and where a shadow may be off by more than the
/// error since it was found, and by so much that it is seen to be: so a jump of the light is right in the frame in which it
/// happens. Of a few shadows whose bound says too little it is found out by how much they are off. What is off by less is
/// brought up to date a few tiles a frame, those that are off most first, and all that is seen soon after the light stands
/// still.
class TileUpdates {
public:
    using List = std::vector<osg::ref_ptr<const TileShadows>>;
    using Bitmaps = std::vector<osg::ref_ptr<const TileBitmap>>;

    TileUpdates();

    /// @param ground   the same until groundChanged().
    /// @param seconds  to be spent on what may wait.
    void update(const CasterTiles& town, const TileGround& ground, const glm::dvec4& light,
                const TerrainSettings& settings, const TileVisibility& view, double seconds);
    void groundChanged();

    const List& shadows() const { return _shadows; }
    /// What this view is to draw in place of decals, tile by tile; null: the decals themselves. Made where there is none yet,
    /// or one too coarse, or far too fine.
    Bitmaps bitmapsIn(const TileVisibility& view, const TileGround& ground);
    const std::vector<std::string>& causes() const { return _causes; } ///< of all that are kept.
    /// Whether some of the ground is turned away from the light: it may throw a shadow that is not among these.
    bool groundShadowsItself() const { return _groundShadowsItself.value_or(false); }
    unsigned found() const { return _found; } ///< how many tiles' shadows, so far.

    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    /// Level of a bitmap's texels, and by which call.
    struct FinestRequest {
        int level = std::numeric_limits<int>::max();
        unsigned call = 0;
    };
    struct Requests;
    struct Far;
    int levelFor(const Far& one);
    std::vector<Far> farIn(const TileVisibility& view) const;
    Requests requestsIn(const TileVisibility& view, const CasterTiles& town, const TileGround& ground, bool still);
    void letGo(std::size_t tile);
    double offBy(std::size_t tile, const CasterTiles& town) const;
    /// How far a tile's shadows may be off in plan, and how far they may be.
    struct Off {
        double by = 0.0, mayBe = 0.0;
    };
    Off offIn(const TileVisibility& view, std::size_t tile, const CasterTiles& town, const TileGround& ground);
    double mayBeOff(std::size_t tile, double off, const CasterTiles& town, const TileGround& ground,
                    const TileVisibility& view) const;
    bool isSame(const glm::dvec4& light) const;
    void find(const CasterTiles& town, const TileGround& ground, const std::vector<std::size_t>& tiles);
    osg::ref_ptr<TileShadows> unused();
    template <typename Act>
    void eachMesh(const Act& act) const;
    void countOutcomes(const CasterTiles& town);

    const osg::ref_ptr<const TileShadows> _none; ///< of a tile that was not seen yet.
    List _shadows;
    BitmapAtlases _sheets;                          ///< of bitmaps.
    std::vector<osg::ref_ptr<TileBitmap>> _bitmaps; ///< null: none was wanted yet.
    std::vector<ShadowDrift> _followed;             ///< empty until their common bound says too little.
    std::vector<FinestRequest> _finest;             ///< bitmap of each tile.
    unsigned _calls = 0;                            ///< for bitmaps.
    std::vector<std::uint64_t> _states;             ///< revisions of the tiles that the shadows are of; 0: of none.
    std::optional<double> _lowest;                  ///< of the ground, its frame.
    std::optional<bool> _groundShadowsItself;       ///< in this light.
    FollowedTurn _turn;                             ///< of the ground.
    std::vector<osg::ref_ptr<TileShadows>> _spare;
    TerrainSettings _settings;
    glm::dvec4 _light{0.0};
    std::vector<std::string> _causes;
    unsigned _found = 0;
};

} // namespace gnomon
