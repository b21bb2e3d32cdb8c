// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenBounds.h>
#include <gnomon/ViewFrame.h>

#include <glm/mat4x4.hpp>
#include <optional>

namespace gnomon {

class TerrainMesh;
struct TileShadows;

/// What a view shows of shadows on terrain. With ShadowBin::setFilter(false) all counts as seen, and as seen exactly.
class TerrainView {
public:
    /// @param origin  of the tiles, group's frame.
    TerrainView(const ViewFrame& view, const glm::dvec3& origin);

    const glm::dmat4& clipFromTiles() const { return _clipFromTiles; }
    /// Where a tile's mesh is on the screen.
    struct Seen {
        ScreenRect bounds;
        double
            unseen; ///< difference in height that is not seen where it is nearest, from above: a quarter of a pixel, and no
                    ///< more than a pixel's length where the line of sight is upright.
    };
    /// nullopt if nothing of it is to be drawn: it is empty, out of sight, or its widest shadow is smaller than a pixel.
    std::optional<Seen> seen(const TerrainMesh& mesh, const TileShadows& tile) const;
    /// The eye is higher than all of it.
    bool isAbove(const TerrainMesh& mesh) const;
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
        double nearest = 0.0;             ///< w of its nearest corner.
        double pixels = 0.0;              ///< that a length of 1 can be there.
    };
    /// @param moved  by how much the shadows may be somewhere else, in any direction.
    Shown shown(const TerrainMesh& mesh, const TileShadows& tile, double moved) const;
    double pixelsHigh(const ScreenRect& bounds, double nearest) const;

    const osg::Vec2d _pixels;
    const glm::dmat4 _clipFromTiles;
};

} // namespace gnomon
