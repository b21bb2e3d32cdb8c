// SPDX-License-Identifier: MIT
#include "GnomonStaging.h"
#include "SceneSetup.h"

#include <osg/LightModel>

namespace gnomon::examples {

GnomonStaging::GnomonStaging(ShadowSpec spec, const ChartScene& scene, Look look)
    : Staging(scene, look), _group(new ShadowCasterGroup) {
    if (look == Look::VISIBILITY && spec.composite == ShadowCasterGroup::BLEND) {
        spec.dark = 0.0f;
        osg::ref_ptr<osg::LightModel> model = new osg::LightModel; // or what is turned away is black, shadowed or not
        model->setAmbientIntensity({0.25f, 0.25f, 0.25f, 1.0f});
        _root->getOrCreateStateSet()->setAttributeAndModes(model);
    }
    _group->addChild(_content);
    _root->addChild(_group);
    _techniques = addShadows(*_group, {spec});
    GnomonStaging::diagnose(); // who asks is not warned by osg::notify() besides
    GnomonStaging::setLight(scene.light);
}

void GnomonStaging::setLight(const osg::Vec4d& light) {
    Staging::setLight(light);
    _group->setLights({{0, light}});
}

void GnomonStaging::setCasting(bool casts) {
    Selection all;
    if (!casts) all.mask = 0;
    _group->setCasters(all);
}

std::vector<std::string> GnomonStaging::diagnose() const { return diagnoses(_techniques); }

std::vector<ShadowDecision> GnomonStaging::decisions() const { return _techniques.front()->lastDecision(); }

} // namespace gnomon::examples
