// SPDX-License-Identifier: MIT
#include <gnomon/VertexTraverser.h>
#include <gnomon/casters/CasterExtraction.h>

#include <limits>

namespace gnomon {

VertexTraverser::VertexTraverser(const Selection& selection)
    : osg::NodeVisitor(NODE_VISITOR, TRAVERSE_ACTIVE_CHILDREN), _found(new CasterExtraction(selection)) {
    setTraversalMask(selection.mask);
}

VertexTraverser::~VertexTraverser() = default;

void VertexTraverser::reset() { _found->reset(); }

/// Of the root alone: the extraction goes down itself. It knows what is above the root on the way that led here.
void VertexTraverser::apply(osg::Node& root) {
    const osg::NodePath& way = getNodePath();
    for (std::size_t i = 0; i + 1 < way.size(); ++i) _found->pushOntoNodePath(way[i]);
    _found->setFrameStamp(const_cast<osg::FrameStamp*>(getFrameStamp())); // which only hands it on
    _found->setTraversalMask(getTraversalMask());
    _found->setNodeMaskOverride(getNodeMaskOverride());
    _found->setTraversalMode(getTraversalMode());
    root.accept(*_found);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) _found->popFromNodePath();
}

const std::vector<osg::Vec3d>& VertexTraverser::getVertices() const { return _found->getVertices(); }
const std::vector<unsigned>& VertexTraverser::getTriangles() const { return _found->getTriangles(); }
double VertexTraverser::getRounding() const { return _found->getRounding(); }
unsigned VertexTraverser::getInvalidTriangles() const { return _found->getInvalidTriangles(); }
const std::string& VertexTraverser::getInvalidNode() const { return _found->getInvalidNode(); }

namespace {

template <class Distance>
std::optional<osg::Vec3d> nearest(const std::vector<osg::Vec3d>& vertices, Distance squaredDistance) {
    std::optional<osg::Vec3d> best;
    double least = std::numeric_limits<double>::infinity();
    for (const osg::Vec3d& vertex : vertices) {
        const double distance = squaredDistance(vertex);
        if (!(distance < least)) continue;
        least = distance;
        best = vertex;
    }
    return best;
}

} // namespace

std::optional<osg::Vec3d> VertexTraverser::nearestVertex(const osg::Vec3d& point) const {
    return nearest(getVertices(), [&](const osg::Vec3d& v) { return (v - point).length2(); });
}

std::optional<osg::Vec3d> VertexTraverser::nearestVertexInPlan(double x, double y) const {
    return nearest(getVertices(), [=](const osg::Vec3d& v) { return osg::Vec2d(v.x() - x, v.y() - y).length2(); });
}

} // namespace gnomon
