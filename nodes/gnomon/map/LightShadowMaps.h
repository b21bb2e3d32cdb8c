// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/map/DepthMap.h>
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
    /// Finds what is needed now. Starts anew if anything but the casters differs from what the maps are of; they stay as they
    /// lie where those move.
    /// @param wanted  all but `flats`.
    /// @return what is needed, corners in clip space: on the screen shadows can fall about them; none if nowhere.
    std::vector<glm::dvec4> find(const ViewFrame& view, MapRequest wanted);
    /// Makes the maps anew that do not hold what is needed, or would hold it much better.
    void update(const MapPrograms& resources, MapBodies& bodies, const OwnView& view);
    /// Where none is needed: forgets those drawn last if they show what has changed since.
    void letGo();
    /// What the maps would be like if they were made after find().
    MapForecast forecast() const;
    /// For the view of find(), without what a cone adds.
    MapLookupPass quad() const;

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    /// What a frame's maps are found by, beside the cone.
    struct Seen {
        glm::dmat4 clipFromScene{0.0};
        glm::dvec2 pixels{0.0}; ///< of the view, across and up.
        std::vector<MapReceiver> receivers;
        glm::dvec4 light{0.0};
        osg::ref_ptr<const MapCasters> casters;

        bool operator==(const Seen& other) const {
            return clipFromScene == other.clipFromScene && pixels == other.pixels && receivers == other.receivers &&
                   light == other.light && casters == other.casters;
        }
    };

    void setCause(const MapRequest& cause);
    void begin();
    void takeCasters(const MapCasters& casters);
    void addFaces(const LightFrame& frame);
    void settle(Seen seen);
    double clearance();
    double nearestDrawn(const MapSlice& face);
    double pixelsATexel(double distance) const;
    void findSplits();
    void findFace(MapSlice& face, const HalfSpaces& halfSpaces);
    void findLamp(MapSlice& far, MapSlice& near);
    int mapsNeeded() const;
    int columns() const;
    double texelsWanted() const;
    void resize();
    bool anyDue() const;
    bool holds(const MapSlice& face) const;
    MapFit fitOf(const MapSlice& face) const;
    glm::dvec3 reachOf(const MapSlice& face) const;
    osg::ref_ptr<MapPicture> pictureOf(const MapPrograms& resources, bool due, MapBodies& bodies, const OwnView& view);
    MapPicture::Layer drawnOf(const MapLayer& layer, bool again, MapBodies& bodies) const;
    MapLookUp lookUpOf(const MapSlice& face) const;
    PixelRect moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const;
    bool isShown() const;
    bool isDivided() const;

    MapRequest _cause;
    glm::dvec4 _light{0.0}; ///< as it was asked for last, and the cone; see isSame().
    std::optional<SpotCone> _cone;
    std::optional<double> _clear, _clearOfStill; ///< see clearance().
    Seen _seen;                                  ///< in the last frame.
    int _rest = 0;                               ///< frames since anything changed.
    bool _settled = true;                        ///< maps are as if there had been no frames before.
    bool _anew = true;                           ///< they are to be found so.
    std::vector<LightFrame> _frames;
    std::vector<MapSlice> _faces; ///< of each frame one a part; of a lamp's frame two.
    int _cascades = 0;            ///< maps that a sun is to have; 0 until that is known.
    std::vector<double> _splits;  ///< of what is seen: see cascadeSplits().
    int _texels = 0;              ///< on a side of a tile, of those drawn last.
    osg::ref_ptr<DepthMap> _map;
    osg::ref_ptr<const MapPicture> _picture; ///< the last one.
    bool _stale = true;                      ///< it is to be made anew.
    std::vector<MapLookUp> _lookUps;
};

/// What maps of one light in a view would be like; none is made. @param boxes  see MapLayer::boxesOf().
MapForecast forecastMaps(const ViewFrame& view, const ShadowLight& light, const MapCasters& boxes,
                         const ShadowMapOptions& settings);

} // namespace gnomon
