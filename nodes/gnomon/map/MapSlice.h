// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace gnomon {

/// What the maps of one light in one view would be like, found without making any: for whoever chooses among settings.
struct MapForecast {
    int maps = 0;        ///< 0: none of the shadow can be seen.
    int most = 0;        ///< texels on a side of a map, by OpenGL's largest texture.
    double texels = 0.0; ///< on a side of the largest map, with one texel a pixel where pixels are smallest.
    double pixel = std::numeric_limits<double>::infinity(); ///< smallest side of a pixel, see TexelDensity.
    std::optional<ScreenRect> bounds;                       ///< where on the screen the shadow can be.
    /// One of the maps.
    struct Map {
        glm::dmat4 mapFromScene; ///< what it holds is within 0 and 1, homogeneous.
        HalfSpaces halfSpaces;   ///< what of the scene is looked up in it.
    };
    std::vector<Map> each{};
};

/// Pixels on a side of a texel, where it is widest; fewer only with more texels than `size`.
double widestTexel(const ShadowMapOptions& options);

/// What the maps of one light are of.
struct MapRequest {
    glm::dvec4 light{0.0};
    std::optional<SpotCone> cone;
    osg::ref_ptr<const MapCasters> casters;
    bool flats = false; ///< those that are flat cast, too.
    ShadowMapOptions settings;

    /// See softReach().
    double lightRadius(const LightFrame& frame) const;
    /// True if edges are wider than the filter makes them.
    bool isWide(const LightFrame& frame) const;
    /// How far edges of what blocks the light are spread where it is as far as that from the light.
    double softness(const LightFrame& frame, MapOutline blocker, double farthest) const;
};

/// The box of something that is seen.
struct MapReceiver : PlacedBox {
    double size; ///< of its diagonal, scene.
};
/// Those of a view, the largest first.
std::vector<MapReceiver> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene);

/// What darkens the same places: all bodies, or something flat, a ground for one.
struct MapBlocker {
    MapOutline outline;    ///< of what it can darken, were all edges hard.
    HalfSpaces halfSpaces; ///< that hold what it can darken: what is flat darkens what is beyond it.
};

/// Half-space of what something flat can darken: what is beyond it, seen from the light.
glm::dvec4 beyond(const MapLayer::Box& flat, const glm::dvec4& light, const glm::dvec3& reach);

/// What a layer of the casters can darken.
struct LayerOutlines {
    MapOutline bodies;             ///< all together.
    std::vector<MapOutline> flats; ///< one by one, as in MapLayer::flatBoxes; none where they do not cast.
};

/// One direction that a light looks in, and one part of what is seen.
struct MapSlice {
    MapSlice(const LightFrame& given, const MapRequest& cause);

    /// Of those that stand still: they changed.
    void takeStill(const MapRequest& cause);
    /// Of all: some changed.
    void takeBlockers(const MapRequest& cause);
    /// Nothing of it is needed.
    void clear();
    /// Finds what of its part is needed now. @param texels  on a side of its map.
    void find(const MapRequest& cause, const std::vector<MapReceiver>& receivers, const HalfSpaces& halfSpaces,
              TexelDensity pixels, int texels);
    /// Finds `held` anew, for other texels.
    void findHeld(const MapRequest& cause, int texels);

    LightFrame frame;
    bool isAlone = false; ///< no other map of its light's frame holds part of what is seen.
    std::size_t part = 0; ///< of a sun see viewPart(); of a lamp 1 is what is near it, if one map cannot hold all.
    LayerOutlines still;
    std::vector<MapBlocker> blockers;
    MapOutline reach, needed;    ///< what they can darken; what of that is seen.
    MapOutline held;             ///< what a map must hold for that.
    double nearestBlocker = 0.0; ///< depth of the nearest of what darkens any of it.
    double texel = 0.0;          ///< side of the largest that is no larger than any pixel of it, see TexelDensity.
    std::optional<MapFit> fit;   ///< of the map that is drawn.

private:
    void addNeeded(const MapRequest& cause, const MapBlocker& blocker, const std::vector<MapReceiver>& receivers,
                   HalfSpaces halfSpaces, TexelDensity& pixels);
};

} // namespace gnomon
