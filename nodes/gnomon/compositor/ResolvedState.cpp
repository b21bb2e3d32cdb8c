// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ResolvedState.h>

#include <osg/Depth>
#include <osg/PolygonOffset>

#include <algorithm>
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

} // namespace

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

bool isPulledForward(const osgUtil::StateGraph* graph) {
    const osg::Vec2d offset = polygonOffsetOf(graph);
    return offset.x() < 0.0 || offset.y() < 0.0;
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

bool isShaded(const osgUtil::StateGraph* graph) {
    return isOn(graph, GL_LIGHTING) || resolvedAttribute(graph, osg::StateAttribute::PROGRAM);
}

bool writesDepth(const osgUtil::StateGraph* graph) {
    const auto* depth = resolved<osg::Depth>(graph, osg::StateAttribute::DEPTH);
    return isOn(graph, GL_DEPTH_TEST, true) && (!depth || depth->getWriteMask());
}

} // namespace gnomon
