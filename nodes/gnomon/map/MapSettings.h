// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>

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

/// A technique's options, and what follows from them for its maps.
struct MapSettings : ShadowMapOptions {
    MapSettings(const ShadowMapOptions& options = {});

    double pixels;                    ///< on a side of a texel, where it is widest; fewer only with more than `size`.
    osg::Texture::FilterMode compare; ///< of OpenGL, within each comparison.
    std::string defines;              ///< see MapLookupPass.
    bool smooth;                      ///< edges, where they are not soft; else they are hard.
    std::optional<MapSoftness> softness; ///< of edges.

    /// True if its maps are the same, whatever the view and the unit.
    bool operator==(const MapSettings& other) const {
        return size == other.size && pixels == other.pixels && cascades == other.cascades && compare == other.compare &&
               defines == other.defines && smooth == other.smooth && softness == other.softness;
    }
};

/// How the shaders compare.
std::string definesOf(ShadowMapOptions::Filter filter);

} // namespace gnomon
