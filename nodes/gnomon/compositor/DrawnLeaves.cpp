// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/gl/GlState.h>

#include <osg/Camera>
#include <osg/ColorMask>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Polytope>
#include <osg/Transform>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
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

/// Orders places, of which those in a grid mostly share a coordinate.
double along(const osg::Matrixd& place) { return place(3, 0) + 0.618 * place(3, 1) + 0.327 * place(3, 2); }

using Nodes = std::unordered_set<const osg::Node*>;

/// Those without parents at and above a node.
void addTops(const osg::Node& node, Nodes& tops) {
    if (node.getNumParents() == 0) tops.insert(&node);
    for (const osg::Group* parent : node.getParents()) addTops(*parent, tops);
}

void addAbove(const osg::Node& node, Nodes& above) {
    if (!above.insert(&node).second) return;
    for (const osg::Group* parent : node.getParents()) addAbove(*parent, above);
}

/// What lies under a selection, and where the scene begins.
struct Selected {
    Selected(const Selection& selection, const osg::Node& scene) : mask(selection.mask) {
        for (const auto& root : selection.roots()) roots.insert(root.get());
        addTops(scene, tops);
    }
    const osg::Node::NodeMask mask;
    Nodes roots; ///< empty: any node.
    Nodes tops;
};

/// Whether a node can be reached under a selection: by some way from above, by all ways.
struct Ways {
    bool some = false, all = true;
    bool foreign = false; ///< One begins at a node that is not of the scene: any node may hand it on.

    bool isOpen() const { return some && !all; }
};

/// Tells what lies under a selection, from below. Looks at each node once.
class WaysUnder {
public:
    explicit WaysUnder(const Selected& selected) : _selected(selected) {}

    Ways operator()(const osg::Node& node) {
        const auto [known, isNew] = _ways.insert({&node, {false, false}});
        if (!isNew || !(node.getNodeMask() & _selected.mask)) return known->second;
        Ways ways;
        const bool isRoot = _selected.roots.count(&node) > 0;
        if (isRoot)
            ways = {true, true};
        else if (node.getNumParents() == 0 && _selected.tops.count(&node) == 0)
            ways = {true, false, true};
        else if (node.getNumParents() == 0)
            ways = {_selected.roots.empty(), _selected.roots.empty()};
        for (unsigned i = 0; !isRoot && i < node.getNumParents(); ++i) {
            const Ways way = (*this)(*node.getParent(i));
            ways.some = ways.some || way.some;
            ways.all = ways.all && way.all;
            ways.foreign = ways.foreign || way.foreign;
        }
        return _ways[&node] = ways;
    }

private:
    const Selected& _selected;
    std::unordered_map<const osg::Node*, Ways> _ways;
};

/// Finds the drawables under a selection from above, as a cull does: also those that a node hands on which are not its children.
/// Switches and levels of detail do not matter here.
///
/// Cost    a visit of what is under the selected nodes; of the whole scene if none is named, or one is handed on itself.
class FoundBelow : public osg::NodeVisitor {
public:
    /// @param only   visits these nodes alone; null: all. Must outlive this.
    /// @param first  one drawable is enough.
    FoundBelow(const Selected& selected, const osg::Matrixd& eyeFromWorld, const Nodes* only = nullptr,
               bool first = false)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN),
          _selected(selected),
          _only(only),
          _first(first),
          _eyeFromWorld(eyeFromWorld) {
        setNodeMaskOverride(~0u);
        Nodes above;
        for (const osg::Node* root : selected.roots) addTops(*root, above);
        const auto isTop = [&selected](const osg::Node* node) { return selected.tops.count(node) > 0; };
        const bool fromRoots = !above.empty() && std::all_of(above.begin(), above.end(), isTop);
        for (const osg::Node* start : fromRoots ? selected.roots : selected.tops)
            for (osg::NodePath path : start->getParentalNodePaths()) {
                path.pop_back();
                _eyeFromHere = osg::computeLocalToWorld(path) * eyeFromWorld;
                const_cast<osg::Node*>(start)->accept(*this); // which changes nothing
            }
    }

    void apply(osg::Node& node) override {
        if (!isWanted(node)) return;
        const bool wasUnder = _isUnder;
        _isUnder = wasUnder || _selected.roots.empty() || _selected.roots.count(&node) > 0;
        const bool passes = !_isUnder || (node.getNodeMask() & _selected.mask);
        if (const osg::Drawable* drawable = passes && _isUnder ? node.asDrawable() : nullptr)
            found.add(*drawable, _eyeFromHere);
        if (passes && !(_first && !found.empty())) traverse(node);
        _isUnder = wasUnder;
    }
    void apply(osg::Drawable& drawable) override { apply(static_cast<osg::Node&>(drawable)); }
    void apply(osg::Transform& transform) override {
        if (!isWanted(transform)) return;
        const osg::Matrixd above = _eyeFromHere;
        const osg::Camera* camera = transform.asCamera();
        if (camera && (camera->getReferenceFrame() == osg::Transform::ABSOLUTE_RF || camera->getNumParents() == 0))
            _eyeFromHere = _eyeFromWorld;
        else
            transform.computeLocalToWorldMatrix(_eyeFromHere, nullptr);
        apply(static_cast<osg::Node&>(transform));
        _eyeFromHere = above;
    }

    DrawablePlaces found;

private:
    bool isWanted(const osg::Node& node) const { return !_only || _only->count(&node) > 0; }

    const Selected& _selected;
    const Nodes* const _only;
    const bool _first;
    const osg::Matrixd _eyeFromWorld;
    osg::Matrixd _eyeFromHere;
    bool _isUnder = false;
};

const osg::Node& rootOf(const osg::Node& node) { return node.getNumParents() ? rootOf(*node.getParent(0)) : node; }

/// True if a node's bound may be seen, or is not known.
bool mayBeSeen(const osg::Node& node, const osg::Camera* camera) {
    if (!node.getBound().valid() || !camera) return true;
    for (osg::NodePath path : node.getParentalNodePaths()) {
        path.pop_back(); // its bound is in its parent's frame
        osg::Polytope seen;
        seen.setToUnitFrustum(false, false);
        seen.transformProvidingInverse(osg::computeLocalToWorld(path) * camera->getViewMatrix() *
                                       camera->getProjectionMatrix());
        if (seen.contains(node.getBound())) return true;
    }
    return false;
}

} // namespace

const osg::Matrixd& matrixOf(const osg::RefMatrix* matrix) {
    static const osg::Matrixd identity;
    return matrix ? *matrix : identity;
}

bool isSameLens(const osg::Matrixd& a, const osg::Matrixd& b) {
    if (&a == &b) return true;
    for (int row = 0; row < 4; ++row)
        for (const int column : {0, 1, 3})
            if (a(row, column) != b(row, column)) return false;
    return true;
}

bool isSamePlace(const osg::Matrixd& a, const osg::Matrixd& b, double rounding) {
    double difference = 0.0, size = 0.0;
    for (int i = 0; i < 16; ++i) {
        difference = std::max(difference, std::abs(a.ptr()[i] - b.ptr()[i]));
        size = std::max(size, std::abs(a.ptr()[i]));
    }
    return difference <= 1e-9 * size + rounding;
}

void DrawablePlaces::add(const osg::Drawable& drawable, const osg::Matrixd& place) {
    const bool shared = !_matrices.empty() && hasSameBits(_matrices.back(), place);
    if (!shared) _matrices.push_back(place);
    _drawables.clear();
    _places.push_back({&drawable, shared ? _places.back().along : along(place), _matrices.size() - 1});
}

/// Many drawables that stand in one frame are asked for in a row.
bool DrawablePlaces::isAt(const Place& known, const osg::Matrixd& place, double rounding) const {
    if (known.matrix == _asIn && hasSameBits(place, _asked)) return true;
    if (!isSamePlace(_matrices[known.matrix], place, rounding)) return false;
    _asIn = known.matrix;
    _asked = place;
    return true;
}

/// Whether any place is of the drawable. What is missed is mostly out of sight, and this is cheaper than the sort.
bool DrawablePlaces::isIn(const osg::Drawable& drawable) const {
    if (_drawables.empty()) {
        std::size_t size = 4;
        while (size < 2 * _places.size()) size *= 2;
        _drawables.resize(size, nullptr);
        for (const Place& place : _places) *slotOf(*place.drawable) = place.drawable;
    }
    return *slotOf(drawable) != nullptr;
}

/// That of a drawable in the table, or the free one that it would take.
const osg::Drawable** DrawablePlaces::slotOf(const osg::Drawable& drawable) const {
    const std::size_t last = _drawables.size() - 1; // all bits are set
    const auto address = std::uint64_t{reinterpret_cast<std::uintptr_t>(&drawable)};
    std::size_t at = (address * 0x9e3779b97f4a7c15u) >> 32 & last;
    while (_drawables[at] && _drawables[at] != &drawable) at = (at + 1) & last;
    return &_drawables[at];
}

std::pair<DrawablePlaces::Order::const_iterator, DrawablePlaces::Order::const_iterator>
DrawablePlaces::between(const osg::Drawable& drawable, double low, double high) const {
    const auto isBefore = [this](unsigned i, const std::pair<const osg::Drawable*, double>& key) {
        return std::less<>()(std::make_pair(_places[i].drawable, _places[i].along), key);
    };
    if (_order.size() != _places.size()) {
        _order.resize(_places.size());
        std::iota(_order.begin(), _order.end(), 0u);
        std::sort(_order.begin(), _order.end(), [&](unsigned a, unsigned b) {
            return isBefore(a, {_places[b].drawable, _places[b].along});
        });
    }
    const auto first = std::lower_bound(_order.begin(), _order.end(), std::make_pair(&drawable, low), isBefore);
    auto end = first;
    while (end != _order.end() && _places[*end].drawable == &drawable && _places[*end].along <= high) ++end;
    return {first, end};
}

bool DrawablePlaces::has(const osg::Drawable& drawable) const {
    constexpr double never = std::numeric_limits<double>::infinity();
    const auto [first, end] = between(drawable, -never, never);
    return first != end;
}

bool DrawablePlaces::hasAt(const osg::Drawable& drawable, const osg::Matrixd& place, double rounding) const {
    const auto isThere = [&](unsigned i) { return isAt(_places[i], place, rounding); };
    if (_next < _places.size() && _places[_next].drawable == &drawable && isThere(_next)) {
        ++_next;
        return true;
    }
    if (!isIn(drawable)) return false;
    const osg::Vec3d at = place.getTrans();
    const double margin = 1e-9 * (1.0 + std::abs(at.x()) + std::abs(at.y()) + std::abs(at.z())) + 2.0 * rounding;
    const auto [first, end] = between(drawable, along(place) - margin, along(place) + margin);
    const auto found = std::find_if(first, end, isThere);
    if (found == end) return false;
    _next = *found + 1;
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
                       const osg::Matrixd& eyeFromWorld, const osg::Node& scene) {
    const Selected selected(receiver, scene);
    WaysUnder waysUnder(selected);
    LeafSet result;
    std::vector<const osgUtil::RenderLeaf*> open;
    Nodes above; // what leads to these
    bool foreign = false;
    for (const DrawnLeaf& entry : leaves) {
        const Ways ways = waysUnder(*entry.leaf->_drawable);
        if (!ways.isOpen()) {
            if (ways.some) result.insert(entry.leaf);
            continue;
        }
        open.push_back(entry.leaf);
        addAbove(*entry.leaf->_drawable, above);
        foreign = foreign || ways.foreign;
    }
    if (open.empty()) return result;
    const osg::ref_ptr<FoundBelow> below = new FoundBelow(selected, eyeFromWorld, foreign ? nullptr : &above);
    for (const osgUtil::RenderLeaf* leaf : open)
        if (below->found.hasAt(*leaf->_drawable, modelviewOf(*leaf))) result.insert(leaf);
    return result;
}

std::set<const osg::Drawable*>
drawablesUnder(const Selection& selection, const std::vector<const osg::Drawable*>& drawables, const osg::Node& scene) {
    const Selected selected(selection, scene);
    WaysUnder waysUnder(selected);
    osg::ref_ptr<FoundBelow> below; // null until it is asked for
    std::set<const osg::Drawable*> result;
    for (const osg::Drawable* drawable : drawables) {
        const Ways ways = waysUnder(*drawable);
        const bool isAsked = ways.isOpen() && ways.foreign;
        if (isAsked && !below) below = new FoundBelow(selected, {});
        if (isAsked ? below->found.has(*drawable) : ways.some) result.insert(drawable);
    }
    return result;
}

std::string whyMissing(const Selection& selection, const char* role, const osg::Node& from,
                       osgUtil::RenderStage& stage) {
    const std::vector<DrawnLeaf> all = leavesBelow(stage, INT_MAX);
    if (!receiversAmong(all, selection, *stage.getInitialViewMatrix(), from).empty())
        return std::string("the ") + role +
               " is drawn after the shadows, in a bin above 8, as transparent objects are. Name an opaque one.";
    if (selection.node && &rootOf(*selection.node) != &rootOf(from))
        return std::string("the ") + role + " '" + selection.node->getName() +
               "' is not in this scene graph. Add it to the scene.";
    if (selection.node && !mayBeSeen(*selection.node, stage.getCamera())) return "";
    const Selected selected(selection, from);
    const osg::ref_ptr<FoundBelow> below = new FoundBelow(selected, {}, nullptr, true);
    if (!below->found.empty()) return "";
    const std::string name = selection.node ? " '" + nameOf(*selection.node) + "'" : "";
    return "nothing that is drawn is found under the " + (role + name) +
           ". Name a node that hands on what it draws to every osg::NodeVisitor, and check the mask.";
}

namespace {

/// True if a test holds for the state of any leaf. Leaves of one state mostly follow each other.
template <class Test>
bool anyState(const std::vector<DrawnLeaf>& leaves, const Test& test) {
    const KnownStates scope;
    const osgUtil::StateGraph* last = nullptr;
    return std::any_of(leaves.begin(), leaves.end(), [&](const DrawnLeaf& entry) {
        return entry.leaf->_parent != last && test(last = entry.leaf->_parent);
    });
}

} // namespace

bool isModeOn(const std::vector<DrawnLeaf>& leaves, osg::StateAttribute::GLMode mode) {
    return anyState(leaves, [mode](const osgUtil::StateGraph* graph) { return isOn(graph, mode); });
}

bool readsBack(const std::vector<DrawnLeaf>& leaves) {
    return isModeOn(leaves, GL_BLEND) || isModeOn(leaves, GL_COLOR_LOGIC_OP);
}

bool openBy(const osg::ColorMask* mask, Channels& channels) {
    channels.red = channels.red || !mask || mask->getRedMask();
    channels.green = channels.green || !mask || mask->getGreenMask();
    channels.blue = channels.blue || !mask || mask->getBlueMask();
    return channels.red || channels.green || channels.blue;
}

Channels writtenChannels(const std::vector<DrawnLeaf>& leaves) {
    Channels written;
    anyState(leaves, [&written](const osgUtil::StateGraph* graph) {
        openBy(resolved<osg::ColorMask>(graph, osg::StateAttribute::COLORMASK), written);
        return written.red && written.green && written.blue;
    });
    written.encoded = isModeOn(leaves, framebufferSrgb);
    return written;
}

std::string nameOf(const osg::Node& node) {
    for (const osg::Node* above = &node; above; above = above->getNumParents() ? above->getParent(0) : nullptr)
        if (!above->getName().empty()) return above->getName();
    return node.className();
}

std::string nameOf(const osgUtil::RenderLeaf& leaf) { return nameOf(*leaf._drawable); }

bool isFilled(const osgUtil::RenderLeaf& leaf) {
    const osg::Geometry* geometry = leaf._drawable->asGeometry();
    const auto hasArea = [](const auto& primitives) { return primitives->getMode() >= GL_TRIANGLES; };
    if (geometry &&
        !std::all_of(geometry->getPrimitiveSetList().begin(), geometry->getPrimitiveSetList().end(), hasArea))
        return false;
    return isFilled(leaf._parent);
}

std::optional<ScreenRect> screenBoundsOf(const osgUtil::RenderLeaf& leaf) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (!box.valid()) return wholeScreen;
    const glm::dmat4 clipFromLocal = toGlm(modelviewOf(leaf) * projectionOf(leaf));
    return screenBounds(boxCorners(toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)), clipFromLocal));
}

bool TouchTest::operator()(const osgUtil::RenderLeaf& leaf) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    if (_isAll || !box.valid() || (_moved && _moved->count(&leaf) > 0) || !isFilled(leaf)) return true;
    if (!_modelview || leaf._modelview != _modelview || leaf._projection != _projection)
        _sides = screenSides(_bounds, modelviewOf(leaf) * projectionOf(leaf));
    _modelview = leaf._modelview.get();
    _projection = leaf._projection.get();
    return mayTouch(box, _sides);
}

} // namespace gnomon
