// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MarkJob.h>
#include <gnomon/PlanarCasters.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace gnomon {

/// Marks of one plane and light in one view: the flattened casters, cut where need be to the pixels whose depth is the
/// plane's.
class PlanarMark : public MarkJob {
public:
    osg::ref_ptr<const PlanarCasters> casters;
    glm::dmat4 clipFromCaster{1.0}; ///< flattened and projected.
    glm::dvec4 abovePlane{0.0};     ///< see planarClipPlanes(); about the mesh's origin.
    glm::dvec4 belowLight{0.0};
    bool reachesLight = false; ///< some caster is as high as the light.
    bool cutToPlane = true;    ///< marks hold only where what one sees lies in the plane.
    /// The plane on the screen, normalised device coordinates: z = depth.x·x + depth.y·y + depth.z.
    glm::dvec3 depth{0.0};

    void mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;

protected:
    ~PlanarMark() override = default;

private:
    void drawCasters(osg::RenderInfo& renderInfo) const;
    void cut(const osg::State& state, ScreenPass& pass, unsigned bit) const;
};

} // namespace gnomon
