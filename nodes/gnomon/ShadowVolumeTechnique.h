// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>
#include <gnomon/ShadowVolumeOptions.h>

#include <memory>
#include <vector>

namespace gnomon {

class VolumeCache;

/// Casts exact shadows onto everything visible, by stencil volumes.
///
/// Use it for casters of few edges, such as buildings, machines and furniture: its edges have no texels, and it is the
/// fastest technique there. Use ShadowMapTechnique for dense meshes, foliage and penumbras.
///
///     group->addChild(new gnomon::ShadowVolumeTechnique);
///
/// Cost
/// - Each frame and light: the volumes' sides are drawn into the stencil buffer. The pixels that they cover are the cost.
/// - When a light moves: a pass over the casters' triangles and edges, and an upload of the outlines.
/// - When a caster moves as a whole: the same for it alone. Small casters that are joined are searched again.
/// - Volumes end below all that receives. Volumes out of sight are not drawn.
/// - Smooth edges: a copy of the depths, eight steps over the pixels that shadow can reach, and the sides once more.
/// - If the eye may be inside a volume, sees the back of an open sheet or looks through it, its triangles are drawn, too.
/// Needs
/// - Depth clamp, of OpenGL 3.2 or GL_ARB_depth_clamp.
/// - One stencil bit a light, one more where a receiver is named, and one or more that count. Smooth edges: two more bits, alpha bits
///   and framebuffer objects.
/// Limits
/// - Dense meshes have thousands of edges one before the other: maps are faster there.
/// - A single sheet seen from behind is lit as OpenGL lights it: it does not shadow itself.
/// - Single pixels of a seam may stay lit where the dark side of an open sheet meets the ground, as at a cliff's foot.
/// - Smooth edges: a shadow narrower than a pixel shows where it covers a pixel's middle. A pixel that several edges cut is as the
///   nearest of them has it on each side.
/// - Facets decide what faces the light. Smooth bodies: see ShadowCasterGroup::setTerminatorOffset().
/// - Casters that are clear in part cast as if they were solid, and diagnose() says so.
/// - Casters that draw themselves, or are made of patches, cast nothing. diagnose() says so.
/// - Counts have up to seven bits. More casters between a light and a place take several rounds. If one connected mesh
///   lies over itself more often, its shadow may have holes, and diagnose() says so.
/// - Casters are kept as floats about the place where most triangles are. Others at 100 km are right to a centimetre.
/// - Far from a very close near plane, depths are too coarse to place shadows. diagnose() names such a caster.
/// - Vertices very far from their origin, as in national coordinates, are drawn off their place. diagnose() names them.
/// - Drawables that write no depth do not receive.
/// - A spot casts as a lamp: its cone is as OpenGL draws it, by vertex.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - F. Crow, "Shadow Algorithms for Computer Graphics", SIGGRAPH 1977.
/// - C. Everitt, M. Kilgard, "Practical and Robust Stenciled Shadow Volumes for Hardware-Accelerated Rendering", 2002.
/// - B. Kim, K. Kim, G. Turk, "A Shadow-Volume Algorithm for Opaque and Transparent Nonmanifold Casters", 2008.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::ShadowVolumeTechnique {
///       UniqueID 2
///       View VOLUMES
///     }
class GNOMON_EXPORT ShadowVolumeTechnique : public ShadowTechnique {
public:
    using Edges = ShadowVolumeOptions::Edges;                     ///< See ShadowVolumeOptions::Edges.
    static constexpr Edges HARD = ShadowVolumeOptions::HARD;      ///< See ShadowVolumeOptions::HARD.
    static constexpr Edges SMOOTH = ShadowVolumeOptions::SMOOTH;  ///< See ShadowVolumeOptions::SMOOTH.
    using View = ShadowVolumeOptions::View;                       ///< See ShadowVolumeOptions::View.
    static constexpr View NOTHING = ShadowVolumeOptions::NOTHING; ///< See ShadowVolumeOptions::NOTHING.
    static constexpr View VOLUMES = ShadowVolumeOptions::VOLUMES; ///< See ShadowVolumeOptions::VOLUMES.

    /// A technique with every opaque drawable as receiver.
    ShadowVolumeTechnique();
    /// Copies the properties.
    ShadowVolumeTechnique(const ShadowVolumeTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, ShadowVolumeTechnique)

    /// Sets all properties at once.
    void setOptions(const ShadowVolumeOptions& options) { _options = options.usable(); }
    /// See setOptions().
    const ShadowVolumeOptions& getOptions() const { return _options; }
    /// See ShadowVolumeOptions::edges.
    void setEdges(Edges edges) {
        _options.edges = edges;
        setOptions(_options);
    }
    /// See ShadowVolumeOptions::edges.
    Edges getEdges() const { return _options.edges; }
    /// See ShadowVolumeOptions::view.
    void setView(View view) {
        _options.view = view;
        setOptions(_options);
    }
    /// See ShadowVolumeOptions::view.
    View getView() const { return _options.view; }

    /// Number of times that volumes were found so far: once for each change of a light or the casters.
    unsigned builds() const;
    /// The same.
    unsigned passes() const override { return builds(); }

    /// Finds the volumes of one light, and makes the mark that draws them. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                            const Casters& casters) const override;

    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~ShadowVolumeTechnique() override;

private:
    ShadowVolumeOptions _options;
    std::unique_ptr<VolumeCache> _cache;
};

} // namespace gnomon
