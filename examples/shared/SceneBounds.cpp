// SPDX-License-Identifier: MIT
#include "SceneBounds.h"

#include <gnomon/VertexTraverser.h>

#include <osg/ComputeBoundsVisitor>

#include <cmath>

namespace gnomon::examples {
namespace {

bool finite(const osg::Vec3d& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

osg::BoundingBoxd ofVertices(osg::Node& root) {
    VertexTraverser traverser;
    root.accept(traverser);
    osg::BoundingBoxd box;
    for (const osg::Vec3d& vertex : traverser.getVertices())
        if (finite(vertex)) box.expandBy(vertex);
    return box;
}

/// Text and billboards, which are no casters, have bounds only here.
osg::BoundingBoxd ofDrawables(osg::Node& root) {
    osg::ComputeBoundsVisitor visitor;
    root.accept(visitor);
    const osg::BoundingBox& box = visitor.getBoundingBox();
    const osg::Vec3d low(box._min), high(box._max);
    return box.valid() && finite(low) && finite(high) ? osg::BoundingBoxd(low, high) : osg::BoundingBoxd();
}

} // namespace

osg::BoundingBoxd sceneBounds(osg::Node& root) {
    const osg::BoundingBoxd box = ofVertices(root);
    return box.valid() ? box : ofDrawables(root);
}

osg::ref_ptr<osg::MatrixTransform> fitted(osg::Node& root, double radius) {
    const osg::BoundingBoxd box = sceneBounds(root);
    const double scale = box.valid() && box.radius() > 0.0 ? radius / box.radius() : 1.0;
    const osg::Vec3d middle = box.valid() ? box.center() : osg::Vec3d();
    osg::ref_ptr<osg::MatrixTransform> result =
        new osg::MatrixTransform(osg::Matrixd::translate(-middle) * osg::Matrixd::scale(scale, scale, scale));
    result->addChild(&root);
    return result;
}

} // namespace gnomon::examples
