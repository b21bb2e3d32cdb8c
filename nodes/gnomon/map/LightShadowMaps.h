// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/DepthMap.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/map/MapRequest.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <optional>
#include <tuple>
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

/// Of a light whose maps are not made. @param boxes  see MapLayer.
MapForecast forecastMaps(const ViewFrame& view, const ShadowLight& light, const MapCasters& boxes,
                         const MapSettings& settings);

/// The maps of one light in one view: what they must hold, and those drawn last. In each frame call find(), then update() or
/// letGo().
class LightShadowMaps {
public:
    bool areCastersRetired() const { return !_request.casters || _request.casters->of->isRetired(); }
    /// Finds what is needed now. Starts anew if anything but the casters differs from what the maps are of; they stay as they
    /// lie where those move.
    /// @return what is needed, corners in clip space: on the screen shadows can fall about them; none if nowhere.
    std::vector<glm::dvec4> find(const ViewFrame& view, const MapRequest& request);
    /// Makes the maps anew that do not hold what is needed, or would hold it much better.
    void update(const ViewFrame& view, MapMeshes& meshes);
    /// Where none is needed: forgets those drawn last if they show what has changed since.
    void letGo();
    /// What the maps would be like if they were made after find().
    MapForecast forecast() const;

    /// After update().
    const osg::ref_ptr<DepthMap>& map() const { return _map; }
    const osg::ref_ptr<const MapPicture>& picture() const { return _picture; }

private:
    /// What darkens the same places: all bodies, or something flat, a ground for one.
    struct Blocker {
        MapOutline outline;    ///< of what it can darken, were all edges hard.
        HalfSpaces halfSpaces; ///< that hold what it can darken: what is flat darkens what is beyond it.
    };
    /// What a layer of the casters can darken.
    struct Outlines {
        MapOutline bodies;             ///< all together.
        std::vector<MapOutline> flats; ///< one by one, as in MapLayer::flats; none where they do not cast.
    };
    /// One direction that the light looks in, and what casts there.
    struct Side {
        LightFrame frame;
        Outlines still; ///< of those that stand still.
        std::vector<Blocker> blockers;
    };
    /// One map: of a side, and one part of what is seen.
    struct Face {
        const Side* side;
        std::size_t part; ///< of a sun see viewPart(); of a lamp 1 is what is near it, if one map cannot hold all.
        MapOutline reach, needed;    ///< what the blockers can darken; what of that is seen.
        MapOutline held;             ///< what the map must hold for that.
        double nearestBlocker = 0.0; ///< depth of the nearest of what darkens any of it.
        double texel = 0.0;          ///< side of the largest that is no larger than any pixel of it, see TexelDensity.
        std::optional<MapFit> fit{}; ///< of the map that is drawn.

        Face(const Side& of, std::size_t itsPart)
            : side(&of), part(itsPart), reach(of.frame), needed(of.frame), held(of.frame) {}
        void clear() { reach = needed = held = MapOutline(side->frame); }
    };
    /// What a frame's maps are found by.
    struct Seen {
        glm::dmat4 clipFromScene{0.0};
        glm::dvec2 pixels{0.0}; ///< of the view, across and up.
        std::vector<PlacedBox> receivers;
        MapRequest latest; ///< as it was requested; the settings do not count.

        auto all() const {
            return std::tie(clipFromScene, pixels, receivers, latest.light, latest.cone, latest.casters);
        }
        bool operator==(const Seen& other) const { return all() == other.all(); }
    };

    static constexpr int fewestAtRest = 8; ///< frames.
    /// True if maps are as if there had been no frames before.
    bool isSettled() const { return _rest == fewestAtRest; }
    /// True if the last picture is of the casters as they are now.
    bool isOfCasters() const {
        return _picture && _picture->still.of == _request.casters->still &&
               _picture->moving.of == _request.casters->moving;
    }

    void setRequest(const MapRequest& request, bool flats);
    void takeCasters(const MapCasters& casters);
    void settle(Seen seen);
    void begin();
    Outlines outlinesOf(const MapLayer& layer, const LightFrame& frame) const;
    bool areThin(const LightFrame& frame) const;
    void findBlockers(Side& side) const;
    void findSplits();
    double pixelsATexel(double distance) const;
    void findFace(Face& face, const HalfSpaces& halfSpaces) const;
    void findLamp(Face& far, Face& near);
    void addNeeded(Face& face, const Blocker& blocker, HalfSpaces halfSpaces, TexelDensity& pixels) const;
    void findHeld(Face& face) const;
    double clearance();
    int mapsNeeded() const;
    int columns() const;
    int mostTexels() const;
    void resize();
    double texelsWanted() const;
    bool anyDue() const;
    bool holds(const Face& face) const;
    MapFit fitOf(const Face& face) const;
    glm::dvec3 reachOf(const Face& face) const;
    MapPicture::Layer drawnOf(const MapLayer& layer, bool again, MapMeshes& meshes) const;
    glm::ivec2 addTiles(MapPicture& picture);
    MapPicture::Tile tileOf(const Face& face, const glm::ivec2& corner);
    PixelRect moversIn(const MapPicture::Tile& tile) const;

    MapRequest _request; ///< what the maps are of; an older one's light, while the latest is the same but for floats.
    bool _flats = false; ///< casters that are flat, as grounds are, may shadow what is seen.
    Seen _seen;          ///< in the last frame.
    int _rest = 0;       ///< frames since anything changed; see settle().
    std::optional<double> _clearOfStill; ///< see clearance().
    std::vector<Side> _sides;
    std::vector<Face> _faces;                ///< of each side one a part; of a lamp's side two.
    int _cascades = 0;                       ///< maps that a sun is to have; 0 until that is known.
    std::vector<double> _splits;             ///< of what is seen: see cascadeSplits().
    int _texels = 0;                         ///< on a side of a tile, of those drawn last.
    osg::ref_ptr<DepthMap> _map;             ///< null until there is one that fits the settings.
    osg::ref_ptr<const MapPicture> _picture; ///< the last one.
};

} // namespace gnomon
