// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/group/ViewFrame.h>
#include <gnomon/volume/VolumeView.h>

#include <OpenThreads/Mutex>

#include <optional>
#include <vector>

namespace gnomon {

class FrameCasters;

/// A technique's volumes: for each light in each view those found last, and whether they still are.
///
/// Threads
/// - Any number.
class VolumeCache {
public:
    VolumeCache();

    /// What a view sees of the volumes of all casters behind a light, found anew only where something changed.
    /// @param light  in the scene about the casters' origin, see localLight().
    /// @return       nullopt if nothing can be seen.
    std::optional<SeenVolumes> see(const FrameCasters& casters, const ViewFrame& view, int lightNumber,
                                   const glm::dvec4& light, const SceneFrame& scene);
    /// How often volumes were found.
    unsigned builds() const;

    const osg::ref_ptr<osg::StateSet> program; ///< see shaderProgram().

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state) const;

private:
    /// For whom it was found last.
    struct Entry {
        const void* stage;
        int light;
        std::size_t mesh; ///< among the casters'.
        osg::ref_ptr<LightVolumes> volumes;
    };
    static constexpr std::size_t most = 32;

    osg::ref_ptr<LightVolumes> find(const VolumeCaster& caster, const Entry& owner, const glm::dvec4& light,
                                    const ReceiverBox& receivers);

    mutable OpenThreads::Mutex _mutex;
    VolumeCasters _casters;
    RecentCache<Entry> _entries;
    unsigned _builds = 0;
};

} // namespace gnomon
