// SPDX-License-Identifier: MIT
#pragma once
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

    /// Starts anew if anything but the casters differs from what they are of; maps stay as they lie where those move.
    void setCause(const MapRequest& cause);
    /// Finds what is needed now.
    /// @param pixels  of the view, across and up.
    /// @return what is needed, corners in clip space: on the screen shadows can fall about them; none if nowhere.
    std::vector<glm::dvec4> find(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene,
                                 const glm::dvec2& pixels);
    /// Makes the maps anew that do not hold what is needed, or would hold it much better.
    void update(const MapPrograms& resources);
    /// Without what a cone adds.
    MapLookupPass quad(const glm::dmat4& clipFromScene) const;

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    void addFaces(const LightFrame& frame);
    void takeCasters(const CasterLayers& casters);
    double pixelsATexel(double distance, const glm::dmat4& clipFromScene, double width) const;
    void findSplits(const std::vector<MapReceiver>& receivers, const glm::dmat4& clipFromScene, double width);
    bool anyDue() const;
    int columns() const { return _faces.size() > 4 ? 3 : 2; }
    int mostTexels() const;
    double texelsWanted() const;
    void resize();
    bool holds(const MapSlice& face) const;
    MapFit fitOf(const MapSlice& face) const;
    glm::dvec3 reachOf(const MapSlice& face) const;
    osg::ref_ptr<MapPicture> pictureOf(const MapPrograms& resources, bool due);
    MapPicture::Layer drawnOf(const CasterLayer& layer, bool again) const;
    MapLookUp lookUpOf(const MapSlice& face) const;
    PixelRect moversIn(const MapPicture::Tile& tile, const MapErrors& errors) const;

    MapRequest _cause;
    std::vector<LightFrame> _frames;
    std::vector<MapSlice> _faces; ///< of each frame one a part.
    int _cascades = 0;            ///< maps that a sun is to have; 0 until that is known.
    std::vector<double> _splits;  ///< of what is seen: see cascadeSplits().
    int _texels = 0;              ///< on a side of a tile, of those drawn last.
    osg::ref_ptr<DepthMap> _map;
    osg::ref_ptr<const MapPicture> _picture;                   ///< null: to be made.
    osg::ref_ptr<const CasterLayer> _drawnStill, _drawnMoving; ///< in the last picture.
    MapPicture::Layer _still;                                  ///< of the former, as it was drawn last.
    std::vector<MapLookUp> _lookUps;
};

} // namespace gnomon
