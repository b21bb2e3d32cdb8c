// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/VolumeGeometry.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/group/ViewFrame.h>
#include <gnomon/silhouette/ShadowVolumes.h>
#include <gnomon/silhouette/SightStart.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon {

/// Bounds of all that can receive in a view, in the scene. Not finite if they are not known; low > high if there is nothing.
struct ReceiverBox {
    glm::dvec3 low, high;

    /// True if `other` is within, and not much smaller.
    bool fits(const ReceiverBox& other) const;
    /// With room to move in.
    ReceiverBox grown() const;
    bool operator==(const ReceiverBox& other) const { return low == other.low && high == other.high; }
};

ReceiverBox receiversOf(const ViewFrame& view, const SceneFrame& scene);

struct CasterLayers;

/// A mesh that casts, with its edges, where it stands in the scene.
struct VolumeCaster {
    std::shared_ptr<const SilhouetteMesh> mesh; ///< in its own frame.
    glm::dmat4 sceneFromMesh{1.0};              ///< can be inverted.
    Hiding hiding = Hiding::Both;               ///< of all; parts of what is joined have theirs among their kinds.

    /// True if nothing that is behind a part, as seen from the eye, is seen through it.
    bool hides(const SilhouetteMesh::Part& part, const glm::dvec3& eye) const;
};

/// The edges of casters, found once a mesh, wherever it stands.
class VolumeCasters {
public:
    /// All that cast. Those of casters that were last asked for 64 rounds ago are let go.
    /// @param round  a frame, as views count them; never fewer than before.
    std::vector<VolumeCaster> of(const CasterLayers& casters, unsigned round);

private:
    struct Entry {
        osg::ref_ptr<const CasterMesh> mesh; // held, so that its address cannot be taken by another
        std::shared_ptr<const SilhouetteMesh> edges;
        unsigned used = 0; ///< in which round.
    };
    static constexpr unsigned longUnused = 64; ///< rounds.

    std::unordered_map<const CasterMesh*, Entry> _entries;
};

/// Caps of a part of the mesh.
struct CapsWanted {
    unsigned part;
    bool dark; ///< the end, too; else the surface that casts alone.

    bool operator==(const CapsWanted& other) const { return part == other.part && dark == other.dark; }
};
/// The surface that casts, and after it the end.
struct CapRanges {
    VolumeGeometry::Range light{0, 0}, dark{0, 0};
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
    const ShadowVolumes& volumes() const { return _volumes; }
    const VolumeGeometry& sides() const { return *_sides; }
    /// See mayShowBack(); asked once for the same eye.
    bool showsBack(const SightStart& start, unsigned part, bool mayBeCut);
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
    glm::dvec4 _towardsEye{0.0};
    std::map<std::pair<unsigned, bool>, bool> _showBacks; ///< by part and mayBeCut, seen from there.
    std::vector<CapsWanted> _capped;                      ///< those that have caps,
    std::vector<CapRanges> _ranges;                       ///< and where.
    osg::ref_ptr<VolumeGeometry> _caps;
};

/// A light in the frame of a mesh.
glm::dvec4 lightIn(const VolumeCaster& caster, const glm::dvec4& lightInScene);

/// In clip space the eight corners of a box, and where the volume behind it ends after each of them.
using VolumeHull = std::array<glm::dvec4, 16>;

/// @param end  see nearestEnd(). @param light  w is 0 and the direction has length 1, or w is 1.
VolumeHull volumeHull(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec4& end, const glm::dvec4& light,
                      const glm::dmat4& clipFromBox);

/// True if the box itself may be seen.
bool isInSight(const VolumeHull& hull);

/// As screenBounds(), which is slower.
std::optional<ScreenRect> boundsOf(const VolumeHull& hull);

} // namespace gnomon
