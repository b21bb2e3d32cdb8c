// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>
#include <gnomon/CasterPieces.h>
#include <gnomon/Export.h>
#include <gnomon/LightUniform.h>
#include <gnomon/Selection.h>
#include <gnomon/ShadowLight.h>

#include <OpenThreads/Mutex>
#include <osg/Group>
#include <osg/LightSource>

#include <cstdint>
#include <vector>

namespace gnomon {

class CasterRevision;

/// Group whose subgraph casts shadows. It wraps the scene or any part of it; the scene's own nodes stay as they are.
/// Techniques (PlanarShadowNode, …) are its children, beside the scene:
///
///     osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
///     group->addChild(scene);
///     group->addChild(new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0)));
///
/// In a file (.osgt, .osgb, .osgx); what is left out has its default, here all casts, RELIGHT, 0.5, every light:
///
///     gnomon::ShadowCasterGroup {
///       UniqueID 1
///       Children 2 { ... }
///       Casters { Mask 0xff Node FALSE }
///       Composite BLEND
///       Dark 0.3
///       LightSources 1 { osg::LightSource { UniqueID 9 } }
///       Lights 1 { 0 433000.25 5410000.5 60 1 }
///       Spots 1 { 0 0 -1 30 }
///       LightUniforms 1 { 0 "sunColor" }
///     }
///
/// Cost    a visit of the casters' nodes a frame and view to see that nothing changed; an extraction where something
/// did. Needs   stencil bits for its techniques. Limits  see VertexTraverser for what is left out. Threads any number
/// of cull and draw threads; set properties between frames.
class GNOMON_EXPORT ShadowCasterGroup : public osg::Group {
public:
    /// How the light is taken away from the pixels it does not reach.
    enum Composite : int {
        RELIGHT, ///< exact: they are drawn once more without that light's diffuse and specular.
        BLEND    ///< cheap: their colour is multiplied by a factor, once.
    };

    ShadowCasterGroup();
    ShadowCasterGroup(const ShadowCasterGroup& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, ShadowCasterGroup)

    /// What casts, of this group's subgraph. Default: all of it.
    void setCasters(const Selection& casters);
    const Selection& getCasters() const { return _selection; }

    /// Default RELIGHT, which any value that is none of the two stands for too.
    void setComposite(Composite composite) { _composite = composite == BLEND ? BLEND : RELIGHT; }
    Composite getComposite() const { return _composite; }

    /// Factor of BLEND, 0 (black) … 1 (nothing); default 0.5. Clamped; NaN is refused with a warning.
    void setDark(float factor);
    float getDark() const { return _dark; }

    /// Lights that cast, instead of all those that are on in the view. A LightSource may stand anywhere in the graph,
    /// moved by transforms.
    void addLight(osg::LightSource* light);
    /// A light given by its place in the group's frame, in double: for lamps far from the origin. Refused with a warning
    /// if its number is none of OpenGL's, 0 to 7.
    void addLight(const ShadowLight& light);
    void removeLights();
    /// All of one kind in place of those that were.
    void setLightSources(std::vector<osg::ref_ptr<osg::LightSource>> sources);
    const std::vector<osg::ref_ptr<osg::LightSource>>& getLightSources() const { return _lightSources; }
    void setLights(std::vector<ShadowLight> lights);
    const std::vector<ShadowLight>& getLights() const { return _lights; }

    /// Uniforms by which programs of receivers read the colours of lights: relight sets them to 0 where the light does not
    /// reach, as it does the OpenGL light's own colours. Default none. Not for elements of arrays. A uniform whose light
    /// number is none of OpenGL's, 0 to 7, is refused with a warning.
    void addLightUniform(const LightUniform& uniform);
    void setLightUniforms(std::vector<LightUniform> uniforms);
    const std::vector<LightUniform>& getLightUniforms() const { return _lightUniforms; }

    /// The casters as they are now; extracted again only if something changed since the last call. Call it where
    /// reading the graph is allowed: in update, event or cull.
    osg::ref_ptr<const CasterMesh> casters() const;
    /// The same drawable by drawable: what did not change since the last call is the same piece, and not read again.
    osg::ref_ptr<const CasterPieces> pieces() const;
    /// Rises by one with each change that casters() or pieces() finds; 0 before the first call of either.
    unsigned revision() const;

protected:
    ~ShadowCasterGroup() override;

private:
    void noteRevision(std::uint64_t fingerprint) const;
    /// In a deep copy, what casts, shines and receives are the copy's own nodes.
    void followCopies(const ShadowCasterGroup& original);

    Selection _selection;
    Composite _composite = RELIGHT;
    float _dark = 0.5f;
    std::vector<osg::ref_ptr<osg::LightSource>> _lightSources;
    std::vector<ShadowLight> _lights;
    std::vector<LightUniform> _lightUniforms;

    mutable OpenThreads::Mutex _mutex;
    osg::ref_ptr<CasterRevision> _watch;
    mutable osg::ref_ptr<const CasterMesh> _mesh;
    mutable osg::ref_ptr<const CasterPieces> _pieces;
    mutable std::uint64_t _fingerprint = 0, _meshFingerprint = 0;
    mutable unsigned _revision = 0;
};

} // namespace gnomon
