// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ConeMark.h>
#include <gnomon/MapView.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/SpotCone.h>
#include <gnomon/ViewFrame.h>

#include <OpenThreads/Mutex>
#include <osg/Texture>

#include <memory>
#include <optional>
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
    int size = 1024;  ///< texels on a side of a tile.
    int cascades = 0; ///< of a sun: how many of them at most; 0: see cascadesFor().
    osg::Texture::FilterMode compare = osg::Texture::LINEAR;
    std::string defines;             ///< see MapQuad.
    std::optional<MapSoftness> soft; ///< edges; else they are hard.
    MapView view = MapView::Nothing; ///< no part of the maps.

    /// True if its maps are the same.
    bool operator==(const MapWish& other) const {
        return size == other.size && cascades == other.cascades && compare == other.compare &&
               defines == other.defines && soft == other.soft;
    }
};

/// A technique's maps: of each light in each view those drawn last, and whether they still do.
///
/// Threads any number.
class LightMaps {
public:
    LightMaps();
    ~LightMaps();

    /// @param light  about the casters' origin, see usableLight().
    /// @param cone   of a lamp that is a spot: nothing outside it is marked.
    /// @return the marks of a light; null if none of its shadow can be seen.
    osg::ref_ptr<MarkJob> mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                               const std::optional<SpotCone>& cone, const CasterMesh& mesh, const MapWish& wish);
    /// Marks of all that is seen outside a spot's cone.
    osg::ref_ptr<ConeMark> around(const ViewFrame& view, const glm::dvec4& light, const SpotCone& cone,
                                  const CasterMesh& mesh) const;

    const MapResources& resources() const { return *_resources; }
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    struct Face;
    struct LightMap;
    struct Receiver;

    LightMap& find(const void* stage, int lightNumber);
    osg::ref_ptr<const MapCasters> castersOf(const CasterMesh& mesh);
    static MapQuad quadOf(const LightMap& map, const glm::dmat4& clipFromScene);
    bool needsNew(const LightMap& map) const;
    osg::ref_ptr<MapPicture> pictureOf(const LightMap& map) const;
    void redo(LightMap& map) const;

    const osg::ref_ptr<MapResources> _resources;
    OpenThreads::Mutex _mutex;
    std::vector<std::unique_ptr<LightMap>> _maps; ///< used last at the end.
    osg::ref_ptr<const MapCasters> _casters;      ///< asked for last.
    unsigned _calls = 0;
};

} // namespace gnomon
