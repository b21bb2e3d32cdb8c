// SPDX-License-Identifier: MIT
#include <gnomon/NamedNode.h>

#include <osg/NodeVisitor>
#include <osg/Transform>

#include <algorithm>
#include <set>

namespace gnomon {
namespace {

class Finder : public osg::NodeVisitor {
public:
    explicit Finder(const std::string& name) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _name(name) {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override {
        if (node.getName() == _name)
            found.push_back({&node, placeOfParent()});
        else
            traverse(node);
    }

    std::vector<NamedNode> found;

private:
    osg::Matrixd placeOfParent() const {
        osg::NodePath above = getNodePath();
        above.pop_back();
        return osg::computeLocalToWorld(above, false);
    }

    std::string _name;
};

class NameLister : public osg::NodeVisitor {
public:
    explicit NameLister(std::size_t limit) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _limit(limit) {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override {
        if (names.size() >= _limit) return;
        const std::string& name = node.getName();
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        traverse(node);
    }

    std::vector<std::string> names;

private:
    std::size_t _limit;
};

} // namespace

std::optional<NamedNode> findNamed(osg::Node& root, const std::string& name) {
    const std::vector<NamedNode> found = findAllNamed(root, name);
    return found.empty() ? std::nullopt : std::optional<NamedNode>(found.front());
}

std::vector<NamedNode> findAllNamed(osg::Node& root, const std::string& name) {
    if (name.empty()) return {};
    Finder finder(name);
    root.accept(finder);
    return finder.found;
}

Selection selectionOf(const std::vector<NamedNode>& nodes) {
    Selection selection;
    std::set<const osg::Node*> met;
    for (const NamedNode& named : nodes) {
        if (!met.insert(named.node.get()).second) continue;
        if (selection.node)
            selection.others.push_back(named.node);
        else
            selection.node = named.node;
    }
    return selection;
}

std::vector<std::string> nodeNames(osg::Node& root, std::size_t limit) {
    NameLister lister(limit);
    root.accept(lister);
    return lister.names;
}

} // namespace gnomon
