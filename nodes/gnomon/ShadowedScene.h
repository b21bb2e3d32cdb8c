// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/SceneProps.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>

#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowTechnique>

#include <algorithm>
#include <string>

namespace gnomon {

/// Takes the place of osgShadow::ShadowedScene in a program that was written for it.
///
/// The program changes the include and the name of the type. In new programs, take ShadowCasterGroup. The scene has a
/// ShadowMapTechnique with smooth edges, which fits and biases its maps by itself; with osgShadow::SoftShadowMap they
/// are soft. The masks of osgShadow::ShadowSettings mean what they mean there. All other settings of osgShadow and its
/// techniques, such as texture sizes and polygon offsets, do nothing.
///
/// Needs   stencil and alpha bits. The constructor asks for them, for windows that are made later. A program links
///         osgShadow, as before.
/// Limits  scene files keep it as a ShadowCasterGroup. All lights that are on cast; see addLight().
struct ShadowedScene : ShadowCasterGroup {
    /// Makes an empty scene. As in osgShadow, null means that there is no shadow until setShadowTechnique().
    explicit ShadowedScene(osgShadow::ShadowTechnique* technique = nullptr) {
        askForStencilBits();
        askForAlphaBits();
        setShadowTechnique(technique);
    }

    /// Draws shadow maps in the place of this technique, which is kept and never drawn. Null: no shadow.
    void setShadowTechnique(osgShadow::ShadowTechnique* technique) {
        _given = technique;
        const bool isSoft = technique && technique->className() == std::string("SoftShadowMap");
        osg::ref_ptr<ShadowMapTechnique> maps = technique ? new ShadowMapTechnique : nullptr;
        if (maps) maps->setEdges(isSoft ? ShadowMapTechnique::SOFT : ShadowMapTechnique::SMOOTH);
        setTechnique(maps);
    }
    /// The same for a reference.
    template <class Technique>
    void setShadowTechnique(const osg::ref_ptr<Technique>& technique) {
        setShadowTechnique(technique.get());
    }
    /// The technique of osgShadow that was set.
    osgShadow::ShadowTechnique* getShadowTechnique() { return _given; }
    /// The technique of osgShadow that was set.
    const osgShadow::ShadowTechnique* getShadowTechnique() const { return _given; }

    /// Draws a technique of Gnomon from now on: a step beyond osgShadow. Null: no shadow.
    void setTechnique(ShadowTechnique* technique) {
        const osg::ref_ptr<ShadowTechnique> before = _technique;
        _technique = nullptr;
        if (before) removeChild(before);
        if (technique) addChild(technique);
        _technique = technique;
        takeMasks();
    }
    /// The technique that draws; null if there is none.
    ShadowTechnique* getTechnique() const { return _technique; }

    /// Settings whose masks say what receives and what casts. They count from the next traversal on.
    void setShadowSettings(osgShadow::ShadowSettings* settings) { _settings = settings; }
    /// The same for a reference.
    template <class Settings>
    void setShadowSettings(const osg::ref_ptr<Settings>& settings) {
        setShadowSettings(settings.get());
    }
    /// These settings.
    osgShadow::ShadowSettings* getShadowSettings() { return _settings; }
    /// These settings.
    const osgShadow::ShadowSettings* getShadowSettings() const { return _settings; }

    /// Nodes that receive: those on whose way from here each node mask shares a bit with this one. Default: all.
    void setReceivesShadowTraversalMask(unsigned mask) {
        if (_settings) _settings->setReceivesShadowTraversalMask(mask);
    }
    /// Mask of the nodes that receive.
    unsigned getReceivesShadowTraversalMask() const {
        return _settings ? _settings->getReceivesShadowTraversalMask() : ~0u;
    }
    /// Nodes that cast, in the same way. Default: all.
    void setCastsShadowTraversalMask(unsigned mask) {
        if (_settings) _settings->setCastsShadowTraversalMask(mask);
    }
    /// Mask of the nodes that cast.
    unsigned getCastsShadowTraversalMask() const { return _settings ? _settings->getCastsShadowTraversalMask() : ~0u; }

    /// Does nothing: shadows leave no state in the scene.
    void cleanSceneGraph() {}
    /// Does nothing: changes are seen by themselves.
    void dirty() {}

    /// Takes the masks first.
    void traverse(osg::NodeVisitor& visitor) override {
        takeMasks();
        ShadowCasterGroup::traverse(visitor);
    }
    /// Keeps the technique the last child, so that the program's own children have the places that it expects.
    bool insertChild(unsigned index, osg::Node* child) override {
        const unsigned count = getNumChildren();
        const bool isLast = _technique && count > 0 && getChild(count - 1) == _technique;
        return ShadowCasterGroup::insertChild(isLast ? std::min(index, count - 1) : index, child);
    }

protected:
    ~ShadowedScene() override = default;

private:
    static Selection of(unsigned mask) {
        Selection selection;
        selection.mask = mask;
        return selection;
    }
    void takeMasks() {
        const Selection casters = of(getCastsShadowTraversalMask()), receiver = of(getReceivesShadowTraversalMask());
        if (getCasters() != casters) setCasters(casters);
        if (_technique && _technique->getReceiver() != receiver) _technique->setReceiver(receiver);
    }

    osg::ref_ptr<osgShadow::ShadowSettings> _settings = new osgShadow::ShadowSettings;
    osg::ref_ptr<osgShadow::ShadowTechnique> _given;
    osg::ref_ptr<ShadowTechnique> _technique; ///< the last child.
};

} // namespace gnomon
