// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/StageLeaves.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Transform>
#include <osgUtil/StateGraph>

#include <climits>
#include <cmath>

namespace gnomon {
namespace {

/// A bin draws its bins of negative number first, then its own leaves, then its other bins
/// (osgUtil::RenderBin::drawImplementation).
void append(osgUtil::RenderBin& bin, int before, std::vector<StageLeaf>& leaves) {
    const auto& bins = bin.getRenderBinList();
    auto next = bins.begin();
    for (; next != bins.end() && next->first < 0; ++next) append(*next->second, INT_MAX, leaves);
    for (osgUtil::RenderLeaf* leaf : bin.getRenderLeafList()) leaves.push_back({leaf, &bin});
    for (osgUtil::StateGraph* graph : bin.getStateGraphList())
        for (const auto& leaf : graph->_leaves) leaves.push_back({leaf.get(), &bin});
    for (; next != bins.end() && next->first < before; ++next) append(*next->second, INT_MAX, leaves);
}

/// Whether a node can be reached under a selection: by some way from above, by all ways.
struct Ways {
    bool some = false, all = true;
};

Ways waysUnder(const osg::Node& node, const Selection& selection) {
    if (!(node.getNodeMask() & selection.mask)) return {false, false};
    if (&node == selection.node) return {true, true};
    if (node.getNumParents() == 0) return {!selection.node, !selection.node};
    Ways ways;
    for (unsigned i = 0; i < node.getNumParents(); ++i) {
        const Ways way = waysUnder(*node.getParent(i), selection);
        ways.some = ways.some || way.some;
        ways.all = ways.all && way.all;
    }
    return ways;
}

bool nearlyEqual(const osg::Matrixd& a, const osg::Matrixd& b) {
    double difference = 0.0, size = 0.0;
    for (int i = 0; i < 16; ++i) {
        difference = std::max(difference, std::abs(a.ptr()[i] - b.ptr()[i]));
        size = std::max(size, std::abs(a.ptr()[i]));
    }
    return difference <= 1e-9 * size; // the same product of doubles taken in another order
}

/// One of several instances of a drawable: the one whose way from above gives this leaf's modelview.
bool isInstanceUnder(const osgUtil::RenderLeaf& leaf, const Selection& selection, const osg::Matrixd& eyeFromWorld) {
    for (const osg::NodePath& path : leaf._drawable->getParentalNodePaths()) {
        bool under = !selection.node;
        bool visible = true;
        for (const osg::Node* node : path) {
            under = under || node == selection.node;
            visible = visible && (!under || (node->getNodeMask() & selection.mask));
        }
        if (under && visible && nearlyEqual(osg::computeLocalToWorld(path) * eyeFromWorld, *leaf._modelview))
            return true;
    }
    return false;
}

/// Value of a mode after all state sets from the root to `graph`, as osg::State resolves it.
bool resolvedMode(const osgUtil::StateGraph* graph, osg::StateAttribute::GLMode mode, bool& overridden) {
    if (!graph) return overridden = false;
    bool on = resolvedMode(graph->_parent, mode, overridden);
    if (!graph->getStateSet()) return on;
    const auto value = graph->getStateSet()->getMode(mode);
    if (value & osg::StateAttribute::INHERIT) return on;
    if (overridden && !(value & osg::StateAttribute::PROTECTED)) return on;
    overridden = value & osg::StateAttribute::OVERRIDE;
    return value & osg::StateAttribute::ON;
}

bool isModeOn(const std::vector<StageLeaf>& leaves, osg::StateAttribute::GLMode mode) {
    std::set<const osgUtil::StateGraph*> seen;
    for (const StageLeaf& entry : leaves) {
        if (!seen.insert(entry.leaf->_parent).second) continue;
        bool overridden = false;
        if (resolvedMode(entry.leaf->_parent, mode, overridden)) return true;
    }
    return false;
}

bool isPlainDepth(const osg::StateAttribute* attribute) {
    const auto* depth = static_cast<const osg::Depth*>(attribute);
    return !depth || (depth->getFunction() == osg::Depth::LESS && depth->getWriteMask() && depth->getZNear() == 0.0 &&
                      depth->getZFar() == 1.0);
}

bool isPlainMask(const osg::StateAttribute* attribute) {
    const auto* mask = static_cast<const osg::ColorMask*>(attribute);
    return !mask || (mask->getRedMask() && mask->getGreenMask() && mask->getBlueMask() && mask->getAlphaMask());
}

bool isPlainSet(const osg::StateSet& set) {
    using A = osg::StateAttribute;
    const auto mentions = [&set](A::GLMode mode, unsigned value) {
        const auto given = set.getMode(mode);
        return !(given & A::INHERIT) && (given & A::ON) == value;
    };
    return !mentions(GL_BLEND, A::ON) && !mentions(GL_STENCIL_TEST, A::ON) &&
           !mentions(GL_POLYGON_OFFSET_FILL, A::ON) && !mentions(GL_COLOR_LOGIC_OP, A::ON) &&
           !mentions(GL_DEPTH_TEST, A::OFF) && isPlainDepth(set.getAttribute(A::DEPTH)) &&
           isPlainMask(set.getAttribute(A::COLORMASK));
}

} // namespace

std::vector<StageLeaf> leavesBelow(osgUtil::RenderStage& stage, int number) {
    std::vector<StageLeaf> leaves;
    append(stage, number, leaves);
    return leaves;
}

std::set<const osgUtil::RenderLeaf*> receiversAmong(const std::vector<StageLeaf>& leaves, const Selection& receiver,
                                                    const osg::Matrixd& eyeFromWorld) {
    std::set<const osgUtil::RenderLeaf*> result;
    for (const StageLeaf& entry : leaves) {
        const Ways ways = waysUnder(*entry.leaf->_drawable, receiver);
        if (ways.some && (ways.all || isInstanceUnder(*entry.leaf, receiver, eyeFromWorld))) result.insert(entry.leaf);
    }
    return result;
}

bool isModeOnAnywhere(osgUtil::RenderStage& stage, osg::StateAttribute::GLMode mode) {
    return isModeOn(leavesBelow(stage, INT_MAX), mode);
}

bool useStencil(const std::vector<StageLeaf>& leaves) { return isModeOn(leaves, GL_STENCIL_TEST); }

bool blend(const std::vector<StageLeaf>& leaves) { return isModeOn(leaves, GL_BLEND); }

bool PlainTest::operator()(const osgUtil::RenderLeaf& leaf) {
    const osgUtil::StateGraph* graph = leaf._parent;
    const auto known = _known.find(graph);
    if (known != _known.end()) return known->second;
    bool plain = true;
    for (const auto* above = graph; above && plain; above = above->_parent)
        plain = !above->getStateSet() || isPlainSet(*above->getStateSet());
    return _known[graph] = plain;
}

std::optional<ScreenRect> screenBoundsOf(const osgUtil::RenderLeaf& leaf) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (!box.valid()) return ScreenRect{{-1.0, -1.0}, {1.0, 1.0}};
    const glm::dmat4 clipFromLocal = toGlm(*leaf._modelview * *leaf._projection);
    std::vector<glm::dvec4> corners;
    corners.reserve(8);
    for (unsigned i = 0; i < 8; ++i)
        corners.push_back(clipFromLocal * glm::dvec4(toGlm(osg::Vec3d(box.corner(i))), 1.0));
    return screenBounds(corners);
}

} // namespace gnomon
