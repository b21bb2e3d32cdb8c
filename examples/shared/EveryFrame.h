// SPDX-License-Identifier: MIT
#pragma once
#include <osg/FrameStamp>
#include <osg/Node>
#include <osg/NodeVisitor>

#include <functional>

namespace gnomon::examples {

/// Calls a function in each update traversal, with the seconds of simulation time.
class EveryFrame : public osg::NodeCallback {
public:
    explicit EveryFrame(std::function<void(double seconds)> act) : _act(std::move(act)) {}

    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        _act(visitor->getFrameStamp() ? visitor->getFrameStamp()->getSimulationTime() : 0.0);
        traverse(node, visitor);
    }

private:
    std::function<void(double)> _act;
};

} // namespace gnomon::examples
