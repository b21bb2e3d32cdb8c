// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>

#include <memory>
#include <vector>

namespace gnomon {

class ResolvedDepth;
class TracedCasters;

/// Shadow on everything that is seen, by one ray a pixel towards the light: the accurate end of the chart.
///
///     group->addChild(new gnomon::TracedShadowTechnique);
///
/// Where surfaces are is read from the depth buffer, so that whatever draws, shaders and all, receives; see depthShadow()
/// for how a depth's own error is kept from showing.
///
/// Cost    0.1 to 0.35 µs of one core a pixel within the casters' and shadows' bounds, on all cores, and reading the depth
///         buffer; whenever the casters change, a tree over them: 0.6 to 0.8 µs a triangle, see RayScene. No draw of any
///         geometry, but the compositor's. Building for more than a second tells its progress on stderr, if that is a
///         terminal.
/// Needs   Embree, a depth buffer that can be read; 1 stencil bit a light, 1 more where a receiver is named.
/// Limits  a sample a pixel, hard edges. Facets, not smoothed normals, decide what is turned away from the light: low-poly
///         models show them near the terminator. Alpha-tested casters cast as if they were solid. Multisampled framebuffers
///         are decided a pixel, by one of its samples: the shadows' edges are not smoothed. In multisampled windows they
///         may be off by a pixel, for OpenGL does not tell which sample that is; and a texture of several samples for the
///         depth is diagnosed, and shows no shadow. What writes no depth does not receive; what is drawn with a polygon
///         offset or a depth range of its own receives as if it stood where its depth says.
/// Threads any number of cull and draw threads; set properties between frames.
/// Source: I. Wald et al., "Embree", ACM TOG 33(4), 2014.
///
/// In a file (.osgt, .osgb, .osgx), here with its default, no receiver named:
///
///     gnomon::TracedShadowTechnique {
///       UniqueID 2
///     }
class GNOMON_EXPORT TracedShadowTechnique : public ShadowTechnique {
public:
    TracedShadowTechnique();
    TracedShadowTechnique(const TracedShadowTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, TracedShadowTechnique)

    std::vector<osg::ref_ptr<MarkJob>> prepare(const ViewFrame& view, const ShadowLight& light,
                                               const GroupCasters& casters) const override;

    /// How often this built a tree: rises by one with each revision of the casters, whatever the views and lights, unless a
    /// ShadowQuery or another technique has a tree of the same casters, which is then shared.
    unsigned builds() const;

    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~TracedShadowTechnique() override;

private:
    std::unique_ptr<TracedCasters> _casters;
    std::shared_ptr<ResolvedDepth> _resolved; ///< a frame that is still drawn keeps it.
};

} // namespace gnomon
