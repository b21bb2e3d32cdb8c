// SPDX-License-Identifier: MIT
#include <gnomon/NamesNodes.h>
#include <gnomon/base/OptimizerGuard.h>

#include <osg/MatrixTransform>
#include <osg/StateSet>
#include <osgUtil/Optimizer>

#include <algorithm>

namespace gnomon {
namespace {

using Flattening = osgUtil::Optimizer::FlattenStaticTransformsDuplicatingSharedSubgraphsVisitor;

bool isOptimizer(const osg::NodeVisitor& visitor) {
    return visitor.getVisitorType() == osg::NodeVisitor::NODE_VISITOR &&
           dynamic_cast<const osgUtil::BaseOptimizerVisitor*>(&visitor);
}

bool isTransform(const osg::Node* node) { return node->asTransform() != nullptr; }

void keepTransformsAt(osg::Node& node) {
    if (isTransform(&node)) node.setDataVariance(osg::Object::DYNAMIC);
    for (osg::Group* parent : node.getParents()) keepTransformsAt(*parent);
}

/// A state set of its own keeps a Geode from being merged with others, user data an unnamed Group from being left out.
void keep(osg::Node& node) {
    keepTransformsAt(node);
    if (node.asDrawable()) node.setDataVariance(osg::Object::DYNAMIC);
    node.getOrCreateUserDataContainer();
    if (!node.asGeode() || (node.getStateSet() && node.getStateSet()->getDataVariance() == osg::Object::DYNAMIC))
        return;
    osg::ref_ptr<osg::StateSet> guarded =
        node.getStateSet() ? new osg::StateSet(*node.getStateSet()) : new osg::StateSet;
    guarded->setDataVariance(osg::Object::DYNAMIC); // not shared with equal ones
    node.setStateSet(guarded);
}

bool isBelow(const osg::Node& node, const osg::Node& top) {
    const auto& parents = node.getParents();
    return &node == &top ||
           std::any_of(parents.begin(), parents.end(), [&](const osg::Group* parent) { return isBelow(*parent, top); });
}

/// What the kit's nodes at and below a node name, and whether one of them stands below a transform there.
class KitVisitor : public osg::NodeVisitor {
public:
    explicit KitVisitor(const osg::Node& top) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _top(top) {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override {
        if (const auto* names = dynamic_cast<const NamesNodes*>(&node)) meet(*names);
        traverse(node);
    }

    bool found = false;

private:
    void meet(const NamesNodes& names) {
        found = found || std::any_of(getNodePath().begin(), getNodePath().end(), isTransform);
        for (const Selection& part : names.namedParts()) {
            found = true;
            for (const osg::ref_ptr<osg::Node>& root : part.roots())
                if (!isBelow(*root, _top)) keep(*root);
        }
    }

    const osg::Node& _top;
};

/// The visitor's own stack, which it shows to classes derived from it.
struct Stack : Flattening {
    static const std::vector<osg::Matrix>& of(const Flattening& visitor) { return visitor.*(&Stack::_matrixStack); }
};

/// This visitor has taken transforms away on its way down. What they did stands above the node from here on.
bool isPlacedAgain(osg::Node& node, osg::NodeVisitor& visitor) {
    const auto* flattening = dynamic_cast<const Flattening*>(&visitor);
    const osg::NodePath& path = visitor.getNodePath();
    if (!flattening || Stack::of(*flattening).empty() || path.size() < 2) return false;
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(Stack::of(*flattening).back());
    place->setDataVariance(osg::Object::DYNAMIC);
    place->addChild(&node);
    path[path.size() - 2]->asGroup()->replaceChild(&node, place);
    return true;
}

} // namespace

bool keptFromOptimizer(osg::Node& node, osg::NodeVisitor& visitor) {
    if (!isOptimizer(visitor)) return false;
    for (osg::Node* above : visitor.getNodePath())
        if (isTransform(above)) above->setDataVariance(osg::Object::DYNAMIC);
    KitVisitor kit(node);
    node.accept(kit);
    return isPlacedAgain(node, visitor) || kit.found;
}

bool endsForOptimizer(osg::NodeVisitor& visitor) {
    if (!isOptimizer(visitor)) return false;
    osg::ref_ptr<osg::Node> end = new osg::Node;
    visitor.apply(*end);
    return true;
}

} // namespace gnomon
