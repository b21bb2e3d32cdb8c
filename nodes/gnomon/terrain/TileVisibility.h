// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/ViewFrame.h>

#include <glm/mat4x4.hpp>
#include <optional>

namespace gnomon {

class TileMesh;
struct TileShadows;

/// What a view shows of shadows on terrain. With CompositorOptions::filter off all counts as seen, and as seen exactly.
class TileVisibility {
public:
    /// @param origin  of the tiles, group's frame.
    TileVisibility(const ViewFrame& view, const glm::dvec3& origin);

    const CompositorOptions& options() const { return _options; }
    const glm::dmat4& clipFromTiles() const { return _clipFromTiles; }
    /// Where a tile's mesh is on the screen; nullopt if nothing of it is to be drawn: it is empty, out of sight, or its widest
    /// shadow is smaller than a pixel.
    std::optional<ScreenRect> seen(const TileMesh& mesh, const TileShadows& tile) const;
    /// How fine a bitmap of a tile's decals is to be: see bitmapTexel(); one that is finer by `finerLevels` will do. nullopt
    /// where nothing of them is to be drawn, and where there had to be too many texels.
    std::optional<int> bitmapLevel(const TileShadows& tile) const;
    static constexpr int finerLevels = 2;
    /// Whether a bitmap of a tile's decals has not too many texels at a level.
    static bool isBitmapSmall(const TileShadows& tile, int level);
    /// A texel's side at a level, two levels for each doubling.
    static double bitmapTexel(int level);
    /// By how much a tile's shadows may be off without being seen to be: a quarter of a pixel where they are nearest,
    /// infinite out of sight. @param off  by how much they may be off in plan.
    double mayBeOff(const TileShadows& tile, double off) const;
    /// Whether anything can be seen of the shadows of what is in a box: false only of a sun that has risen.
    /// @param low,high  about the tiles' origin.
    /// @param lowest  of the ground, about the origin. @param margin  of its heights, see TileGround.
    bool maySeeShadowsOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& light, double lowest,
                         double margin) const;

private:
    struct Shown {
        std::optional<ScreenRect> bounds; ///< see seen().
        double pixels = 0.0;              ///< that a length of 1 can be there.
    };
    /// @param moved  by how much the shadows may be somewhere else, in any direction.
    Shown shown(const TileMesh& mesh, const TileShadows& tile, double moved) const;

    const CompositorOptions _options;
    const glm::dmat4 _clipFromTiles;
    const double _mostPixels; ///< that a length of 1 can be where w is 1, exactly.
};

} // namespace gnomon
