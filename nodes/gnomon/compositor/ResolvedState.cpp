// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ResolvedState.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/PolygonOffset>

#include <algorithm>
#include <typeinfo>
#include <vector>

namespace gnomon {
namespace {

bool resolvedMode(const osgUtil::StateGraph* graph, osg::StateAttribute::GLMode mode, bool unset, bool& overridden) {
    if (!graph) {
        overridden = false;
        return unset;
    }
    const bool on = resolvedMode(graph->_parent, mode, unset, overridden);
    if (!graph->getStateSet()) return on;
    const auto value = graph->getStateSet()->getMode(mode);
    if (value & osg::StateAttribute::INHERIT) return on;
    if (overridden && !(value & osg::StateAttribute::PROTECTED)) return on;
    overridden = value & osg::StateAttribute::OVERRIDE;
    return value & osg::StateAttribute::ON;
}

bool hasAlphaTestAlone(const osg::StateSet& set) {
    const auto isTest = [](const auto& entry) { return entry.first.first == osg::StateAttribute::ALPHAFUNC; };
    const auto isMode = [](const auto& entry) { return entry.first == GL_ALPHA_TEST; };
    const auto& attributes = set.getAttributeList();
    const auto& modes = set.getModeList();
    return std::all_of(attributes.begin(), attributes.end(), isTest) &&
           std::all_of(modes.begin(), modes.end(), isMode) && set.getTextureAttributeList().empty() &&
           set.getTextureModeList().empty() && set.getUniformList().empty();
}

/// The graph of the same sets, with others under them all.
osgUtil::StateGraph* over(const std::vector<osg::ref_ptr<osg::StateSet>>& bins, const osgUtil::StateGraph* graph) {
    std::vector<const osg::StateSet*> sets; // innermost first
    for (; graph->_parent; graph = graph->_parent)
        if (graph->getStateSet()) sets.push_back(graph->getStateSet());
    auto* result = const_cast<osgUtil::StateGraph*>(graph);
    for (const auto& set : bins) result = result->find_or_insert(set);
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) result = result->find_or_insert(*set);
    return result;
}

/// @param above  sets of the bins that it is in.
void moveStates(osgUtil::RenderBin& bin, std::vector<osg::ref_ptr<osg::StateSet>> above) {
    const bool isPlain = typeid(bin) == typeid(osgUtil::RenderBin);
    if (isPlain && bin.getStateSet() && !hasAlphaTestAlone(*bin.getStateSet())) {
        above.emplace_back(bin.getStateSet());
        bin.setStateSet(nullptr); // this bin is gone with the frame
    }
    if (!above.empty()) {
        for (osgUtil::RenderLeaf* leaf : bin.getRenderLeafList()) // osgUtil drops graphs without leaves
            over(above, leaf->_parent)->addLeaf(leaf);
        for (osgUtil::StateGraph*& graph : bin.getStateGraphList()) {
            osgUtil::StateGraph* moved = over(above, graph);
            for (const auto& leaf : graph->_leaves) moved->addLeaf(leaf);
            moved->_dynamic = moved->_dynamic || graph->_dynamic;
            graph->_leaves.clear();
            graph = moved;
        }
    }
    for (const auto& [number, below] : bin.getRenderBinList()) moveStates(*below, above);
}

} // namespace

void moveBinStatesToGraphs(osgUtil::RenderBin& bin) { moveStates(bin, {}); }

bool isOn(const osgUtil::StateGraph* graph, osg::StateAttribute::GLMode mode, bool unset) {
    bool overridden = false;
    return resolvedMode(graph, mode, unset, overridden);
}

const osg::StateAttribute* resolvedAttribute(const osgUtil::StateGraph* graph, osg::StateAttribute::Type type,
                                             bool* overrides) {
    const osg::StateAttribute* found = nullptr;
    std::vector<const osg::StateSet*> sets; // innermost first
    for (; graph; graph = graph->_parent)
        if (graph->getStateSet()) sets.push_back(graph->getStateSet());
    bool overridden = false;
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) {
        const auto* pair = (*set)->getAttributePair(type);
        if (!pair || (overridden && !(pair->second & osg::StateAttribute::PROTECTED))) continue;
        found = pair->first.get();
        overridden = pair->second & osg::StateAttribute::OVERRIDE;
    }
    if (overrides) *overrides = overridden;
    return found;
}

osg::Vec2d polygonOffsetOf(const osgUtil::StateGraph* graph) {
    const auto* offset = resolved<osg::PolygonOffset>(graph, osg::StateAttribute::POLYGONOFFSET);
    if (!offset || !isOn(graph, GL_POLYGON_OFFSET_FILL)) return {};
    return {offset->getFactor(), offset->getUnits()};
}

DepthPlacement depthPlacementOf(const osgUtil::StateGraph* graph) {
    DepthPlacement placement;
    if (const auto* depth = resolved<osg::Depth>(graph, osg::StateAttribute::DEPTH)) {
        placement.nearest = depth->getZNear();
        placement.farthest = depth->getZFar();
    }
    const osg::Vec2d offset = polygonOffsetOf(graph);
    placement.pixels = std::max(0.0, offset.x());
    placement.steps = std::max(0.0, offset.y());
    return placement;
}

ProgramPlaces placesIn(const osgUtil::StateGraph* graph) {
    for (const osgUtil::StateGraph* each = graph; each; each = each->_parent) {
        if (!each->getStateSet()) continue;
        for (const auto& [type, pair] : each->getStateSet()->getAttributeList())
            if (mayApplyProgram(*pair.first) && resolvedAttribute(graph, type.first) == pair.first.get())
                return {true, true, true, false, true};
    }
    const auto* program = resolved<osg::Program>(graph, osg::StateAttribute::PROGRAM);
    return program && program->getNumShaders() > 0 ? placesOf(*program) : ProgramPlaces();
}

bool isShaded(const osgUtil::StateGraph* graph) {
    return isOn(graph, GL_LIGHTING) || resolvedAttribute(graph, osg::StateAttribute::PROGRAM);
}

bool writesDepth(const osgUtil::StateGraph* graph) {
    const auto* depth = resolved<osg::Depth>(graph, osg::StateAttribute::DEPTH);
    return isOn(graph, GL_DEPTH_TEST, true) && (!depth || depth->getWriteMask());
}

bool writesColor(const osgUtil::StateGraph* graph) {
    const auto* mask = resolved<osg::ColorMask>(graph, osg::StateAttribute::COLORMASK);
    return !mask || mask->getRedMask() || mask->getGreenMask() || mask->getBlueMask();
}

} // namespace gnomon
