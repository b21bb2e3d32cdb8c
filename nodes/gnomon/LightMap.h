// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MapCasters.h>
#include <gnomon/MapTexels.h>
#include <gnomon/MapView.h>
#include <gnomon/SpotCone.h>
#include <gnomon/ViewFrame.h>

#include <osg/Texture>

#include <optional>
#include <string>
#include <vector>

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
struct MapWish {
    int size = 1024;     ///< texels on a side of a tile, at most.
    double pixels = 1.0; ///< on a side of a texel, where it is widest; fewer only with more texels than `size`.
    int cascades = 0;    ///< of a sun: how many of them at most; 0: see cascadesFor().
    osg::Texture::FilterMode compare = osg::Texture::LINEAR;
    std::string defines;             ///< see MapQuad.
    bool smooth = false;             ///< edges, where they are not soft; else they are hard.
    std::optional<MapSoftness> soft; ///< edges.
    MapView view = MapView::Nothing; ///< no part of the maps.
    int unit = -1;                   ///< no part of them either: see ShadowMapTechnique::setProgramUnit().

    /// True if its maps are the same.
    bool operator==(const MapWish& other) const {
        return size == other.size && pixels == other.pixels && cascades == other.cascades && compare == other.compare &&
               defines == other.defines && smooth == other.smooth && soft == other.soft;
    }
};

/// The box of something that is seen.
struct MapReceiver {
    glm::dvec3 low, high;
    glm::dmat4 sceneFromBox;
    double size; ///< of its diagonal, scene.
};
/// Those of a view, the largest first.
std::vector<MapReceiver> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene);

/// What darkens the same places: all bodies, or something flat, a ground for one.
struct MapBlocker {
    MapOutline outline;                 ///< of what it can darken, were all edges hard.
    std::vector<glm::dvec4> halfSpaces; ///< that hold what it can darken: what is flat darkens what is beyond it.
};

/// Half-space of what something flat can darken: what is beyond it, seen from the light.
glm::dvec4 beyond(const MapLayer::Box& flat, const glm::dvec4& light, const glm::dvec3& reach);

/// What a layer of the casters can darken.
struct LayerOutlines {
    MapOutline bodies;             ///< all together.
    std::vector<MapOutline> flats; ///< one by one, as in MapLayer::flatBoxes; none where they do not cast.
};

/// One direction that a light looks in, and one part of what is seen.
struct MapFace {
    explicit MapFace(const LightFrame& given)
        : frame(given), still{MapOutline(given), {}}, reach(given), needed(given), held(given) {}

    LightFrame frame;
    std::size_t part = 0; ///< see viewPart().
    LayerOutlines still;
    std::vector<MapBlocker> blockers;
    MapOutline reach, needed;    ///< what they can darken; what of that is seen.
    MapOutline held;             ///< what a map must hold for that.
    double nearestBlocker = 0.0; ///< depth of the nearest of what darkens any of it.
    double texel = 0.0;          ///< side of the largest that is no larger than any pixel of it, see SeenPixels.
    std::optional<MapFit> fit;   ///< of the map that is drawn.
};

/// The maps of one light in one view: what they must hold, and those drawn last.
class LightMap {
public:
    LightMap(const void* ofStage, int ofLight) : stage(ofStage), lightNumber(ofLight) {}

    const void* const stage;
    const int lightNumber;
    unsigned lastCall = 0;

    /// Starts anew if anything but the casters differs from what they are of; maps stay as they lie where those move.
    void setCause(const glm::dvec4& light, const std::optional<SpotCone>& cone, const MapCasters& casters, bool flats,
                  const MapWish& wish);
    /// Finds what is needed now.
    /// @param pixels  of the view, across and up.
    /// @return what is needed, corners in clip space: on the screen shadows can fall about them; none if nowhere.
    std::vector<glm::dvec4> find(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene,
                                 const glm::dvec2& pixels);
    /// Makes the maps anew that do not hold what is needed, or would hold it much better.
    void update(const MapResources& resources);
    /// Without what a cone adds.
    MapQuad quad(const glm::dmat4& clipFromScene) const;

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    void addFaces(const LightFrame& frame);
    void takeCasters(const MapCasters& casters);
    LayerOutlines outlinesOf(const MapLayer& layer, const LightFrame& frame) const;
    std::vector<MapBlocker> blockersOf(const MapFace& face) const;
    double pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const;
    void findSplits(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene, double width);
    void findNeeded(MapFace& face, const std::vector<MapReceiver>& receivers, const std::vector<glm::dvec4>& part,
                    SeenPixels pixels) const;
    void addNeeded(MapFace& face, const MapBlocker& blocker, const std::vector<MapReceiver>& receivers,
                   std::vector<glm::dvec4> halfSpaces, SeenPixels& pixels) const;
    double lightRadius(const LightFrame& frame) const;
    bool isWide(const LightFrame& frame) const;
    void findHeld(MapFace& face) const;
    double softness(const LightFrame& frame, MapOutline blocker, double farthest) const;
    bool anyDue() const;
    int columns() const { return _faces.size() > 4 ? 3 : 2; }
    int mostTexels() const;
    double texelsWanted() const;
    void resize();
    bool holds(const MapFace& face) const;
    MapFit fitOf(const MapFace& face) const;
    osg::ref_ptr<MapPicture> pictureOf(const MapResources& resources, bool due);
    MapPicture::Layer drawnOf(const MapLayer& layer, bool again) const;
    MapLookUp lookUpOf(const MapFace& face) const;
    PixelRect moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const;

    glm::dvec4 _light{0.0};
    std::optional<SpotCone> _cone;
    MapWish _wish;
    osg::ref_ptr<const MapCasters> _casters;
    bool _flats = false; ///< those that are flat cast, too.
    std::vector<LightFrame> _frames;
    std::vector<MapFace> _faces; ///< of each frame one a part.
    int _cascades = 0;           ///< maps that a sun is to have; 0 until that is known.
    std::vector<double> _splits; ///< of what is seen: see cascadeSplits().
    int _texels = 0;             ///< on a side of a tile, of those drawn last.
    osg::ref_ptr<DepthMap> _map;
    osg::ref_ptr<const MapPicture> _picture;                ///< null: to be made.
    osg::ref_ptr<const MapLayer> _drawnStill, _drawnMoving; ///< in the last picture.
    MapPicture::Layer _still;                               ///< of the former, as it was drawn last.
    std::vector<MapLookUp> _lookUps;
};

} // namespace gnomon
