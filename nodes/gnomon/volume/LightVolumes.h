// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/silhouette/ShadowVolumes.h>
#include <gnomon/volume/ReceiverBox.h>
#include <gnomon/volume/VolumeCasters.h>
#include <gnomon/volume/VolumeGeometry.h>

namespace gnomon {

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
    /// What closes the volumes of these parts, each in its range; made once for the same ones.
    /// @param parts  of the mesh. @param ranges  by part.
    osg::ref_ptr<const VolumeGeometry> capsOf(const std::vector<unsigned>& parts,
                                              std::vector<VolumeGeometry::Range>& ranges);

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
    std::vector<unsigned> _capped;              ///< those that have caps,
    std::vector<VolumeGeometry::Range> _ranges; ///< and where.
    osg::ref_ptr<VolumeGeometry> _caps;
};

/// A light in the frame of a mesh.
glm::dvec4 lightIn(const VolumeCaster& caster, const glm::dvec4& lightInScene);

} // namespace gnomon
