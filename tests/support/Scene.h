// SPDX-License-Identifier: MIT
#pragma once
#include <support/Mesh.h>

#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <osg/LightSource>
#include <osg/Vec4d>

#include <string>

namespace test {

/// The scene of the exact colours: white ambient and diffuse material, one light of ambient 0.3 and diffuse 0.7, scene
/// ambient 0.1. Lit from 45° a level ground shows 228, without the light's diffuse 102 (0.4 + 0.7·cos 45° = 0.895;
/// 0.4).
struct Scene {
    osg::ref_ptr<osg::Group> root;    ///< lights, light model, material
    osg::ref_ptr<osg::Group> content; ///< what the test puts in; child of `group` once shadows are on
    osg::ref_ptr<osg::LightSource> light;
    osg::ref_ptr<gnomon::ShadowCasterGroup> group; ///< null without Gnomon

    /// Wraps the content in a ShadowCasterGroup with the technique.
    void addShadow(gnomon::ShadowTechnique* technique);
    /// The same with what a specification says, see gnomon::parseShadowSpec().
    void addShadow(const std::string& spec);
    /// A second, dimmer and coloured sun, from the other side.
    void addSecondLight();
    /// As a frame without Gnomon would be if nothing received this light: its diffuse and specular black.
    void takeLightAway();

private:
    void addGroup();
};

constexpr unsigned litGround = 228, shadowedGround = 102;

/// @param light  homogeneous, as osg::Light takes it.
Scene scene(const osg::Vec4d& light = {1.0, 0.0, 1.0, 0.0});

/// A ground named "ground" (square of half side `half` at z = 0) and casters, each a node of its own.
Scene groundScene(const std::vector<Mesh>& casters, double half = 8.0, const osg::Vec4d& light = {1.0, 0.0, 1.0, 0.0});

/// Technique for the plane z = 0; receiver named if given.
osg::ref_ptr<gnomon::PlanarShadowNode> planar(osg::Node* receiver = nullptr);

/// Sets the options of all groups and effects at and below a node. @return the node.
osg::Node* withOptions(osg::Node* root, const gnomon::CompositorOptions& options);
/// The same with these stencil bits reserved, or none.
osg::Node* reserving(osg::Node* root, unsigned stencilBits);
/// The same with nothing left out.
osg::Node* unfiltered(osg::Node* root);

/// First node of that name; null if there is none.
osg::Node* find(osg::Node& root, const std::string& name);

} // namespace test
