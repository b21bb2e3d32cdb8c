// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMarkers.h>
#include <gnomon/CompositorOptions.h>
#include <gnomon/Export.h>
#include <gnomon/LightUniform.h>
#include <gnomon/MatrixUniform.h>
#include <gnomon/NamesNodes.h>
#include <gnomon/ObservedNode.h>
#include <gnomon/Selection.h>
#include <gnomon/ShadowLight.h>

#include <osg/Group>
#include <osg/LightSource>

#include <vector>

namespace gnomon {

class Casters;
class CasterTable;
struct CasterView;

/// Group whose subgraph casts shadows. Every scene with Gnomon's shadows has one.
///
/// Wrap the scene, or any part of it, and add a technique beside it. The scene's own nodes stay as they are.
/// The techniques are PlanarShadowNode, ShadowMapTechnique, ShadowVolumeTechnique, TerrainShadowGeode and
/// TracedShadowTechnique.
///
///     osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
///     group->addChild(scene);
///     group->addChild(new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0)));
///
/// Cost
/// - Each frame and view: one visit of the casters' nodes, to find changes.
/// - After a change: an extraction of what changed. A drawable of 256 triangles or more that moves costs a matrix.
/// - RELIGHT: one more draw of the drawables that shadows touch.
/// - BLEND: one multiplication a shadowed pixel.
/// - DrawThreadPerContext: the next frame starts while shadows are drawn, unless something in view is DYNAMIC, a caster draws
///   itself in a map, or there are mirror images or halos.
/// Needs
/// - OpenGL 3.0 with GLSL 1.30, in a compatibility profile, for every technique. A framebuffer without stencil bits, or
///   without alpha bits for soft edges, costs copies to one that has them.
/// Limits
/// - RELIGHT shadows three lights. BLEND shadows any number, but darkens a pixel only once.
/// - RELIGHT darkens unlit receivers by setDark(), and receivers whose program reads no light it knows.
/// - RELIGHT falls back to BLEND if an opaque drawable has a stencil test of its own. What the test hides takes shadows away
///   where OpenGL hands over no depths: from several samples, or without GL_MESA_framebuffer_flip_y. diagnose() says so.
/// - Reversed depth and core profile contexts are refused.
/// - Depth that a program sets, and vertices that a program moves, are not followed.
/// - A technique's diagnose() reports each of the five cases above.
/// - RELIGHT, and a named receiver, draw drawables again. Their draw callbacks then run more than once a frame.
/// - Only the first of several colour attachments receives shadows. The others stay as they are.
/// - A drawable in render bin 8 or higher receives if it writes depth, has bounds and an alpha of 1. One whose alpha differs from
///   place to place, by textures, vertices or a program, receives where it is a half or more, and with hard edges.
/// - What has one alpha below 1 receives no shadow. Through one that writes depth, a receiver of bin 8 or higher looks lit.
/// - Under smooth and soft edges, drawables that blend or write no depth are darkened by setDark().
/// - VertexTraverser lists which drawables never cast; but billboards, and AutoTransforms that turn, cast as each view draws
///   them: while the camera moves they are read again. What is not drawn does not cast either: what clip planes, culling of
///   both faces, masks, tests that never pass or an empty scissor box take away, and polygons drawn as lines or points.
///   Nor does what is drawn at the far plane, as skies are. Of what a stipple thins out, half must be left.
/// - Within the length of a facet behind the rim of a smooth body nothing gets its shadow: see setTerminatorOffset(). Under
///   BLEND the unlit side of a body ends in its facets' outline.
/// - A ClipPlane that is no ClipNode's is taken as given in the frame of each drawable that it cuts.
/// - A drawable that draws itself, or is made of patches, casts in ShadowMapTechnique alone. Others report it.
/// - Quads that are not flat cast as NVIDIA's and Mesa's drivers cut them, by the driver's name; others may cut them otherwise.
///   Mesa's llvmpipe cuts quads of glDrawArrays() outside display lists now so, now so: draw those that are not flat by indices.
///   Triangles are the same everywhere.
/// - An LOD casts as its view shows it. A cull callback that chooses among children is not asked.
/// - osgUtil::Optimizer leaves what is below the group as it is if the group, or a node below it, names nodes.
/// - Its SPATIALIZE_GROUPS replaces a Geode that is named and stands elsewhere. Its COPY_SHARED_NODES copies such nodes.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::ShadowCasterGroup {
///       UniqueID 1
///       Children 2 { ... }
///       Casters { Mask 0xff Node FALSE }
///       Composite BLEND
///       Dark 0.3
///       OpaqueFrom 0.8
///       LightSources 1 { osg::LightSource { UniqueID 9 } }
///       Lights 1 { 0 433000.25 5410000.5 60 1 }
///       Spots 1 { 0 0 -1 30 }
///       LightUniforms 1 { 0 "sunColor" }
///       CompositorOptions 15 TRUE 10000
///       Clipping ALL
///       TerminatorOffset FALSE
///       MatrixUniforms 1 { 0 "mvp" }
///     }
class GNOMON_EXPORT ShadowCasterGroup : public osg::Group, public ShowsChildren, public NamesNodes {
public:
    /// How the compositor darkens shadowed pixels.
    enum Composite : int {
        RELIGHT, ///< Exact: draws them again without the light's diffuse and specular.
        BLEND    ///< Cheap: multiplies their colour by setDark(), once a pixel.
    };

    /// Which clip planes, of osg::ClipNode and osg::ClipPlane, cut what casts. Each cuts what is seen.
    enum Clipping : int {
        GRAPH, ///< Those of the main graph, as of a section through a building. Not those of a view: of a nested camera's state
        ///< set, between it and the group, or in the eye's frame, as a pass for refraction has.
        ALL, ///< All, as where a nested camera draws the whole scene.
        NONE ///< None, so that sun does not shine into a building that is cut open.
    };

    /// An empty group.
    ShadowCasterGroup();
    /// Copies the properties. A deep copy names its own copies of casters, light sources and receivers.
    ShadowCasterGroup(const ShadowCasterGroup& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, ShadowCasterGroup)

    /// The part of this group's subgraph that casts. Default: all of it.
    /// The group does not keep the node, which may stand above it.
    void setCasters(const Selection& casters);
    /// See setCasters(). Null and the mask 0, which select nothing, if the node is gone.
    Selection getCasters() const { return _casters.in(*this); }
    /// True if setCasters() has named a node that has been deleted since.
    bool areCastersGone() const { return _casters.isGone(*this); }

    /// Alpha from which on a blending drawable casts, 0 … 1. 0: all cast.
    /// Default -1, as any number below 0: a drawable with one alpha below 1 all over, as glass and water have, lets light through
    /// and casts nothing. Where textures or vertices give several alphas, parts of 0.5 or more cast.
    /// Alpha is that of textures, times that of osg::Material or of colours. A program's alpha counts in transparent bins alone,
    /// from 0.5 on. ShadowMapTechnique leaves out the clear parts, and TracedShadowTechnique those that a texture tells. The others
    /// leave out triangles that are clear all over.
    /// More than 1 is 1. NaN is refused with a warning.
    void setOpaqueFrom(float alpha);
    /// See setOpaqueFrom().
    float getOpaqueFrom() const { return _opaqueFrom; }

    /// Which clip planes cut what casts. Default GRAPH, which also replaces any unknown value.
    void setClipping(Clipping clipping);
    /// See setClipping().
    Clipping getClipping() const { return _clipping; }

    /// Whether smoothly shaded bodies cast from a little farther on at their terminator, so that they have no teeth there: by
    /// the length of a facet, along the light's rays, where vertex normals are within 25 degrees of the facets. Outlines of
    /// shadows stay. Off: their facets shadow one another as they stand. Default true.
    void setTerminatorOffset(bool offset);
    /// See setTerminatorOffset().
    bool getTerminatorOffset() const { return _terminatorOffset; }

    /// How shadowed pixels are darkened. Default RELIGHT, which also replaces any unknown value.
    void setComposite(Composite composite) { _composite = composite == BLEND ? BLEND : RELIGHT; }
    /// See setComposite().
    Composite getComposite() const { return _composite; }

    /// Factor for the colour of shadowed pixels under BLEND, 0 (black) … 1 (unchanged). Default 0.5.
    /// Clamped. NaN is refused with a warning.
    void setDark(float factor);
    /// See setDark().
    float getDark() const { return _dark; }

    /// Adds a light that casts. Without any, every light that is on in the view casts.
    /// The LightSource may stand anywhere in the graph, also under transforms. The group does not keep it.
    void addLight(osg::LightSource* light);
    /// Adds a light by its position in the group's frame, in double: for lamps far from the origin.
    /// A light number outside 0 … 7 is refused with a warning.
    void addLight(const ShadowLight& light);
    /// Removes all lights of both kinds, so that every light in the view casts again.
    void removeLights();
    /// Replaces the light sources. Null entries are skipped.
    void setLightSources(std::vector<osg::ref_ptr<osg::LightSource>> sources);
    /// The light sources that cast and are not gone.
    std::vector<osg::ref_ptr<osg::LightSource>> getLightSources() const;
    /// Number of light sources that were added. Sources that have been deleted since count.
    unsigned getNumLightSources() const { return static_cast<unsigned>(_lightSources.size()); }
    /// Replaces the lights given by position. A light number outside 0 … 7 is refused with a warning.
    void setLights(std::vector<ShadowLight> lights);
    /// The lights given by position.
    const std::vector<ShadowLight>& getLights() const { return _lights; }

    /// Names a uniform by which the receivers' programs read a light. RELIGHT sets it to 0 in that light's shadow.
    /// Default: none. Array elements do not work. A light number outside 0 … 7 is refused with a warning.
    void addLightUniform(const LightUniform& uniform);
    /// Replaces the light uniforms.
    void setLightUniforms(std::vector<LightUniform> uniforms);
    /// The light uniforms.
    const std::vector<LightUniform>& getLightUniforms() const { return _lightUniforms; }

    /// Names a uniform by which the casters' programs project, where OpenGL's and OpenSceneGraph's matrices are not read.
    /// ShadowMapTechnique lets such programs draw what they move or discard, with the light's matrix in the uniform.
    /// Default: none. An unknown kind is refused with a warning.
    void addMatrixUniform(const MatrixUniform& uniform);
    /// Replaces the matrix uniforms.
    void setMatrixUniforms(std::vector<MatrixUniform> uniforms);
    /// The matrix uniforms.
    const std::vector<MatrixUniform>& getMatrixUniforms() const { return _matrixUniforms; }

    /// Limits of the view's compositor. See CompositorOptions for several nodes in one view. Default: none.
    void setCompositorOptions(const CompositorOptions& options) { _options = options; }
    /// See setCompositorOptions().
    const CompositorOptions& getCompositorOptions() const { return _options; }

    /// True for the class itself, whose traversal visits all children.
    bool showsAllChildren() const override;

    /// The casters and the light sources, where some are named.
    std::vector<Selection> namedParts() const override;
    /// Traverses the children, but keeps osgUtil::Optimizer from what it would spoil.
    void traverse(osg::NodeVisitor& visitor) override;
    /// Traverses the parents, but not for osgUtil::Optimizer.
    void ascend(osg::NodeVisitor& visitor) override;

    /// For the techniques, whose types are internal: the casters. Only what changed is read again.
    /// Call it where the graph may be read: in update, event or cull.
    /// @param view  whose levels of detail cast. Default: the finest cast.
    osg::ref_ptr<const Casters> casters(const CasterView* view = nullptr) const;
    /// Number of changes that casters() has found. 0 before its first call.
    /// A choice of levels of detail that no view had lately is a change.
    unsigned revision() const;

protected:
    ~ShadowCasterGroup() override;

private:
    ObservedSelection _casters;
    Composite _composite = RELIGHT;
    Clipping _clipping = GRAPH;
    bool _terminatorOffset = true;
    float _dark = 0.5f, _opaqueFrom = -1.0f;
    std::vector<ObservedNode> _lightSources;
    std::vector<ShadowLight> _lights;
    std::vector<LightUniform> _lightUniforms;
    std::vector<MatrixUniform> _matrixUniforms;
    CompositorOptions _options;

    const osg::ref_ptr<CasterTable> _table;
};

} // namespace gnomon
