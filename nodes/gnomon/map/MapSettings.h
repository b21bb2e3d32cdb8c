// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/map/MapDebugView.h>

#include <osg/Texture>

#include <optional>
#include <string>

namespace gnomon {

/// What makes the edges of a technique's shadows wider than its filter; 0: nothing.
struct MapSoftness {
    double sun = 0.0;    ///< tangent of half the angle that suns are seen under.
    double lamp = 0.0;   ///< half the diameter of lamps, scene's unit.
    double radius = 0.0; ///< of a disc about each place that is averaged, scene's unit.

    bool operator==(const MapSoftness& other) const {
        return sun == other.sun && lamp == other.lamp && radius == other.radius;
    }
};

/// How a technique wants its maps.
struct MapSettings {
    int size = 1024;     ///< texels on a side of a tile, at most.
    double pixels = 1.0; ///< on a side of a texel, where it is widest; fewer only with more texels than `size`.
    int cascades = 0;    ///< of a sun: how many of them at most; 0: see cascadesFor().
    osg::Texture::FilterMode compare = osg::Texture::LINEAR;
    std::string defines;                       ///< see MapLookupPass.
    bool smooth = false;                       ///< edges, where they are not soft; else they are hard.
    std::optional<MapSoftness> soft;           ///< edges.
    MapDebugView view = MapDebugView::Nothing; ///< no part of the maps.
    int unit = -1;                             ///< no part of them either: see ShadowMapTechnique::setProgramUnit().

    /// True if its maps are the same.
    bool operator==(const MapSettings& other) const {
        return size == other.size && pixels == other.pixels && cascades == other.cascades && compare == other.compare &&
               defines == other.defines && smooth == other.smooth && soft == other.soft;
    }
};

} // namespace gnomon
