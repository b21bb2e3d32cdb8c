// SPDX-License-Identifier: MIT
#include "PeerStaging.h"

#include <gnomon/NamedNode.h>

#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowedScene>
#include <osgUtil/CullVisitor>

#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr osg::Node::NodeMask casts = 0x1, receives = 0x2;

/// A camera of the technique's own that draws casters: no view has it, and it is not the one by which DrawBounds
/// techniques look at receivers.
bool isCastPass(osgUtil::CullVisitor& visitor) {
    const osg::Camera* camera = visitor.getCurrentCamera();
    return camera && !camera->getView() && camera->getName() != "AnalysisCamera";
}

/// Lets everything cast but the receiver, and the receiver alone receive; the way down to it lets both through.
class SplitMasks : public osg::NodeVisitor {
public:
    explicit SplitMasks(const std::string& receiver) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _receiver(receiver) {
        setNodeMaskOverride(~0u);
    }

    void apply(osg::Node& node) override {
        const bool found = !_found && node.getName() == _receiver;
        if (found) _found = true;
        const bool foundBefore = _found;
        if (!found) traverse(node);
        const bool above = _found && !foundBefore;
        if (node.getNodeMask() != 0) node.setNodeMask(found ? receives : above ? casts | receives : casts);
    }

    bool found() const { return _found; }

private:
    std::string _receiver;
    bool _found = false;
};

osg::ref_ptr<osg::Group> splitCopy(const osg::Group& content, const std::string& receiver) {
    osg::ref_ptr<osg::Group> copy = osg::clone(&content, osg::CopyOp(osg::CopyOp::DEEP_COPY_NODES));
    SplitMasks split(receiver);
    if (!receiver.empty()) copy->accept(split);
    if (!split.found())
        throw std::invalid_argument("ShadowTexture needs a receiver that does not cast, but the scene names none.");
    return copy;
}

} // namespace

class PeerStaging::Gate : public osg::NodeCallback {
public:
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        osgUtil::CullVisitor* cull = visitor->asCullVisitor();
        if (open || !cull || !isCastPass(*cull)) traverse(node, visitor);
    }

    bool open = true;
};

PeerStaging::PeerStaging(const Peer& peer, const Settings& settings, const ChartScene& scene, Look look)
    : Staging(scene, look) {
    const PeerParts parts = makePeer(peer, settings, scene.radius);
    osg::ref_ptr<osgShadow::ShadowedScene> shadowed = new osgShadow::ShadowedScene(parts.technique);
    if (!peer.partsCastAndReceive) {
        _content = splitCopy(*_content, scene.receiver);
        parts.settings->setCastsShadowTraversalMask(casts);
        parts.settings->setReceivesShadowTraversalMask(receives);
    }
    shadowed->setShadowSettings(parts.settings.get());
    if (auto* splits = dynamic_cast<osgShadow::ParallelSplitShadowMap*>(parts.technique.get()))
        splits->setUserLight(_light);
    if (look == Look::VISIBILITY) {
        if (!peer.lightOnly.empty()) setAmbientBias(*parts.technique, peer.lightOnly);
        _gate = new Gate;
        osg::ref_ptr<osg::Group> gated = new osg::Group;
        gated->addChild(_content);
        gated->setCullCallback(_gate);
        shadowed->addChild(gated);
    } else {
        shadowed->addChild(_content);
    }
    _root->addChild(shadowed);
}

PeerStaging::~PeerStaging() = default;

void PeerStaging::setCasting(bool on) {
    if (_gate) _gate->open = on;
}

} // namespace gnomon::examples
