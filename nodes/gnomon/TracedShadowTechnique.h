// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>
#include <gnomon/TracedShadowOptions.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace gnomon {

class ResolvedDepth;
class RaySceneCache;
class TracedFrames;

/// Casts exact shadows onto everything visible, by one ray a pixel towards the light, or 16 at edges.
///
/// It is the exact technique: use it for reference pictures, and for static scenes of very many triangles. Use
/// ShadowMapTechnique for moving casters or penumbras.
///
///     group->addChild(new gnomon::TracedShadowTechnique);
///
/// The depth buffer says where the surfaces are. Everything that writes depth receives, whatever shader draws it.
///
/// Cost
/// - Smooth edges: 16 rays and as many short ones for each pixel at an edge; none while nothing changes.
/// - One ray for each pixel within the casters' and shadows' bounds, on all cores.
/// - Pixels whose depth, light and casters are those of the frame before cost a comparison.
/// - A read of the depth buffer.
/// - Where casters are clear in part by a texture: a look at its texels for each triangle of theirs that a ray meets, and a byte
///   a texel.
/// - After a change of the casters: a ray tree over what changed, see RayScene. A large drawable that moves as a whole
///   keeps its tree.
/// - If stderr is a terminal, a build of more than a second shows its progress there.
/// Needs
/// - Embree: see OptionalPart::Traced. A depth buffer that can be read.
/// - One stencil bit a light, and one more where a receiver is named. Smooth edges: two more bits, alpha bits and framebuffer
///   objects.
/// Limits
/// - Edges are hard, by one sample a pixel, unless TracedShadowOptions::SMOOTH is set.
/// - A single sheet seen from behind is lit as OpenGL lights it: it does not shadow itself.
/// - Facets decide what faces the light. Smooth bodies: see ShadowCasterGroup::setTerminatorOffset().
/// - Casters that are clear in part by the alpha of vertices, by a program, or by a texture whose texels are not in memory cast as if
///   they were solid, and diagnose() says so. Of a texture the largest level counts, however far it is.
/// - Casters that draw themselves, or are made of patches, cast nothing. diagnose() says so.
/// - Casters are kept as floats about the place where most triangles are. Others at 100 km are right to a centimetre.
/// - Drawables that write no depth do not receive. A polygon offset or depth range moves the place that receives.
/// - Multisampled framebuffers are shadowed by pixel, from one sample. In multisampled windows an edge may be off by a
///   pixel.
/// - A multisampled depth texture gets no shadow, and diagnose() says so.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - I. Wald et al., "Embree: A Kernel Framework for Efficient CPU Ray Tracing", ACM TOG 33(4), 2014.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::TracedShadowTechnique {
///       UniqueID 2
///       Edges SMOOTH
///     }
class GNOMON_EXPORT TracedShadowTechnique : public ShadowTechnique {
public:
    /// A technique with every opaque drawable as receiver.
    TracedShadowTechnique();
    /// Copies the properties.
    TracedShadowTechnique(const TracedShadowTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, TracedShadowTechnique)

    using Edges = TracedShadowOptions::Edges;                    ///< See TracedShadowOptions::Edges.
    static constexpr Edges HARD = TracedShadowOptions::HARD;     ///< See TracedShadowOptions::HARD.
    static constexpr Edges SMOOTH = TracedShadowOptions::SMOOTH; ///< See TracedShadowOptions::SMOOTH.

    /// Sets all properties at once. Unknown edges become the default.
    void setOptions(const TracedShadowOptions& options) { _options.edges = options.edges == SMOOTH ? SMOOTH : HARD; }
    /// See setOptions().
    const TracedShadowOptions& getOptions() const { return _options; }
    /// See TracedShadowOptions::edges.
    void setEdges(Edges edges) { setOptions({edges}); }
    /// See TracedShadowOptions::edges.
    Edges getEdges() const { return _options.edges; }

    /// Makes the mark that casts the rays of one light. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                            const Casters& casters) const override;

    /// See OptionalPart::Traced.
    std::string whyUnavailable() const override;
    /// True: rays pass where a texture is clear.
    bool cutsByTextures() const override { return true; }

    /// Number of revisions of the casters that needed ray trees over triangles, whatever the views and lights.
    /// A tree that a ShadowQuery or another technique has of the same casters is shared and does not count.
    unsigned builds() const;
    /// The same.
    unsigned passes() const override { return builds(); }

    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~TracedShadowTechnique() override;

private:
    friend std::size_t tracedPixels(const TracedShadowTechnique& technique); // rays so far; for tests

    TracedShadowOptions _options;
    std::unique_ptr<RaySceneCache> _casters;
    std::shared_ptr<ResolvedDepth> _resolved; ///< a frame that is still drawn keeps it, and the next.
    std::shared_ptr<TracedFrames> _frames;
};

} // namespace gnomon
