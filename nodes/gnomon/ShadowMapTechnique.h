// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/ShadowTechnique.h>

#include <memory>
#include <vector>

namespace gnomon {

class Casters;
class ShadowMapCache;

/// Casts shadows onto everything visible, by depth maps. Choose it for penumbras, spots and leaves.
///
/// It fits, keeps and biases its maps by itself. Start with AutoShadowTechnique, which takes it where it costs least. Use
/// PlanarShadowNode for flat floors, TerrainShadowGeode for terrain, and volume or traced for exact hard edges.
///
///     osg::ref_ptr<gnomon::ShadowMapTechnique> shadow = new gnomon::ShadowMapTechnique;
///     shadow->setSize(2048);
///     group->addChild(shadow);
///
/// Cost
/// - Each frame and light: a copy of the depth buffer and one quad within the shadows' bounds.
/// - When a map changes: one draw of the casters' positions.
/// - Moving casters: a draw of them alone, two copies of the texels they cover, and a second texture of the maps' size.
/// - Each pixel within those bounds: one comparison of 2 × 2 texels; four with BICUBIC, 16 with FINE and SMOOTH edges.
/// - SMOOTH and SOFT edges: another copy and quad, unless a single light blends.
/// - Penumbras: 16 texels and 8 to 32 comparisons more a pixel.
/// - A spot under RELIGHT: another copy and quad over the whole view.
/// Needs
/// - A depth buffer.
/// - One stencil bit a light, and one more where a receiver is named.
/// - SMOOTH and SOFT edges: alpha bits, unless a single light blends.
/// - Penumbras: OpenGL 3.3 or its sampler objects.
/// Limits
/// - On a ground of many kilometres that begins under a close near plane, things of centimetres may lose their shadow, if the
///   ground is one drawable of more than 2,000 triangles or a program moves it.
/// - Facets decide what faces away from the light, and such a facet is wholly in shadow; one along the light is wholly lit or
///   wholly dark. Smooth bodies, unless a program moves them: see ShadowCasterGroup::setTerminatorOffset().
/// - An edge is off by a fraction of a texel, see ShadowMapOptions::Filter.
/// - An object loses its shadow if it is less than about a texel off the receiver, measured along the light.
/// - A wall thinner than about two texels may let single pixels of light through where it stands on the floor.
/// - An object also loses its shadow where it is nearer than OpenGL draws things off their place, by large
///   coordinates in vertices.
/// - Far from a very close near plane, depths are too coarse to place shadows. diagnose() names such a caster.
/// - Vertices very far from their origin, as in national coordinates, are drawn off their place. diagnose() names them.
/// - A lamp inside a closed box may light single pixels along the box's edges.
/// - Where a lit face is one pixel wide between others, a pixel of it may be dark.
/// - A penumbra is that of one straight edge at the blockers' mean distance. Overlapping edges at several distances are
///   only estimated.
/// - Penumbras are streaky where a caster is nearer to the lamp than the lamp is wide.
/// - Penumbras end at 128 texels, and at the borders of a lamp's maps.
/// - Casters that draw themselves, or that a program moves, need bounds that hold them: what is beyond may cast nothing. Each
///   costs as much as in the view, in every map that changes.
/// - A program that moves casters must take OpenGL's or OpenSceneGraph's projection, or one that
///   ShadowCasterGroup::addMatrixUniform() names, and set no depth of its own. Else they cast where their arrays stand, and
///   diagnose() names the node.
/// - A caster that draws itself is redrawn each frame if it has no display list or is DYNAMIC. Otherwise, changes of its
///   place, bounds, state sets and uniforms show.
/// - Glass casts no tinted shadow: a point of a caster is solid or clear, see ShadowCasterGroup::setOpaqueFrom().
/// - Drawables that write no depth do not receive. A polygon offset or depth range moves the place that receives.
/// - Multisampled framebuffers are shadowed by pixel, from one sample.
/// - ShadowQuery takes all casters for solid, and ignores spot cones.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - L. Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978.
/// - W. Reeves, D. Salesin, R. Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987.
/// - CS-4470, part 2.
///
/// Maps
/// - A map covers only those visible receivers that a caster can shadow, and a sixteenth more on each side.
/// - A map is drawn again if the light or a caster in it changes.
/// - A map is fitted again if the view leaves it or would fill less than half of it.
/// - Casters between a map and the light always count, even outside the map's depth range.
/// - A flat caster, such as a ground, is left out while all visible receivers are on the light's side of it.
/// Texels
/// - A map has only as many texels as the view can show, and never more than setSize().
/// - On the nearest receiver, a texel is at most 1.5 pixels wide, and a third of a pixel for SOFT edges.
/// - A map is drawn again with more texels if it has an eighth too few.
/// Moving casters
/// - Casters are in two layers, static and moving. All start in the static one.
/// - A caster that changes joins the moving layer, at the cost of one full redraw. After that, it is drawn alone.
/// Bias
/// - There is none to set. Both the caster's and the receiver's slope within the compared texels are allowed for, and
///   the rounding of both depths. So is what OpenGL loses of large coordinates in vertices.
/// Spots
/// - A light with a cutoff (osg::Light::setSpotCutoff(), ShadowLight::cutoff) of up to 75 degrees has one map. A wider
///   spot has a lamp's maps.
/// - RELIGHT darkens every pixel outside the cone, exactly. BLEND leaves the cone as OpenGL draws it, by vertex.
/// - OpenGL lights a triangle by its vertices: without a vertex in the cone there is no light, and none is added.
/// - Unlit drawables, such as a sky, darken outside the cone as in any shadow. Name receivers to prevent that.
/// - Without any caster, RELIGHT changes nothing.
/// Alpha
/// - A caster casts where it passes its alpha test. One that blends without a test casts where its alpha is
///   ShadowCasterGroup::setOpaqueFrom() or more.
/// - Casters whose alpha is that of a 2D texture on unit 0 are drawn together. Others, such as those whose program
///   discards or moves vertices, are drawn into the map one by one with their own state, and anew where the view moves.
/// - If the map is coarser than the texture, the texture's mipmaps are tested.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::ShadowMapTechnique {
///       UniqueID 2
///       Size 2048
///       Filter BILINEAR
///     }
class GNOMON_EXPORT ShadowMapTechnique : public ShadowTechnique, public ShadowMapNames {
public:
    /// A technique with the default properties.
    ShadowMapTechnique();
    /// Copies the properties.
    ShadowMapTechnique(const ShadowMapTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, ShadowMapTechnique)

    /// Sets all properties at once. Each setter below sets one. ShadowMapOptions::usable() says what becomes of values
    /// out of range.
    void setOptions(const ShadowMapOptions& options) { _options = options.usable(); }
    /// See setOptions().
    const ShadowMapOptions& getOptions() const { return _options; }

    /// See ShadowMapOptions::size.
    void setSize(int texels) { change(_options.size, texels); }
    /// See ShadowMapOptions::size.
    int getSize() const { return _options.size; }
    /// See ShadowMapOptions::filter.
    void setFilter(Filter filter) { change(_options.filter, filter); }
    /// See ShadowMapOptions::filter.
    Filter getFilter() const { return _options.filter; }
    /// See ShadowMapOptions::cascades.
    void setCascades(int maps) { change(_options.cascades, maps); }
    /// See ShadowMapOptions::cascades.
    int getCascades() const { return _options.cascades; }
    /// See ShadowMapOptions::edges.
    void setEdges(Edges edges) { change(_options.edges, edges); }
    /// See ShadowMapOptions::edges.
    Edges getEdges() const { return _options.edges; }
    /// See ShadowMapOptions::sunAngle.
    void setSunAngle(double degrees) { change(_options.sunAngle, degrees); }
    /// See ShadowMapOptions::sunAngle.
    double getSunAngle() const { return _options.sunAngle; }
    /// See ShadowMapOptions::lampSize.
    void setLampSize(double diameter) { change(_options.lampSize, diameter); }
    /// See ShadowMapOptions::lampSize.
    double getLampSize() const { return _options.lampSize; }
    /// See ShadowMapOptions::radius.
    void setRadius(double radius) { change(_options.radius, radius); }
    /// See ShadowMapOptions::radius.
    double getRadius() const { return _options.radius; }
    /// See ShadowMapOptions::view.
    void setView(View view) { change(_options.view, view); }
    /// See ShadowMapOptions::view.
    View getView() const { return _options.view; }
    /// See ShadowMapOptions::programUnit.
    void setProgramUnit(int unit) { change(_options.programUnit, unit); }
    /// See ShadowMapOptions::programUnit.
    int getProgramUnit() const { return _options.programUnit; }

    /// GLSL 1.30 source of the lookup function for setProgramUnit(). Add it to a program as another fragment shader.
    /// It returns the share of the light that arrives. Edges follow the filter; there are no penumbras.
    ///
    ///     float gnomon_visibility(vec3 eye); // declare it like this; eye: position in eye coordinates
    std::string programFunction() const;

    /// Number of maps drawn so far, over all lights, views and contexts. It rises only if something changed.
    /// A map counts once a frame if any caster is drawn into it.
    unsigned passes() const override;

    /// Updates the maps of one light and makes the marks that look them up. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                            const Casters& casters) const override;

    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

    /// True.
    bool drawsCasters() const override { return true; }
    /// See ShadowTechnique::letGo().
    void letGo() const override;

protected:
    ~ShadowMapTechnique() override;

private:
    template <typename Value>
    void change(Value& option, Value to) { // to a usable one
        option = to;
        setOptions(_options);
    }

    ShadowMapOptions _options;
    std::unique_ptr<ShadowMapCache> _maps;
};

} // namespace gnomon
