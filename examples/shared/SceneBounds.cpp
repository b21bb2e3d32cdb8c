// SPDX-License-Identifier: MIT
#include "SceneBounds.h"

namespace gnomon::examples {

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
