// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/group/ViewFrame.h>
#include <gnomon/volume/LightVolumes.h>

#include <OpenThreads/Mutex>

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace gnomon {

struct CasterLayers;

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
    std::optional<SeenVolumes> see(const CasterLayers& casters, const ViewFrame& view, int lightNumber,
                                   const glm::dvec4& light, const SceneFrame& scene);
    /// How often volumes were found.
    unsigned builds() const;

    const osg::ref_ptr<osg::StateSet> program; ///< see shaderProgram().

    void resizeGLObjectBuffers(unsigned maxSize);
    void release(osg::State* state) const;

private:
    /// For whom volumes were found: a view's stage, a light's number, and which of the casters'.
    using Owner = std::tuple<const void*, int, std::size_t>;
    struct Entry {
        osg::ref_ptr<LightVolumes> volumes;
        unsigned used = 0; ///< in which round.
    };
    /// The edges of a mesh, found once, wherever it stands.
    struct Edges {
        osg::ref_ptr<const CasterMesh> of; // held, so that its address cannot be taken by another
        std::shared_ptr<const SilhouetteMesh> mesh;
        unsigned used = 0; ///< the same.
    };
    struct Box {
        ReceiverBox receivers;
        unsigned used = 0; ///< the same.
    };
    static constexpr unsigned longUnused = 64; ///< rounds.

    std::vector<VolumeCaster> castersOf(const CasterLayers& casters);
    /// The same as before while it fits.
    const ReceiverBox& boxOf(const void* stage, const ReceiverBox& receivers);
    osg::ref_ptr<LightVolumes> find(const VolumeCaster& caster, Entry& own, const glm::dvec4& light,
                                    const ReceiverBox& receivers);
    void dropUnused();

    mutable OpenThreads::Mutex _mutex;
    std::unordered_map<const CasterMesh*, Edges> _edges;
    std::map<const void*, Box> _boxes; ///< by stage.
    std::map<Owner, Entry> _entries;
    unsigned _builds = 0;
    unsigned _round = 0, _frame = 0; ///< a round is a frame.
};

} // namespace gnomon
