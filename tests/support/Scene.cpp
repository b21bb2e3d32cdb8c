// SPDX-License-Identifier: MIT
#include <support/Scene.h>

#include <gnomon/EffectNode.h>
#include <gnomon/ShadowSpec.h>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/NodeVisitor>

namespace test {
namespace {

osg::StateSet* whiteUnderOneLight() {
    auto* state = new osg::StateSet;
    auto* model = new osg::LightModel;
    model->setAmbientIntensity({0.1f, 0.1f, 0.1f, 1.0f});
    auto* material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    material->setDiffuse(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    state->setAttributeAndModes(model);
    state->setAttributeAndModes(material);
    state->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    state->setMode(GL_LIGHT0, osg::StateAttribute::ON);
    return state;
}

struct Finder : osg::NodeVisitor {
    explicit Finder(const std::string& wanted) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), name(wanted) {}
    void apply(osg::Node& node) override {
        if (!found && node.getName() == name) found = &node;
        traverse(node);
    }
    std::string name;
    osg::Node* found = nullptr;
};

struct OptionsSetter : osg::NodeVisitor {
    explicit OptionsSetter(const gnomon::CompositorOptions& all)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), options(all) {}
    void apply(osg::Group& node) override {
        if (auto* group = dynamic_cast<gnomon::ShadowCasterGroup*>(&node)) group->setCompositorOptions(options);
        if (auto* effect = dynamic_cast<gnomon::EffectNode*>(&node)) effect->setCompositorOptions(options);
        traverse(node);
    }
    gnomon::CompositorOptions options;
};

} // namespace

void Scene::addGroup() {
    if (group) return;
    group = new gnomon::ShadowCasterGroup;
    root->replaceChild(content, group);
    group->addChild(content);
}

void Scene::addShadow(gnomon::ShadowTechnique* technique) {
    addGroup();
    group->addChild(technique);
}

void Scene::addShadow(const std::string& spec) {
    addGroup();
    gnomon::addShadows(*group, {gnomon::parseShadowSpec(spec)});
}

void Scene::addSecondLight() {
    osg::ref_ptr<osg::LightSource> second = new osg::LightSource;
    second->getLight()->setLightNum(1);
    second->getLight()->setPosition({-1.0f, 0.3f, 1.0f, 0.0f});
    second->getLight()->setDiffuse({0.3f, 0.2f, 0.1f, 1.0f});
    root->addChild(second);
    root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
}

void Scene::takeLightAway() {
    light->getLight()->setDiffuse({0.0f, 0.0f, 0.0f, 1.0f});
    light->getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
}

Scene scene(const osg::Vec4d& light) {
    Scene result;
    result.root = new osg::Group;
    result.root->setStateSet(whiteUnderOneLight());
    result.light = new osg::LightSource;
    result.light->getLight()->setPosition(osg::Vec4(light));
    result.light->getLight()->setAmbient({0.3f, 0.3f, 0.3f, 1.0f});
    result.light->getLight()->setDiffuse({0.7f, 0.7f, 0.7f, 1.0f});
    result.light->getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
    result.content = new osg::Group;
    result.root->addChild(result.light);
    result.root->addChild(result.content);
    return result;
}

Scene groundScene(const std::vector<Mesh>& casters, double half, const osg::Vec4d& light) {
    Scene result = scene(light);
    result.content->addChild(node(square(half), "ground"));
    for (const Mesh& caster : casters) result.content->addChild(node(caster, "caster"));
    return result;
}

osg::ref_ptr<gnomon::PlanarShadowNode> planar(osg::Node* receiver) {
    osg::ref_ptr<gnomon::PlanarShadowNode> technique = new gnomon::PlanarShadowNode(osg::Vec4d(0.0, 0.0, 1.0, 0.0));
    if (receiver) technique->setReceiver({receiver});
    return technique;
}

osg::Node* withOptions(osg::Node* root, const gnomon::CompositorOptions& options) {
    OptionsSetter setter(options);
    root->accept(setter);
    return root;
}

osg::Node* reserving(osg::Node* root, unsigned stencilBits) {
    gnomon::CompositorOptions options;
    options.reservedStencilBits = stencilBits;
    return withOptions(root, options);
}

osg::Node* unfiltered(osg::Node* root) {
    gnomon::CompositorOptions options;
    options.skipsUntouched = false;
    return withOptions(root, options);
}

osg::Node* find(osg::Node& root, const std::string& name) {
    Finder finder(name);
    root.accept(finder);
    return finder.found;
}

} // namespace test
