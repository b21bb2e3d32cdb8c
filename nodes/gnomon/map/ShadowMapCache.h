// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/map/LightShadowMaps.h>
#include <gnomon/map/MapMark.h>

#include <OpenThreads/Mutex>

#include <memory>
#include <optional>

namespace gnomon {

/// A technique's maps: of each light in each view those drawn last, and whether they still do.
///
/// Threads any number.
class ShadowMapCache {
public:
    ShadowMapCache();
    ~ShadowMapCache();

    /// The casters as maps draw them; made once for all lights, and for all views of the same levels of detail.
    osg::ref_ptr<const MapCasters> castersOf(const CasterLayers& layers);
    /// @param light  in the scene about the casters' origin, see localLight().
    /// @param cone   of a lamp that is a spot: nothing outside it is marked.
    /// @return the marks of a light; null if none of its shadow can be seen.
    osg::ref_ptr<MarkJob> mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                               const std::optional<SpotCone>& cone, const MapCasters& casters,
                               const MapSettings& settings);
    /// What maps of one light in a view would be like; none is made. @param boxes  see MapLayer::boxesOf().
    static MapForecast forecast(const ViewFrame& view, const ShadowLight& light, const MapCasters& boxes,
                                const MapSettings& settings);
    /// Marks of all that is seen outside a spot's cone.
    osg::ref_ptr<SpotMark> around(const ViewFrame& view, const glm::dvec4& light, const SpotCone& cone,
                                  const MapCasters& casters) const;

    /// Drops the maps and meshes of retired casters.
    void letGo();

    const MapPrograms& resources() const { return *_resources; }
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    LightShadowMaps& find(const ViewFrame& view, int lightNumber);
    osg::ref_ptr<const MapLayer> layerOf(const CasterLayer& layer) const;

    const osg::ref_ptr<MapPrograms> _resources;
    OpenThreads::Mutex _mutex;
    RecentCache<std::unique_ptr<LightShadowMaps>> _maps;
    RecentCache<osg::ref_ptr<const MapCasters>> _casters;
    MapBodies _bodies;
    unsigned _round = 0, _frame = 0; ///< a round is a frame, as views count them.
};

} // namespace gnomon
