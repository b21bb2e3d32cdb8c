// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/geometry/ShadowReach.h>
#include <gnomon/gl/VolumeGeometry.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/silhouette/ShadowVolumes.h>
#include <gnomon/silhouette/SilhouetteMesh.h>
#include <gnomon/silhouette/StencilBatches.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon {

class CasterLayers;

/// Bounds of all that can receive in a view, in the scene. Not finite if they are not known; low > high if there is nothing.
struct ReceiverBox {
    glm::dvec3 low, high;

    /// True if `other` is within, and not much smaller.
    bool fits(const ReceiverBox& other) const;
    /// With room to move in.
    ReceiverBox grown() const;
    bool operator==(const ReceiverBox& other) const { return low == other.low && high == other.high; }
};

ReceiverBox receiverBoxOf(const ViewFrame& view, const SceneFrame& scene);

/// Casters within a view that it does not draw: nothing is hidden behind them. Sorted boxes, in the scene.
struct UnseenCasters {
    std::vector<AlignedBox> boxes;
    double widest = 0.0; ///< along x.

    /// True if a box has a point in common with any of these, but for the rounding of floats.
    bool touch(const glm::dvec3& low, const glm::dvec3& high) const;
};

/// Nearly always none.
///
/// Cost  a look at each caster's leaf.
UnseenCasters unseenCasters(const CasterLayers& casters, const ViewFrame& view, const SceneFrame& scene);

/// A mesh that casts, with its edges, where it stands in the scene.
struct VolumeCaster {
    std::shared_ptr<const SilhouetteMesh> mesh; ///< in its own frame.
    glm::dmat4 sceneFromMesh{1.0};              ///< can be inverted.
    Hiding hiding = Hiding::Both;               ///< of all; parts of what is joined have theirs among their kinds.

    /// True if nothing that is behind a part, as seen from the eye, is seen through it.
    bool hides(const SilhouetteMesh::Part& part, const glm::dvec3& eye) const;
};

/// Caps of a part of the mesh.
struct CapsWanted {
    unsigned part;
    bool light, dark; ///< the surface that casts, and the end; the rim of what is smooth in any case.

    bool operator==(const CapsWanted& other) const {
        return part == other.part && light == other.light && dark == other.dark;
    }
};
/// The surface that casts, its rim, and the end.
struct CapRanges {
    VolumeGeometry::Range light{0, 0}, rim{0, 0}, dark{0, 0};
};

/// The volumes of one mesh behind one light.
class LightVolumes : public osg::Referenced {
public:
    LightVolumes();
    /// True if these are they.
    bool are(const VolumeCaster& caster, const glm::dvec4& light, const ReceiverBox& receivers) const;
    /// In place of those before. Not while they are drawn.
    void set(const VolumeCaster& caster, const glm::dvec4& light, const ReceiverBox& receivers);

    const VolumeCaster& caster() const { return _caster; }
    /// In the scene.
    const glm::dvec4& light() const { return _light; }
    const ShadowVolumes& volumes() const { return _volumes; }
    const VolumeGeometry& sides() const { return *_sides; }
    /// What closes the volumes of some parts; made once for the same ones.
    /// @param ranges  for each of `wanted`.
    osg::ref_ptr<const VolumeGeometry> capsOf(const std::vector<CapsWanted>& wanted, std::vector<CapRanges>& ranges);

    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

protected:
    ~LightVolumes() override = default;

private:
    VolumeCaster _caster;
    glm::dvec4 _light{0.0}; ///< in the scene.
    ReceiverBox _receivers{};
    ShadowVolumes _volumes;
    const osg::ref_ptr<VolumeGeometry> _sides;
    std::vector<CapsWanted> _capped; ///< those that have caps,
    std::vector<CapRanges> _ranges;  ///< and where.
    osg::ref_ptr<VolumeGeometry> _caps;
};

/// In clip space the eight corners of a box, and where the volume behind it ends after each of them.
using VolumeHull = std::array<glm::dvec4, 16>;

/// @param end  see nearestEnd(). @param light  w is 0 and the direction has length 1, or w is 1.
VolumeHull volumeHull(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& end, const glm::dvec4& light,
                      const glm::dmat4& clipFromBox);

/// Shares out the volumes of one light to rounds, wherever they are seen from: made once while they are the same.
///
/// Cost     a look at each volume; where a counter might pass its range a sort, see stencilBatches().
/// Threads  any number.
class VolumeRounds : public osg::Referenced {
public:
    explicit VolumeRounds(const std::vector<osg::ref_ptr<LightVolumes>>& all);

    /// The round of each part, mesh by mesh. @param capacity  what a counter can count to, 1 or more.
    std::vector<unsigned> of(unsigned capacity) const;
    /// Those of some parts alone, which may be fewer; found anew. @param parts  by their places in of().
    std::vector<unsigned> of(unsigned capacity, const std::vector<std::size_t>& parts) const;
    /// The place in of() where a mesh begins.
    std::size_t firstOf(std::size_t mesh) const { return _first[mesh]; }

protected:
    ~VolumeRounds() override = default;

private:
    std::vector<PrismLayers> _prisms; ///< of each part; how many of them hold one point at most.
    std::vector<std::size_t> _first;
    mutable OpenThreads::Mutex _mutex;
    mutable unsigned _capacity = 0; ///< which _rounds are for; 0: none yet.
    mutable std::vector<unsigned> _rounds;
};

/// The volumes of one mesh in one view.
struct MeshInView {
    osg::ref_ptr<const LightVolumes> volumes;
    std::size_t number; ///< among all meshes of the light.
    glm::dmat4 clipFromMesh{1.0};
    osg::ref_ptr<const VolumeGeometry> caps; ///< null: none are needed.
};

/// A part whose volume can be seen.
struct SeenPart {
    std::size_t mesh; ///< among those in view.
    unsigned part;
    std::optional<int> holding; ///< see volumesHolding().
    bool showsBack;             ///< see mayShowBack().
    CapRanges caps; ///< without `holding`; of what shows its back, the surface that casts in any case; rims.
};

/// Volumes that are counted together: not more of them hold any one point than a counter can count.
struct VolumeRound {
    /// Sides, those of parts apart that have one in the plane of a face that the light grazes.
    struct Sides {
        std::vector<VolumeGeometry::Range> usual, grazed;
    };
    /// Of one mesh: sides to count from the eye, and from behind; for those light caps, others that may be seen from either
    /// side, and dark caps; and of what is counted from the eye surfaces that cast, which do not count where they are seen
    /// from behind, and rims, which count where they are seen from before.
    struct Share {
        Sides entered, left;
        std::vector<VolumeGeometry::Range> lightCaps, bothCaps, darkCaps, backs, rims;
    };
    std::map<std::size_t, Share> shares; ///< by mesh.
    int holding = 0;                     ///< those counted from the eye that the eye is in.
};

/// What a view needs of the volumes of one light.
///
/// Threads  any number.
struct SeenVolumes {
    std::vector<MeshInView> meshes;
    std::vector<SeenPart> parts;
    ScreenRect bounds{};                       ///< where they can be seen.
    osg::ref_ptr<const VolumeRounds> inRounds; ///< null: one holds them all.
    /// How long the longest step of a vertex's floats is where it is seen at its nearest, as a share of the viewport's width.
    double vertexStep = 0.0;

    /// @param capacity  what a counter can count to, 1 or more.
    std::vector<VolumeRound> rounds(unsigned capacity) const;

    struct Counted {
        std::vector<VolumeRound> rounds;
        bool overflow; ///< a counter may pass its range.
    };
    /// Kept for one capacity: a view's stencil bits seldom change.
    std::shared_ptr<const Counted> countedBy(unsigned capacity) const;

private:
    std::vector<unsigned> roundOfEach(unsigned capacity) const;

    mutable OpenThreads::Mutex _mutex;
    mutable unsigned _capacity = 0; ///< which _counted is for; 0: none yet.
    mutable std::shared_ptr<const Counted> _counted;
};

/// @param near    least w of what is seen.
/// @param rounds  of these volumes; null: one holds them all.
/// @param unseen  hide nothing.
/// @return null if none can be seen.
std::shared_ptr<const SeenVolumes> seenVolumes(const std::vector<osg::ref_ptr<LightVolumes>>& all,
                                               const glm::dmat4& clipFromScene, double near,
                                               const osg::ref_ptr<const VolumeRounds>& rounds = nullptr,
                                               const UnseenCasters& unseen = {});

} // namespace gnomon
