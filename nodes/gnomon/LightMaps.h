// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ConeMark.h>
#include <gnomon/LightMap.h>
#include <gnomon/ShadowLight.h>

#include <OpenThreads/Mutex>

#include <memory>
#include <optional>
#include <vector>

namespace gnomon {

/// A technique's maps: of each light in each view those drawn last, and whether they still do.
///
/// Threads any number.
class LightMaps {
public:
    LightMaps();
    ~LightMaps();

    /// The casters as maps draw them; made once for all views and lights.
    osg::ref_ptr<const MapCasters> castersOf(const ShadowCasterGroup& group, const CasterPieces& pieces);
    /// @param light  about the casters' origin, see usableLight().
    /// @param cone   of a lamp that is a spot: nothing outside it is marked.
    /// @return the marks of a light; null if none of its shadow can be seen.
    osg::ref_ptr<MarkJob> mark(const ViewFrame& view, int lightNumber, const glm::dvec4& light,
                               const std::optional<SpotCone>& cone, const MapCasters& casters, const MapWish& wish);
    /// Marks of all that is seen outside a spot's cone.
    osg::ref_ptr<ConeMark> around(const ViewFrame& view, const glm::dvec4& light, const SpotCone& cone,
                                  const MapCasters& casters) const;

    const MapResources& resources() const { return *_resources; }
    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state);

private:
    /// Those of a group that were asked for last.
    struct Known {
        const ShadowCasterGroup* group;
        osg::ref_ptr<const MapCasters> casters;
        unsigned lastCall;
    };
    LightMap& find(const void* stage, int lightNumber);

    const osg::ref_ptr<MapResources> _resources;
    OpenThreads::Mutex _mutex;
    std::vector<std::unique_ptr<LightMap>> _maps; ///< used last at the end.
    std::vector<Known> _casters;
    unsigned _calls = 0;
};

} // namespace gnomon
