// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/map/DepthMap.h>
#include <gnomon/map/MapLayer.h>
#include <gnomon/map/MapLookupPass.h>
#include <gnomon/map/MapSlice.h>

#include <vector>

namespace gnomon {

/// The maps of one light in one view: what they must hold, and those drawn last.
class LightShadowMaps {
public:
    LightShadowMaps(const void* ofStage, int ofLight) : stage(ofStage), lightNumber(ofLight) {}

    const void* const stage;
    const int lightNumber;
    unsigned lastRound = 0; ///< of its cache, that asked for it.

    bool areCastersRetired() const { return !_cause.casters || _cause.casters->layers->isRetired(); }
    /// Starts anew if anything but the casters differs from what they are of; maps stay as they lie where those move.
    void setCause(const MapRequest& cause);
    /// Finds what is needed now.
    /// @param pixels  of the view, across and up.
    /// @return what is needed, corners in clip space: on the screen shadows can fall about them; none if nowhere.
    std::vector<glm::dvec4> find(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene,
                                 const glm::dvec2& pixels);
    /// Makes the maps anew that do not hold what is needed, or would hold it much better.
    void update(const MapPrograms& resources, MapBodies& bodies, const OwnView& view);
    /// Where none is needed: forgets those drawn last if they show what has changed since.
    void letGo();
    /// What the maps would be like if they were made after find().
    MapForecast forecast(const glm::dmat4& clipFromScene) const;
    /// Without what a cone adds.
    MapLookupPass quad(const glm::dmat4& clipFromScene) const;

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    void begin();
    void addFaces(const LightFrame& frame);
    double clearance();
    double nearestDrawn(const MapSlice& face);
    void settle(const glm::dmat4& clipFromScene, const glm::dvec2& pixels, const std::vector<MapReceiver>& receivers);
    bool isShown() const;
    void takeCasters(const MapCasters& casters);
    double pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const;
    void findSplits(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene, double width);
    bool anyDue() const;
    void findLamp(MapSlice& far, MapSlice& near, const std::vector<MapReceiver>& receivers,
                  const glm::dmat4& clipFromScene, const glm::dvec2& pixels);
    bool isDivided() const;
    int mapsNeeded() const;
    int columns() const;
    int mostTexels() const;
    double texelsWanted() const;
    void resize();
    bool holds(const MapSlice& face) const;
    MapFit fitOf(const MapSlice& face) const;
    glm::dvec3 reachOf(const MapSlice& face) const;
    osg::ref_ptr<MapPicture> pictureOf(const MapPrograms& resources, bool due, MapBodies& bodies, const OwnView& view);
    MapPicture::Layer drawnOf(const MapLayer& layer, bool again, MapBodies& bodies) const;
    MapLookUp lookUpOf(const MapSlice& face) const;
    PixelRect moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const;

    static constexpr int fewestAtRest = 8; ///< frames: what moves in every second one is not found anew each time.
    /// What a frame's maps are found by, beside the casters and the light.
    struct Seen {
        glm::dmat4 clipFromScene{0.0};
        glm::dvec2 pixels{0.0};
        std::vector<MapReceiver> receivers;
        glm::dvec4 light{0.0};
        osg::ref_ptr<const MapCasters> casters;
    };

    MapRequest _cause;
    glm::dvec4 _light{0.0}; ///< as it was asked for last, and the cone; see isSame().
    std::optional<SpotCone> _cone;
    std::optional<double> _clear, _clearOfStill; ///< see clearance().
    Seen _seen;                                  ///< in the last frame.
    int _rest = 0, _patience = fewestAtRest;     ///< frames since anything changed; after how many all is found anew.
    bool _settled = true;                        ///< maps are as if there had been no frames before.
    bool _anew = true;                           ///< they are to be found so.
    bool _again = false;                         ///< they have been found anew since anything changed.
    std::vector<LightFrame> _frames;
    std::vector<MapSlice> _faces; ///< of each frame one a part; of a lamp's frame two.
    int _cascades = 0;            ///< maps that a sun is to have; 0 until that is known.
    std::vector<double> _splits;  ///< of what is seen: see cascadeSplits().
    int _texels = 0;              ///< on a side of a tile, of those drawn last.
    osg::ref_ptr<DepthMap> _map;
    osg::ref_ptr<const MapPicture> _picture;                ///< null: to be made.
    osg::ref_ptr<const MapLayer> _drawnStill, _drawnMoving; ///< in the last picture.
    MapPicture::Layer _still;                               ///< of the former, as it was drawn last.
    std::vector<MapLookUp> _lookUps;
};

} // namespace gnomon
