// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/VolumeGeometry.h>
#include <gnomon/silhouette/ShadowVolumes.h>
#include <gnomon/silhouette/SightStart.h>
#include <gnomon/volume/ReceiverBox.h>
#include <gnomon/volume/VolumeCasters.h>

#include <map>
#include <utility>

namespace gnomon {

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

} // namespace gnomon
