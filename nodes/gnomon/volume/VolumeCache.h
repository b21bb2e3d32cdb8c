// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/volume/LightVolumes.h>

#include <OpenThreads/Mutex>

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {

class CasterLayers;

/// A technique's volumes: for each light in each view those found last, and whether they still are.
///
/// Threads
/// - Any number.
class VolumeCache {
public:
    VolumeCache();

    /// What a view sees of the volumes of all casters behind a light, found anew only where something changed.
    /// @param light  in the scene about the casters' origin, see lightInScene().
    /// @return       nullopt if nothing can be seen.
    std::optional<SeenVolumes> see(const CasterLayers& casters, const ViewFrame& view, int lightNumber,
                                   const glm::dvec4& light, const SceneFrame& scene);
    /// How often volumes were found.
    unsigned builds() const;

    const osg::ref_ptr<osg::StateSet> program; ///< see shaderProgram().

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state) const;

private:
    /// What was found for a light in a view.
    struct Entry {
        ReceiverBox receivers;                           ///< the same as before while it fits.
        std::vector<osg::ref_ptr<LightVolumes>> volumes; ///< of each caster.
        unsigned used = 0;                               ///< in which round.
    };
    static constexpr unsigned longUnused = 64; ///< rounds.

    void update(osg::ref_ptr<LightVolumes>& volumes, const VolumeCaster& caster, const glm::dvec4& light,
                const ReceiverBox& receivers);
    void dropUnused();

    mutable OpenThreads::Mutex _mutex;
    std::map<std::pair<ViewKey, int>, Entry> _entries; ///< by a view and a light's number.
    unsigned _builds = 0;
    unsigned _round = 0, _frame = 0; ///< a round is a frame.
};

} // namespace gnomon
