// SPDX-License-Identifier: MIT
#include <gnomon/SceneProps.h>
#include <gnomon/SceneSpec.h>
#include <gnomon/base/NumberText.h>
#include <gnomon/spec/SpecTable.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr double groundRadii = 4.0; ///< side of a ground that is not told
constexpr double largestGround = 1e9;

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

/// A number of a part. All are told by parseSceneSpec()'s refusals.
struct PartKey {
    std::string name;
    double least, most;
    double SceneSpec::*number;

    std::string allowed() const { return textOf(least) + " to " + textOf(most); }
};

/// An item that is no technique.
struct ScenePart {
    std::string name;
    void (*take)(SceneSpec&);
    std::vector<PartKey> keys;
};

const std::vector<ScenePart>& parts() {
    static const std::vector<ScenePart> table = {
        {"ground",
         [](SceneSpec& spec) { spec.hasGround = true; },
         {{"side", 1e-9, largestGround, &SceneSpec::groundSide}}},
        {"sun",
         [](SceneSpec& spec) { spec.hasSun = true; },
         {{"azimuth", -360.0, 360.0, &SceneSpec::sunAzimuth}, {"elevation", -90.0, 90.0, &SceneSpec::sunElevation}}},
        {"nosun", [](SceneSpec& spec) { spec.addsSun = false; }, {}},
    };
    return table;
}

/// Split where a "+" stands before a letter, so that "1e+6" is one item; ";" becomes ",".
std::vector<std::string> itemsOf(std::string text) {
    std::replace(text.begin(), text.end(), ';', ',');
    std::vector<std::string> items(1);
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '+' && (i + 1 == text.size() || std::isalpha(static_cast<unsigned char>(text[i + 1]))))
            items.emplace_back();
        else
            items.back() += text[i];
    return items;
}

void takeNumber(SceneSpec& spec, const ScenePart& part, const std::string& pair) {
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string name = pair.substr(0, equals), value = pair.substr(std::min(equals + 1, pair.size()));
    std::vector<std::string> names;
    for (const PartKey& key : part.keys) {
        names.push_back(key.name);
        if (key.name != name) continue;
        const std::optional<double> number = numberIn(value, key.least, key.most);
        if (!number) refuse(name + "=" + value + " cannot be used. Allowed: " + key.allowed() + ".");
        spec.*key.number = *number;
        return;
    }
    refuse("the item " + part.name + " has no key \"" + name +
           "\". Allowed: " + (names.empty() ? "none" : listed(names)) + ".");
}

void takePart(SceneSpec& spec, const ScenePart& part, const std::string& item) {
    part.take(spec);
    if (item.size() == part.name.size()) return;
    std::istringstream pairs(item.substr(part.name.size() + 1));
    for (std::string pair; std::getline(pairs, pair, ',');) takeNumber(spec, part, pair);
}

void requireTechniqueOrPart(const std::string& name) {
    for (const SpecTechnique& technique : specTechniques())
        if (technique.name == name) return;
    refuse("\"" + name + "\" is neither a shadow technique nor a part of a scene. Allowed: " +
           listed(shadowTechniques()) + ", " + listed(sceneParts()) + ".");
}

void takeItem(SceneSpec& spec, const std::string& item, std::set<std::string>& seen) {
    const std::string name = item.substr(0, item.find(':'));
    for (const ScenePart& part : parts()) {
        if (part.name != name) continue;
        if (!seen.insert(name).second) refuse("the item \"" + name + "\" is given twice. Give it once.");
        return takePart(spec, part, item);
    }
    requireTechniqueOrPart(name);
    spec.shadows.push_back(parseShadowSpec(item));
}

void addGround(ShadowCasterGroup& group, osg::Node& scene, const SceneSpec& spec) {
    const osg::BoundingBoxd bounds = sceneBounds(scene);
    if (!bounds.valid()) refuse("the scene holds nothing to draw, so there is no place for a ground.");
    const double radius = bounds.radius() > 0.0 ? bounds.radius() : 1.0;
    group.addChild(makeGround(bounds, spec.groundSide > 0.0 ? spec.groundSide : groundRadii * radius));
}

/// The lowest number that no light of the scene has. Where it is 0, the sun takes the place of a viewer's headlight.
int freeNumber(const std::vector<osg::ref_ptr<osg::LightSource>>& lights) {
    int number = 0;
    const auto has = [&](const auto& source) { return source->getLight()->getLightNum() == number; };
    while (std::any_of(lights.begin(), lights.end(), has)) ++number;
    if (number > 7) refuse("the scene has 8 lights, as many as OpenGL has. Leave the sun out.");
    return number;
}

osg::ref_ptr<osg::LightSource> makeSun(const SceneSpec& spec, int number) {
    osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
    sun->getLight()->setLightNum(number);
    sun->getLight()->setPosition(osg::Vec4(sunAt(spec.sunAzimuth, spec.sunElevation)));
    return sun;
}

/// The scene's lights cast; a viewer's headlight, beside which nobody sees a shadow, does not.
void light(ShadowCasterGroup& group, const SceneSpec& spec) {
    std::vector<osg::ref_ptr<osg::LightSource>> lights = lightSourcesIn(group);
    if (spec.hasSun || (spec.addsSun && lights.empty())) {
        lights.push_back(makeSun(spec, freeNumber(lights)));
        group.addChild(lights.back());
        lights.back()->setStateSetModes(*group.getOrCreateStateSet(), osg::StateAttribute::ON);
        group.getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    }
    for (const osg::ref_ptr<osg::LightSource>& source : lights) group.addLight(source);
}

bool mayFade(const ShadowSpec& spec) {
    return spec.technique == "auto" || spec.map.fades() || spec.volume.fades() || spec.traced.fades() ||
           spec.planar.fades() || spec.hull.fades(); // those of the other techniques have their defaults
}

} // namespace

SceneSpec parseSceneSpec(const std::string& text) {
    SceneSpec spec;
    std::set<std::string> seen;
    if (!text.empty())
        for (const std::string& item : itemsOf(text)) takeItem(spec, item, seen);
    if (spec.hasSun && !spec.addsSun) refuse("sun and nosun cannot be mixed. Give one of them.");
    if (spec.shadows.empty()) spec.shadows = {parseShadowSpec("auto")};
    return spec;
}

std::vector<std::string> sceneParts() {
    std::vector<std::string> names;
    for (const ScenePart& part : parts()) names.push_back(part.name);
    return names;
}

osg::ref_ptr<ShadowCasterGroup> shadowedScene(osg::Node& scene, const SceneSpec& spec) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->addChild(&scene);
    if (spec.hasGround) addGround(*group, scene, spec);
    addShadows(*group, spec.shadows);
    light(*group, spec);
    askForStencilBits();
    if (std::any_of(spec.shadows.begin(), spec.shadows.end(), mayFade)) askForAlphaBits();
    return group;
}

} // namespace gnomon
