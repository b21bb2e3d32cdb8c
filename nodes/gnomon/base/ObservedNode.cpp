// SPDX-License-Identifier: MIT
#include <gnomon/ObservedNode.h>

#include <OpenThreads/ScopedLock>
#include <osg/Group>

#include <set>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;
using Nodes = std::set<const osg::Node*>;

void addWithAbove(const osg::Node& node, Nodes& nodes) {
    if (!nodes.insert(&node).second) return;
    for (const osg::Group* parent : node.getParents()) addWithAbove(*parent, nodes);
}

Nodes parentsOf(const Nodes& nodes) {
    Nodes parents;
    for (const osg::Node* node : nodes) parents.insert(node->getParents().begin(), node->getParents().end());
    return parents;
}

const osg::Node* oneOfBoth(const Nodes& some, const Nodes& others) {
    for (const osg::Node* node : some)
        if (others.count(node)) return node;
    return nullptr;
}

/// Not its class: a transform may have become a group, as osgUtil::Optimizer makes it.
std::string kindOf(const osg::Node& node) {
    return (node.asDrawable() ? "drawable "
            : node.asGeode()  ? "geode "
            : node.asGroup()  ? "group "
                              : "node ") +
           node.getName();
}

/// The first child that is one of these; the number of children if none is.
unsigned childAmong(const osg::Group& group, const Nodes& nodes) {
    unsigned i = 0;
    while (i < group.getNumChildren() && !nodes.count(group.getChild(i))) ++i;
    return i;
}

} // namespace

ObservedNode::ObservedNode(osg::Node* node) : _node(node), _names(node != nullptr) {}

ObservedNode::ObservedNode(const ObservedNode& other, const osg::Node& owner) : _names(other._names) {
    const osg::ref_ptr<osg::Node> named = other.in(owner);
    _node = named;
    Lock lock(other._mutex);
    if (!other._way.kind.empty())
        _way = other._way; // a copy of a copy that has not found its own yet
    else if (named)
        _way = wayFrom(owner, *named);
}

ObservedNode::ObservedNode(const ObservedNode& other) : _names(other._names) {
    Lock lock(other._mutex);
    _node = other._node;
    _way = other._way;
}

ObservedNode& ObservedNode::operator=(const ObservedNode& other) {
    if (this == &other) return *this;
    const ObservedNode copy(other);
    Lock lock(_mutex);
    _node = copy._node;
    _way = copy._way;
    _names = copy._names;
    return *this;
}

ObservedNode::~ObservedNode() = default;

ObservedNode::Way ObservedNode::wayFrom(const osg::Node& owner, osg::Node& named) {
    Nodes aboveNamed, level{&owner};
    addWithAbove(named, aboveNamed);
    Way way;
    const osg::Node* top = nullptr;
    for (; !level.empty() && !(top = oneOfBoth(level, aboveNamed)); ++way.up) level = parentsOf(level);
    if (!top) return {};
    way.top = const_cast<osg::Node*>(top);
    way.kind = kindOf(named);
    while (top != &named) { // each of those above the node leads down to it
        const osg::Group& group = *top->asGroup();
        way.down.push_back(childAmong(group, aboveNamed));
        top = group.getChild(way.down.back());
    }
    return way;
}

osg::Node* ObservedNode::endOf(const Way& way, const osg::Node& top) {
    osg::Node* node = const_cast<osg::Node*>(&top);
    for (const unsigned child : way.down) {
        osg::Group* group = node->asGroup();
        if (!group || child >= group->getNumChildren()) return nullptr;
        node = group->getChild(child);
    }
    return kindOf(*node) == way.kind ? node : nullptr;
}

/// Until the copy of the owner has the parents that the way leads up by.
void ObservedNode::followCopy(const osg::Node& owner) const {
    Nodes level{&owner};
    for (unsigned i = 0; i < _way.up; ++i) level = parentsOf(level);
    osg::Node* found = nullptr;
    for (const osg::Node* top : level) {
        if (_way.top.get() == top) return void(_way = {}); // it stands beside the original
        if (!found) found = endOf(_way, *top);
    }
    if (!found) return;
    _node = found;
    _way = {};
}

osg::ref_ptr<osg::Node> ObservedNode::in(const osg::Node& owner) const {
    Lock lock(_mutex);
    if (!_way.kind.empty()) followCopy(owner);
    return node();
}

osg::ref_ptr<osg::Node> ObservedNode::node() const {
    osg::ref_ptr<osg::Node> node;
    _node.lock(node);
    return node;
}

ObservedSelection::ObservedSelection(const Selection& selection) : _mask(selection.mask) {
    for (const osg::ref_ptr<osg::Node>& node : selection.roots()) _nodes.emplace_back(node.get());
}

ObservedSelection::ObservedSelection(const ObservedSelection& other, const osg::Node& owner) : _mask(other._mask) {
    for (const ObservedNode& node : other._nodes) _nodes.emplace_back(node, owner);
}

Selection ObservedSelection::in(const osg::Node& owner) const {
    Selection selection{nullptr, _mask};
    for (const ObservedNode& named : _nodes) {
        const osg::ref_ptr<osg::Node> node = named.in(owner);
        if (node && selection.node)
            selection.others.push_back(node);
        else if (node)
            selection.node = node;
    }
    if (!_nodes.empty() && !selection.node) selection.mask = 0u;
    return selection;
}

bool ObservedSelection::isGone(const osg::Node& owner) const { return !_nodes.empty() && !in(owner).node; }

} // namespace gnomon
