// SPDX-License-Identifier: MIT
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/FlatParts.h>
#include <gnomon/NamedNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/ShadowedScene.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/spec/SpecTable.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr unsigned mostPlanes = 8;
constexpr double smallestPart = 0.01; // of the largest

using Techniques = std::vector<osg::ref_ptr<ShadowTechnique>>;
/// All nodes of the receiver's name; none where the technique can do without.
using Receivers = std::vector<NamedNode>;
using Maker = osg::ref_ptr<ShadowTechnique> (*)(const ShadowSpec& spec, const Receivers& receivers);

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

/// Of one length. Looser than flatParts(), which has the vertices' rounding to go by.
bool isNear(const osg::Vec4d& a, const osg::Vec4d& b) { return (a - b).length() <= 1e-6 * (1.0 + std::abs(a.w())); }

/// Plane of the receiver's own frame, in the group's.
osg::Vec4d inGroup(const osg::Vec4d& plane, const NamedNode& receiver) {
    return osg::Matrixd::inverse(receiver.rootFromParent) * plane;
}

/// Largest first. Receivers that lie in one plane share a part.
std::vector<FlatPart> flatPartsOf(const Receivers& receivers) {
    std::vector<FlatPart> parts;
    for (const NamedNode& receiver : receivers)
        for (const FlatPart& part : flatParts(*receiver.node, mostPlanes)) {
            const osg::Vec4d plane = inGroup(part.plane, receiver);
            const auto isSame = [&](const FlatPart& other) { return isNear(other.plane, plane); };
            const auto known = std::find_if(parts.begin(), parts.end(), isSame);
            if (known == parts.end())
                parts.push_back({plane, part.area});
            else
                known->area += part.area;
        }
    std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    return parts;
}

osg::ref_ptr<ShadowTechnique> makePlanar(const ShadowSpec& spec, const Receivers& receivers) {
    const std::vector<FlatPart> parts = flatPartsOf(receivers);
    if (parts.empty())
        refuse("the receiver \"" + receivers.front().node->getName() +
               "\" has no flat part, which planar needs. Name another one with receiver=NAME.");
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    node->setOptions(spec.planar);
    for (std::size_t i = 0; i < std::min<std::size_t>(parts.size(), mostPlanes); ++i)
        if (parts[i].area >= smallestPart * parts.front().area) node->addPlane(parts[i].plane);
    return node;
}

/// That has no more than its options.
template <typename Technique, auto options>
osg::ref_ptr<ShadowTechnique> makeBy(const ShadowSpec& spec, const Receivers&) {
    osg::ref_ptr<Technique> node = new Technique;
    node->setOptions(spec.*options);
    return node;
}

osg::ref_ptr<ShadowTechnique> makeBox(const ShadowSpec&, const Receivers&) {
    osg::ref_ptr<TerrainShadowGeode> node = new TerrainShadowGeode;
    node->setMethod(TerrainShadowGeode::BOX);
    return node;
}

/// Those that draw something, by their names in the table of techniques.
const std::map<std::string, Maker>& makers() {
    static const std::map<std::string, Maker> all = {
        {"planar", makePlanar},
        {"box", makeBox},
        {"hull", makeBy<TerrainShadowGeode, &ShadowSpec::hull>},
        {"map", makeBy<ShadowMapTechnique, &ShadowSpec::map>},
        {"volume", makeBy<ShadowVolumeTechnique, &ShadowSpec::volume>},
        {"traced", makeBy<TracedShadowTechnique, &ShadowSpec::traced>},
        {"auto", makeBy<AutoShadowTechnique, &ShadowSpec::budget>},
    };
    return all;
}

bool blends(const ShadowSpec& spec) { return spec.composite == ShadowCasterGroup::BLEND; }

/// What all share.
void setGroup(ShadowCasterGroup& group, const std::vector<ShadowSpec>& specs) {
    for (const ShadowSpec& spec : specs) {
        if (blends(spec) != blends(specs.front()))
            refuse("composite=relight and composite=blend cannot be mixed. Give every shadow the same.");
        if (spec.dark && specs.front().dark != spec.dark)
            refuse("dark= differs between the shadows. Give every shadow the same.");
        if (spec.terminatorOffset != specs.front().terminatorOffset)
            refuse("terminator= differs between the shadows. Give every shadow the same.");
    }
    if (specs.empty()) return;
    group.setComposite(blends(specs.front()) ? ShadowCasterGroup::BLEND : ShadowCasterGroup::RELIGHT);
    if (specs.front().dark) group.setDark(*specs.front().dark);
    if (specs.front().terminatorOffset) group.setTerminatorOffset(*specs.front().terminatorOffset);
}

Receivers requireReceivers(osg::Node& root, const std::string& name) {
    const Receivers found = findAllNamed(root, name);
    if (!found.empty()) return found;
    const std::string names = listed(nodeNames(root));
    refuse("no node is named \"" + name + "\" to receive the shadow. Names in the scene: " +
           (names.empty() ? "none." : names + ". Give one of them as receiver=NAME."));
}

osg::ref_ptr<ShadowTechnique> makeTechnique(ShadowCasterGroup& group, const ShadowSpec& spec) {
    const SpecTechnique& technique = requireTechnique(spec.technique);
    const auto maker = makers().find(technique.name);
    if (maker == makers().end()) return nullptr;
    Receivers receivers;
    const std::string name = spec.receiver.empty() ? technique.receiver : spec.receiver;
    if (!name.empty()) receivers = requireReceivers(group, name);
    osg::ref_ptr<ShadowTechnique> node = maker->second(spec, receivers);
    node->setReceiver(selectionOf(receivers));
    node->setName(spec.text);
    return node;
}

/// The technique that the scene has gives way to the first; what none of them names receives by the scene's mask, as it did.
void replaceShadow(ShadowedScene& scene, const Techniques& made) {
    for (const osg::ref_ptr<ShadowTechnique>& node : made)
        if (!node->getReceiver().node) node->setReceiver({nullptr, scene.getReceivesShadowTraversalMask()});
    if (made.empty()) {
        scene.removeChild(scene.getShadow());
        return;
    }
    const Selection receiver = made.front()->getReceiver();
    scene.setShadow(made.front());
    made.front()->setReceiver(receiver);
}

} // namespace

std::vector<osg::ref_ptr<ShadowTechnique>> addShadows(ShadowCasterGroup& group, const std::vector<ShadowSpec>& specs) {
    Techniques made;
    for (const ShadowSpec& spec : specs)
        if (osg::ref_ptr<ShadowTechnique> node = makeTechnique(group, spec)) made.push_back(node);
    setGroup(group, specs);
    auto* scene = dynamic_cast<ShadowedScene*>(&group);
    if (scene && !specs.empty()) replaceShadow(*scene, made);
    for (const osg::ref_ptr<ShadowTechnique>& node : made)
        if (!group.containsNode(node)) group.addChild(node);
    return made;
}

} // namespace gnomon
