// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/gl/MarkEdges.h>
#include <gnomon/group/PerView.h>
#include <gnomon/volume/LightVolumes.h>

#include <OpenThreads/Mutex>

#include <cstdint>
#include <memory>
#include <optional>
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
    /// @return       null if nothing can be seen.
    std::shared_ptr<const SeenVolumes> see(const CasterLayers& casters, const ViewFrame& view, int lightNumber,
                                           const glm::dvec4& light, const SceneFrame& scene);
    /// How often volumes were found.
    unsigned builds() const;

    const osg::ref_ptr<osg::StateSet> program; ///< see shaderProgram().
    const osg::ref_ptr<MarkEdges> edges;

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state) const;

private:
    /// What was found for a light in a view.
    struct Found {
        std::optional<ReceiverBox> receivers;            ///< the same as before while it fits.
        std::vector<osg::ref_ptr<LightVolumes>> volumes; ///< of each caster.
        osg::ref_ptr<const VolumeRounds> rounds;         ///< of these volumes.
        std::shared_ptr<const SeenVolumes> seen;         ///< of them, last; null if nothing was.
        // What the receivers and what was seen were found for:
        glm::dvec3 origin{0.0}; ///< of the scene, group frame.
        osg::Matrixd eyeFromGroup;
        glm::dmat4 clipFromScene{0.0};
        std::uint64_t seenValue = 0;     ///< see ViewFrame.
        std::uint64_t standingValue = 0; ///< see ViewPrograms.
    };

    bool follow(Found& found, const std::vector<VolumeCaster>& casters, const glm::dvec4& light);
    void update(osg::ref_ptr<LightVolumes>& volumes, const VolumeCaster& caster, const glm::dvec4& light,
                const ReceiverBox& receivers);

    mutable OpenThreads::Mutex _mutex;
    PerView<Found> _found;
    unsigned _builds = 0;
};

} // namespace gnomon
