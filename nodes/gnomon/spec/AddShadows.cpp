// SPDX-License-Identifier: MIT
#include <gnomon/FlatParts.h>
#include <gnomon/NamedNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/spec/SpecTable.h>

#include <map>
#include <optional>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr unsigned mostPlanes = 8;
constexpr double smallestPart = 0.01; // of the largest

using Techniques = std::vector<osg::ref_ptr<ShadowTechnique>>;
/// `receiver` is null where none is named and the technique can do without.
using Maker = osg::ref_ptr<ShadowTechnique> (*)(const ShadowSpec& spec, const NamedNode* receiver);

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

/// Plane of the receiver's own frame, in the group's.
osg::Vec4d inGroup(const osg::Vec4d& plane, const NamedNode& receiver) {
    return osg::Matrixd::inverse(receiver.rootFromParent) * plane;
}

osg::ref_ptr<ShadowTechnique> makePlanar(const ShadowSpec&, const NamedNode* named) {
    const NamedNode& receiver = *named;
    const std::vector<FlatPart> parts = flatParts(*receiver.node, mostPlanes);
    if (parts.empty())
        refuse("the receiver \"" + receiver.node->getName() +
               "\" has no flat part, which planar needs. Name another one with receiver=NAME.");
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    for (const FlatPart& part : parts)
        if (part.area >= smallestPart * parts.front().area) node->addPlane(inGroup(part.plane, receiver));
    return node;
}

osg::ref_ptr<ShadowTechnique> makeTraced(const ShadowSpec&, const NamedNode*) { return new TracedShadowTechnique; }

osg::ref_ptr<ShadowTechnique> makeMap(const ShadowSpec& spec, const NamedNode*) {
    osg::ref_ptr<ShadowMapTechnique> node = new ShadowMapTechnique;
    node->setOptions(spec.map);
    return node;
}

template <TerrainShadowOptions::Method method>
osg::ref_ptr<ShadowTechnique> makeTerrain(const ShadowSpec& spec, const NamedNode*) {
    osg::ref_ptr<TerrainShadowGeode> node = new TerrainShadowGeode;
    node->setOptions(spec.terrain);
    node->setMethod(method);
    return node;
}

/// Those that draw something, by their names in the table of techniques.
const std::map<std::string, Maker>& makers() {
    static const std::map<std::string, Maker> all = {
        {"planar", makePlanar},
        {"box", makeTerrain<TerrainShadowOptions::BOX>},
        {"hull", makeTerrain<TerrainShadowOptions::HULL>},
        {"drape", makeTerrain<TerrainShadowOptions::DRAPE>},
        {"map", makeMap},
        {"traced", makeTraced},
    };
    return all;
}

bool blends(const ShadowSpec& spec) { return spec.composite == ShadowCasterGroup::BLEND; }

void setComposite(ShadowCasterGroup& group, const std::vector<ShadowSpec>& specs) {
    for (const ShadowSpec& spec : specs) {
        if (blends(spec) != blends(specs.front()))
            refuse("composite=relight and composite=blend cannot be mixed. Give every shadow the same.");
        if (spec.dark && specs.front().dark != spec.dark)
            refuse("dark= differs between the shadows. Give every shadow the same.");
    }
    if (specs.empty()) return;
    group.setComposite(blends(specs.front()) ? ShadowCasterGroup::BLEND : ShadowCasterGroup::RELIGHT);
    if (specs.front().dark) group.setDark(*specs.front().dark);
}

NamedNode requireReceiver(osg::Node& root, const std::string& name) {
    if (const std::optional<NamedNode> found = findNamed(root, name)) return *found;
    const std::string names = listed(nodeNames(root));
    refuse("no node is named \"" + name +
           "\" to receive the shadow. Names in the scene: " + (names.empty() ? "none" : names) + ".");
}

osg::ref_ptr<ShadowTechnique> makeTechnique(ShadowCasterGroup& group, const ShadowSpec& spec) {
    const SpecTechnique& technique = requireTechnique(spec.technique);
    const auto maker = makers().find(technique.name);
    if (maker == makers().end()) return nullptr;
    std::optional<NamedNode> receiver;
    const std::string name = spec.receiver.empty() ? technique.receiver : spec.receiver;
    if (!name.empty()) receiver = requireReceiver(group, name);
    osg::ref_ptr<ShadowTechnique> node = maker->second(spec, receiver ? &*receiver : nullptr);
    Selection selection;
    if (receiver) selection.node = receiver->node;
    node->setReceiver(selection);
    node->setName(spec.text);
    return node;
}

} // namespace

std::vector<osg::ref_ptr<ShadowTechnique>> addShadows(ShadowCasterGroup& group, const std::vector<ShadowSpec>& specs) {
    Techniques made;
    for (const ShadowSpec& spec : specs)
        if (osg::ref_ptr<ShadowTechnique> node = makeTechnique(group, spec)) made.push_back(node);
    setComposite(group, specs);
    for (const osg::ref_ptr<ShadowTechnique>& node : made) group.addChild(node);
    return made;
}

} // namespace gnomon
