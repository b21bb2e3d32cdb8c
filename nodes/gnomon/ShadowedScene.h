// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>

#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowTechnique>

namespace gnomon {

/// Takes the place of osgShadow::ShadowedScene in a program that is written for it.
///
/// Change the include and the name of the type. Everything else compiles as it is: masks, settings and techniques of osgShadow.
/// Which of these techniques is set does not matter: AutoShadowTechnique casts the shadows.
///
///     osg::ref_ptr<gnomon::ShadowedScene> scene = new gnomon::ShadowedScene;
///     scene->setShadowTechnique(new osgShadow::ShadowMap);
///
/// Cost
/// - That of the technique that is chosen.
/// Needs
/// - The headers of osgShadow. The program links osgShadow, as it did.
/// Limits
/// - The two masks of ShadowSettings count. Sizes, biases, texture units, hints and the technique's own settings do not.
/// - Without a technique of osgShadow there is no shadow, as there.
/// - Every light that is on casts. ShadowCasterGroup::addLight() names one.
/// - A mask that changes counts from the next update traversal on.
/// - Files hold a ShadowCasterGroup in its place.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
/// Source
/// - OpenSceneGraph 3.6, osgShadow/ShadowedScene.
class GNOMON_EXPORT ShadowedScene : public ShadowCasterGroup {
public:
    /// An empty scene.
    ShadowedScene(osgShadow::ShadowTechnique* technique = nullptr)
        : ShadowedScene(technique, new osgShadow::ShadowSettings) {}
    /// Copies the properties. The copies share the settings and the technique of osgShadow.
    ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    /// A copy, as osg::Node makes it.
    osg::Object* clone(const osg::CopyOp& copyOp) const override { return new ShadowedScene(*this, copyOp); }
    /// An empty one, as osg::Node makes it.
    osg::Object* cloneType() const override;

    /// Switches the shadows on, or off with null. Default: off.
    void setShadowTechnique(osgShadow::ShadowTechnique* technique);
    /// See setShadowTechnique().
    template <class T>
    void setShadowTechnique(const osg::ref_ptr<T>& technique) {
        setShadowTechnique(technique.get());
    }
    /// See setShadowTechnique(). It never runs.
    osgShadow::ShadowTechnique* getShadowTechnique() { return _technique.get(); }
    /// See setShadowTechnique().
    const osgShadow::ShadowTechnique* getShadowTechnique() const { return _technique.get(); }

    /// The masks of casters and receivers. Null: both are ~0. Default: both are ~0.
    void setShadowSettings(osgShadow::ShadowSettings* settings);
    /// See setShadowSettings().
    template <class T>
    void setShadowSettings(const osg::ref_ptr<T>& settings) {
        setShadowSettings(settings.get());
    }
    /// See setShadowSettings().
    osgShadow::ShadowSettings* getShadowSettings() { return _settings.get(); }
    /// See setShadowSettings().
    const osgShadow::ShadowSettings* getShadowSettings() const { return _settings.get(); }

    /// The mask of what receives, in the settings. Without settings it does nothing, as in osgShadow.
    void setReceivesShadowTraversalMask(unsigned mask);
    /// See setReceivesShadowTraversalMask(). ~0 without settings.
    unsigned getReceivesShadowTraversalMask() const;
    /// The mask of what casts, in the settings. Without settings it does nothing, as in osgShadow.
    void setCastsShadowTraversalMask(unsigned mask);
    /// See setCastsShadowTraversalMask(). ~0 without settings.
    unsigned getCastsShadowTraversalMask() const;

    /// For programs that call it after a change: Gnomon finds changes by itself.
    void dirty() {}
    /// For programs that call it at the end: nothing of the kit stands in the scene.
    void cleanSceneGraph() {}

    /// The technique of Gnomon that casts. Default: an AutoShadowTechnique. Null is refused with a warning.
    void setShadow(ShadowTechnique* shadow);
    /// See setShadow(). Its diagnose() says why a shadow is missing.
    ShadowTechnique* getShadow() { return _shadow.get(); }
    /// See setShadow().
    const ShadowTechnique* getShadow() const { return _shadow.get(); }

    /// True, as for ShadowCasterGroup.
    bool showsAllChildren() const override { return true; }
    /// Follows the settings in the update traversal, and traverses as ShadowCasterGroup does.
    void traverse(osg::NodeVisitor& visitor) override;

protected:
    ~ShadowedScene() override;

private:
    ShadowedScene(osgShadow::ShadowTechnique* technique, osgShadow::ShadowSettings* settings);
    void follow();

    osg::ref_ptr<osgShadow::ShadowTechnique> _technique;
    osg::ref_ptr<osgShadow::ShadowSettings> _settings;
    osg::ref_ptr<ShadowTechnique> _shadow;
    unsigned _casts = ~0u, _receives = ~0u; ///< that the group and the shadow have.
};

} // namespace gnomon
