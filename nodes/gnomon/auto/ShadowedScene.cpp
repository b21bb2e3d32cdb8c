// SPDX-License-Identifier: MIT
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowedScene.h>

#include <osg/Notify>

namespace gnomon {

ShadowedScene::ShadowedScene(osgShadow::ShadowTechnique* technique, osgShadow::ShadowSettings* settings)
    : _settings(settings), _shadow(new AutoShadowTechnique) {
    addChild(_shadow);
    setNumChildrenRequiringUpdateTraversal(1); // else update would pass by
    setShadowTechnique(technique);
}

/// The group has copied its children: the shadow is the one that stands where the other's does.
ShadowedScene::ShadowedScene(const ShadowedScene& other, const osg::CopyOp& copyOp)
    : ShadowCasterGroup(other, copyOp),
      _technique(other._technique),
      _settings(other._settings),
      _casts(other._casts),
      _receives(other._receives) {
    const unsigned at = other.getChildIndex(other._shadow);
    if (at < getNumChildren()) _shadow = dynamic_cast<ShadowTechnique*>(getChild(at));
    setNumChildrenRequiringUpdateTraversal(getNumChildrenRequiringUpdateTraversal() + 1);
}

ShadowedScene::~ShadowedScene() = default;

/// Settings are made by those that there are: this library is not linked to osgShadow, only its programs are.
osg::Object* ShadowedScene::cloneType() const {
    return new ShadowedScene(nullptr,
                             _settings ? static_cast<osgShadow::ShadowSettings*>(_settings->cloneType()) : nullptr);
}

void ShadowedScene::setShadowTechnique(osgShadow::ShadowTechnique* technique) {
    _technique = technique;
    if (_shadow) _shadow->setNodeMask(technique ? ~0u : 0u);
}

void ShadowedScene::setShadowSettings(osgShadow::ShadowSettings* settings) {
    _settings = settings;
    follow();
}

void ShadowedScene::setReceivesShadowTraversalMask(unsigned mask) {
    if (_settings) _settings->setReceivesShadowTraversalMask(mask);
    follow();
}

unsigned ShadowedScene::getReceivesShadowTraversalMask() const {
    return _settings ? _settings->getReceivesShadowTraversalMask() : ~0u;
}

void ShadowedScene::setCastsShadowTraversalMask(unsigned mask) {
    if (_settings) _settings->setCastsShadowTraversalMask(mask);
    follow();
}

unsigned ShadowedScene::getCastsShadowTraversalMask() const {
    return _settings ? _settings->getCastsShadowTraversalMask() : ~0u;
}

void ShadowedScene::setShadow(ShadowTechnique* shadow) {
    if (!shadow) {
        OSG_WARN
            << "gnomon: ShadowedScene::setShadow() takes no null. Set no technique of osgShadow to switch shadows off."
            << std::endl;
        return;
    }
    const osg::ref_ptr<ShadowTechnique> kept = shadow;
    removeChild(_shadow);
    _shadow = shadow;
    addChild(_shadow);
    _shadow->setReceiver({nullptr, _receives});
    setShadowTechnique(_technique);
}

/// A mask counts when it changes, so that a program may select by setCasters() and setReceiver(), too.
void ShadowedScene::follow() {
    if (getCastsShadowTraversalMask() != _casts) {
        _casts = getCastsShadowTraversalMask();
        setCasters({nullptr, _casts});
    }
    if (_shadow && getReceivesShadowTraversalMask() != _receives) {
        _receives = getReceivesShadowTraversalMask();
        _shadow->setReceiver({nullptr, _receives});
    }
}

void ShadowedScene::traverse(osg::NodeVisitor& visitor) {
    if (visitor.getVisitorType() == osg::NodeVisitor::UPDATE_VISITOR) follow();
    ShadowCasterGroup::traverse(visitor);
}

} // namespace gnomon
