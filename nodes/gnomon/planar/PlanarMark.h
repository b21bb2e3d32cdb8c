// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/MarkEdges.h>
#include <gnomon/planar/PlanarCasters.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/StateSet>

namespace gnomon {

/// The programs that flatten. They belong to a node, so that they are released with the node's other OpenGL objects.
struct PlanarPrograms : public osg::Referenced {
    PlanarPrograms();
    osg::ref_ptr<osg::StateSet> plain;    ///< flattens only.
    osg::ref_ptr<osg::StateSet> clipping; ///< and writes clip distances, which costs a third more a vertex on llvmpipe.
    const osg::ref_ptr<MarkEdges> edges;
};

/// Marks of one plane and light in one view: the flattened casters, cut where need be to the pixels whose depth is the
/// plane's.
class PlanarMark : public Mark {
public:
    /// How far from the plane's depth what lies in it may be drawn: pixels of the plane's slope, steps of the depth buffer.
    ///
    /// A rasteriser interpolates depth in float: on llvmpipe 32 steps of the depth buffer hold that, but for a ground of
    /// many kilometres under a near plane of decimetres (tests/render/PlanarBandTest.cpp). And it snaps vertices to a part
    /// of a pixel, which OpenGL lets be as coarse as a sixteenth: an eighth of a pixel's slope. A larger margin would reach
    /// up walls that stand in the plane.
    static constexpr glm::dvec2 tolerance{1.0 / 8.0, 32.0};

    osg::ref_ptr<const PlanarCasters> casters;
    osg::ref_ptr<const PlanarPrograms> programs;
    glm::dmat4 clipFromScene{1.0}; ///< flattened and projected.
    glm::dvec4 abovePlane{0.0};    ///< see planarClipPlanes(); in the scene, see SceneFrame.
    glm::dvec4 belowLight{0.0};
    bool reachesLight = false; ///< some caster is as high as the light.
    bool mirrored = false;     ///< the view turns the sense of triangles round.
    bool isSmooth = false;     ///< edges are.
    bool cutToPlane = true;    ///< marks hold only where what one sees lies in the plane.
    /// The plane on the screen, normalised device coordinates: z = depth.x·x + depth.y·y + depth.z.
    glm::dvec3 depth{0.0};
    glm::dvec3 nearest{0.0},
        farthest{0.0}; ///< the same of the highest and the lowest of what lies in the plane by flatness.
    /// How far polygon offsets move what lies in the plane away from the eye, at least and at most: pixels of the plane's
    /// slope, and steps of the depth buffer.
    glm::dvec2 nearestOffset{0.0}, farthestOffset{0.0};

    glm::dvec4 eyePlane{0.0}; ///< unit normal.

    /// True if the leaf's box comes to the plane but for a hundredth of its size.
    bool canReach(const osgUtil::RenderLeaf& leaf) const override;
    std::string draw(ScreenPass& pass) const override;
    const MarkEdges* edges() const override { return isSmooth ? programs->edges.get() : nullptr; }
    void drawEdges(ScreenPass& pass) const override;

protected:
    ~PlanarMark() override = default;

private:
    bool drawParts(osg::RenderInfo& renderInfo) const;
    bool clips(const PlanarPart& part) const { return part.crossing || reachesLight; }
    void drawPart(osg::RenderInfo& renderInfo, const PlanarPart& part, bool cullsSolids) const;
    void cut(ScreenPass& pass) const;
};

} // namespace gnomon
