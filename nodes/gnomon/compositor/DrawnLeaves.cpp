// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/gl/GlState.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/PolygonMode>
#include <osg/Transform>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <climits>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace gnomon {
namespace {

/// A bin draws its bins of negative number first, then its own leaves, then its other bins
/// (osgUtil::RenderBin::drawImplementation).
void append(osgUtil::RenderBin& bin, int before, std::vector<DrawnLeaf>& leaves) {
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

bool nearlyEqual(const osg::Matrixd& a, const osg::Matrixd& b) {
    double difference = 0.0, size = 0.0;
    for (int i = 0; i < 16; ++i) {
        difference = std::max(difference, std::abs(a.ptr()[i] - b.ptr()[i]));
        size = std::max(size, std::abs(a.ptr()[i]));
    }
    return difference <= 1e-9 * size; // the same product of doubles taken in another order
}

/// Tells what lies under a selection. Looks at each node once.
class WaysUnder {
public:
    explicit WaysUnder(const Selection& selection) : _mask(selection.mask) {
        for (const auto& root : selection.roots()) _roots.insert(root.get());
    }

    Ways operator()(const osg::Node& node) {
        const auto [known, isNew] = _ways.insert({&node, {false, false}});
        if (!isNew || !(node.getNodeMask() & _mask)) return known->second;
        Ways ways;
        const bool isRoot = _roots.count(&node) > 0;
        if (isRoot)
            ways = {true, true};
        else if (node.getNumParents() == 0)
            ways = {_roots.empty(), _roots.empty()};
        for (unsigned i = 0; !isRoot && i < node.getNumParents(); ++i) {
            const Ways way = (*this)(*node.getParent(i));
            ways.some = ways.some || way.some;
            ways.all = ways.all && way.all;
        }
        return _ways[&node] = ways;
    }

    /// True if this way from above leads through the selection.
    bool holds(const osg::NodePath& path) const {
        bool under = _roots.empty();
        bool visible = true;
        for (const osg::Node* node : path) {
            under = under || _roots.count(node);
            visible = visible && (!under || (node->getNodeMask() & _mask));
        }
        return under && visible;
    }

private:
    const osg::Node::NodeMask _mask;
    std::unordered_set<const osg::Node*> _roots; ///< empty: any node.
    std::unordered_map<const osg::Node*, Ways> _ways;
};

/// Tells the leaves of a receiver. Looks at each drawable's ways once, however many leaves share them.
class ReceiverTest {
public:
    ReceiverTest(const Selection& selection, const osg::Matrixd& eyeFromWorld)
        : _under(selection), _eyeFromWorld(eyeFromWorld) {}

    bool operator()(const osgUtil::RenderLeaf& leaf) {
        const Ways ways = _under(*leaf._drawable);
        return ways.some && (ways.all || isInstance(leaf));
    }

private:
    /// Instances of one drawable under the selection, by the x of where they stand in eye space.
    using Places = std::multimap<double, osg::Matrixd>;

    /// One of several instances of a drawable: one whose way from above gives this leaf's modelview.
    bool isInstance(const osgUtil::RenderLeaf& leaf) {
        const auto [places, isNew] = _places.insert({leaf._drawable.get(), {}});
        if (isNew) places->second = placesOf(*leaf._drawable);
        const osg::Matrixd& here = modelviewOf(leaf);
        const double margin = 1e-9 * (1.0 + std::abs(here(3, 0)) + std::abs(here(3, 1)) + std::abs(here(3, 2)));
        const auto end = places->second.upper_bound(here(3, 0) + margin);
        for (auto place = places->second.lower_bound(here(3, 0) - margin); place != end; ++place)
            if (nearlyEqual(place->second, here)) return true;
        return false;
    }

    Places placesOf(const osg::Drawable& drawable) const {
        Places places;
        for (const osg::NodePath& path : drawable.getParentalNodePaths()) {
            if (!_under.holds(path)) continue;
            const osg::Matrixd place = osg::computeLocalToWorld(path) * _eyeFromWorld;
            places.insert({place(3, 0), place});
        }
        return places;
    }

    WaysUnder _under;
    const osg::Matrixd& _eyeFromWorld;
    std::unordered_map<const osg::Drawable*, Places> _places;
};

bool isPlainDepth(const osg::StateAttribute* attribute) {
    const auto* depth = static_cast<const osg::Depth*>(attribute);
    return !depth || (depth->getFunction() == osg::Depth::LESS && depth->getWriteMask() && depth->getZNear() == 0.0 &&
                      depth->getZFar() == 1.0);
}

bool isPlainMask(const osg::StateAttribute* attribute) {
    const auto* mask = static_cast<const osg::ColorMask*>(attribute);
    return !mask || (mask->getRedMask() && mask->getGreenMask() && mask->getBlueMask() && mask->getAlphaMask());
}

/// True if the set gives `mode` this value, ON or OFF.
bool gives(const osg::StateSet& set, osg::StateAttribute::GLMode mode, unsigned value) {
    using A = osg::StateAttribute;
    const auto given = set.getMode(mode);
    return !(given & A::INHERIT) && (given & A::ON) == value;
}

bool isPlainSet(const osg::StateSet& set) {
    using A = osg::StateAttribute;
    return !gives(set, GL_BLEND, A::ON) && !gives(set, GL_STENCIL_TEST, A::ON) &&
           !gives(set, GL_POLYGON_OFFSET_FILL, A::ON) && !gives(set, GL_COLOR_LOGIC_OP, A::ON) &&
           !gives(set, GL_DEPTH_TEST, A::OFF) && isPlainDepth(set.getAttribute(A::DEPTH)) &&
           isPlainMask(set.getAttribute(A::COLORMASK));
}

bool isOpaqueSet(const osg::StateSet& set) {
    using A = osg::StateAttribute;
    const auto* depth = static_cast<const osg::Depth*>(set.getAttribute(A::DEPTH));
    return !gives(set, GL_BLEND, A::ON) && !gives(set, GL_COLOR_LOGIC_OP, A::ON) &&
           !gives(set, GL_DEPTH_TEST, A::OFF) && (!depth || depth->getWriteMask());
}

bool isFilledSet(const osg::StateSet& set) {
    const auto* mode = static_cast<const osg::PolygonMode*>(set.getAttribute(osg::StateAttribute::POLYGONMODE));
    return !mode || (mode->getMode(osg::PolygonMode::FRONT) == osg::PolygonMode::FILL &&
                     mode->getMode(osg::PolygonMode::BACK) == osg::PolygonMode::FILL);
}

const osg::Node& rootOf(const osg::Node& node) { return node.getNumParents() ? rootOf(*node.getParent(0)) : node; }

} // namespace

const osg::Matrixd& matrixOf(const osg::RefMatrix* matrix) {
    static const osg::Matrixd identity;
    return matrix ? *matrix : identity;
}

bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b) {
    for (int row = 0; row < 4; ++row)
        for (const int column : {0, 1, 3})
            if (a(row, column) != b(row, column)) return false;
    return true;
}

std::vector<DrawnLeaf> leavesBelow(osgUtil::RenderStage& stage, int number) {
    std::vector<DrawnLeaf> leaves;
    append(stage, number, leaves);
    return leaves;
}

std::vector<DrawnLeaf> leavesIn(osgUtil::RenderBin& bin) {
    std::vector<DrawnLeaf> leaves;
    append(bin, INT_MAX, leaves);
    return leaves;
}

LeafSet receiversAmong(const std::vector<DrawnLeaf>& leaves, const Selection& receiver,
                       const osg::Matrixd& eyeFromWorld) {
    ReceiverTest isReceiver(receiver, eyeFromWorld);
    LeafSet result;
    for (const DrawnLeaf& entry : leaves)
        if (isReceiver(*entry.leaf)) result.insert(entry.leaf);
    return result;
}

std::set<const osg::Drawable*> drawablesUnder(const Selection& selection,
                                              const std::vector<const osg::Drawable*>& drawables) {
    WaysUnder waysUnder(selection);
    std::set<const osg::Drawable*> result;
    for (const osg::Drawable* drawable : drawables)
        if (waysUnder(*drawable).some) result.insert(drawable);
    return result;
}

std::string whyMissing(const Selection& selection, const char* role, const osg::Node& from,
                       osgUtil::RenderStage& stage) {
    const std::vector<DrawnLeaf> all = leavesBelow(stage, INT_MAX);
    if (!receiversAmong(all, selection, *stage.getInitialViewMatrix()).empty())
        return std::string("the ") + role +
               " is drawn after the shadows, in a bin above 8, as transparent objects are. Name an opaque one.";
    if (selection.node && &rootOf(*selection.node) != &rootOf(from))
        return std::string("the ") + role + " '" + selection.node->getName() +
               "' is not in this scene graph. Add it to the scene.";
    return "";
}

bool isModeOn(const std::vector<DrawnLeaf>& leaves, osg::StateAttribute::GLMode mode) {
    std::set<const osgUtil::StateGraph*> seen;
    for (const DrawnLeaf& entry : leaves) {
        if (!seen.insert(entry.leaf->_parent).second) continue;
        if (isOn(entry.leaf->_parent, mode)) return true;
    }
    return false;
}

bool readsBack(const std::vector<DrawnLeaf>& leaves) {
    return isModeOn(leaves, GL_BLEND) || isModeOn(leaves, GL_COLOR_LOGIC_OP);
}

Channels writtenChannels(const std::vector<DrawnLeaf>& leaves) {
    Channels written;
    std::set<const osgUtil::StateGraph*> seen;
    for (const DrawnLeaf& entry : leaves) {
        if (!seen.insert(entry.leaf->_parent).second) continue;
        const auto* mask = resolved<osg::ColorMask>(entry.leaf->_parent, osg::StateAttribute::COLORMASK);
        written.red = written.red || !mask || mask->getRedMask();
        written.green = written.green || !mask || mask->getGreenMask();
        written.blue = written.blue || !mask || mask->getBlueMask();
    }
    written.encoded = isModeOn(leaves, framebufferSrgb);
    return written;
}

bool LeafTest::operator()(const osgUtil::RenderLeaf& leaf) {
    const osgUtil::StateGraph* graph = leaf._parent;
    const auto known = _known.find(graph);
    if (known != _known.end()) return known->second;
    bool holds = true;
    for (const auto* above = graph; above && holds; above = above->_parent)
        holds = !above->getStateSet() || _holds(*above->getStateSet());
    return _known[graph] = holds;
}

PlainTest::PlainTest() : LeafTest(isPlainSet) {}

OpaqueTest::OpaqueTest() : LeafTest(isOpaqueSet) {}

std::string nameOf(const osg::Node& node) {
    for (const osg::Node* above = &node; above; above = above->getNumParents() ? above->getParent(0) : nullptr)
        if (!above->getName().empty()) return above->getName();
    return node.className();
}

std::string nameOf(const osgUtil::RenderLeaf& leaf) { return nameOf(*leaf._drawable); }

FilledTest::FilledTest() : LeafTest(isFilledSet) {}

bool FilledTest::operator()(const osgUtil::RenderLeaf& leaf) {
    const osg::Geometry* geometry = leaf._drawable->asGeometry();
    const auto hasArea = [](const auto& primitives) { return primitives->getMode() >= GL_TRIANGLES; };
    if (geometry &&
        !std::all_of(geometry->getPrimitiveSetList().begin(), geometry->getPrimitiveSetList().end(), hasArea))
        return false;
    return LeafTest::operator()(leaf);
}

std::optional<ScreenRect> screenBoundsOf(const osgUtil::RenderLeaf& leaf) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (!box.valid()) return wholeScreen;
    const glm::dmat4 clipFromLocal = toGlm(modelviewOf(leaf) * projectionOf(leaf));
    std::vector<glm::dvec4> corners;
    corners.reserve(8);
    for (unsigned i = 0; i < 8; ++i)
        corners.push_back(clipFromLocal * glm::dvec4(toGlm(osg::Vec3d(box.corner(i))), 1.0));
    return screenBounds(corners);
}

bool TouchTest::operator()(const osgUtil::RenderLeaf& leaf) {
    if ((_moved && _moved->count(&leaf) > 0) || !_filled(leaf)) return true;
    const auto place = screenBoundsOf(leaf);
    return place && overlap(*place, _bounds);
}

} // namespace gnomon
