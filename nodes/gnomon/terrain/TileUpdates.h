// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/onterrain/PackedShadows.h>
#include <gnomon/onterrain/ShadowDrift.h>
#include <gnomon/terrain/CasterTiles.h>
#include <gnomon/terrain/TerrainMark.h>
#include <gnomon/terrain/TileBitmap.h>
#include <gnomon/terrain/TileVisibility.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How shadows are to be found.
struct TerrainSettings {
    TerrainShadowGeode::Method method;
    double error;
    osg::BoundingBoxd box; ///< BOX alone: of the only object; invalid: found from each.
    bool operator==(const TerrainSettings& other) const {
        return method == other.method && error == other.error && box._min == other.box._min &&
               box._max == other.box._max;
    }
};

/// Of HULL and DRAPE.
inline TerrainMethod methodOf(const TerrainSettings& settings) {
    return settings.method == TerrainShadowGeode::DRAPE ? TerrainMethod::drape : TerrainMethod::hull;
}

/// The shadows of a tile of casters. Whoever holds it may read: it is never changed while somebody else does.
struct TileShadows : public osg::Referenced {
    PackedShadows found;
    OutcomeCounts outcomes;
    glm::dvec4 light{0.0};                    ///< that they were found with.
    osg::ref_ptr<TerrainMesh> decals, prisms; ///< what shows them together; null if nobody draws them.
    glm::dvec2 low{0.0}, high{0.0};           ///< bounds in plan, about the origin; low > high if there is no shadow.
    double widest = 0.0;                      ///< diameter of the largest shadow.
    double slope = 0.0;                       ///< of the ground under the decals, where it is steepest.

protected:
    ~TileShadows() override = default;
};

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
    unsigned found() const { return _found; }                          ///< how many tiles' shadows, so far.

    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    /// Level of a bitmap's texels, and by which call.
    struct FinestWanted {
        int level = std::numeric_limits<int>::max();
        unsigned call = 0;
    };
    struct Wanted;
    struct Far;
    int levelFor(const Far& one);
    std::vector<Far> farIn(const TileVisibility& view) const;
    Wanted wantedIn(const TileVisibility& view, const CasterTiles& town, const TileGround& ground, bool still);
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
    std::vector<FinestWanted> _finest;              ///< bitmap of each tile.
    unsigned _calls = 0;                            ///< for bitmaps.
    std::vector<std::uint64_t> _states;             ///< revisions of the tiles that the shadows are of; 0: of none.
    std::optional<double> _lowest;                  ///< of the ground, its frame.
    std::vector<osg::ref_ptr<TileShadows>> _spare;
    TerrainSettings _settings{TerrainShadowGeode::HULL, 0.0, {}};
    glm::dvec4 _light{0.0};
    std::vector<std::string> _causes;
    unsigned _found = 0;
};

} // namespace gnomon
