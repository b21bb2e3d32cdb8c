// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/DepthMap.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/map/MapFaces.h>
#include <gnomon/map/MapRequest.h>
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
    bool touchesFlat = false;                               ///< see anyTouchesBehind(); not where nothing flat casts.
    /// Receivers' boxes that are cut to what can be dark, in all maps. What a map takes besides counts as 50.
    double fits = 0.0;
    /// A fit, and what is looked up in it.
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
///
/// Words: a light looks to one *side* or, as a lamp may, to six. A *face* is what of a side one map is needed for. A *fit* is the
/// rectangle of the side that this map covers, larger than needed, so that it holds for a while. A *tile* is the square of the
/// texture that it is drawn in. MapFaces finds faces for each frame that differs; fits and tiles, here, live over frames.
class LightShadowMaps {
public:
    bool areCastersRetired() const {
        const MapRequest& request = _faces.request();
        return !request.casters || request.casters->of->isRetired();
    }
    /// Finds what is needed now. Starts anew if anything but the casters differs from what the maps are of; they stay as they
    /// lie where those move.
    /// @return what is needed, corners in clip space: on the screen shadows can fall about them; none if nowhere.
    const std::vector<glm::dvec4>& find(const ViewFrame& view, const MapRequest& request);
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
    using Face = MapFaces::Face;

    static constexpr int longRest = 8; ///< frames.
    /// True if maps are as if there had been no frames before.
    bool isSettled() const { return _rest >= _patience; }
    /// True if the last picture is of the casters as they are now.
    bool isOfCasters() const {
        return _picture && _picture->still.of == _faces.request().casters->still &&
               _picture->moving.of == _faces.request().casters->moving;
    }

    void take(const MapRequest& request, bool flats);
    void settle(bool same, const MapRequest& latest);
    int mapsNeeded() const;
    int columns() const;
    int mostTexels() const;
    void resize();
    double texelsWanted() const;
    bool anyDue() const;
    bool holds(const Face& face) const;
    /// By what is needed now alone.
    MapFit freshFit(const Face& face) const;
    MapFit fitOf(const Face& face) const;
    /// See MapRoom::thick.
    double thickOf(const Face& face) const { return glm::length(_faces.reachOf(face)) / 64.0; }
    MapPicture::Layer drawnOf(const MapLayer& layer, bool again, MapMeshes& meshes) const;
    glm::ivec2 addTiles(MapPicture& picture);
    MapPicture::Tile tileOf(const Face& face, const glm::ivec2& corner);
    PixelRect moversIn(const MapPicture::Tile& tile) const;

    MapFaces _faces;                 ///< of an older light, while the latest is the same but for floats.
    MapRequest _latest;              ///< in the last frame.
    int _rest = 0;                   ///< frames since that or what is seen changed, up to longRest.
    int _patience = 1;               ///< that many settle the maps; see settle().
    int _texels = 0;                 ///< on a side of a tile, of those drawn last.
    int _foundFor = 0;               ///< texels that the faces were found with, of what they are of now; else 0.
    std::vector<glm::dvec4> _needed; ///< what find() returned for them.
    osg::ref_ptr<DepthMap> _map;     ///< null until there is one that fits the settings.
    osg::ref_ptr<const MapPicture> _picture; ///< the last one.
};

} // namespace gnomon
