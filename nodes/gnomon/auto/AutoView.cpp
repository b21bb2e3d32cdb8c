// SPDX-License-Identifier: MIT
#include <gnomon/auto/AutoView.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/compositor/DrawnLeaves.h>

#include <osg/Geometry>

namespace gnomon {
namespace {

constexpr double ofAShape = 200.0; // triangles: a ShapeDrawable's sphere has some hundred, its box 12

} // namespace

std::uint64_t fingerprintOf(const std::vector<const osgUtil::RenderLeaf*>& leaves) {
    Fingerprint value;
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        value.mix(static_cast<const void*>(leaf->_drawable.get()));
        value.mix(modelviewOf(*leaf));
    }
    return value.value();
}

std::string whyCutOut(const CasterDrawables& casters) {
    return casters.anyTested || casters.unknownTests > 0 ? "casters are cut out by an alpha test" : "";
}

double trianglesOf(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry) return ofAShape;
    double triangles = 0.0;
    for (const auto& set : geometry->getPrimitiveSetList()) triangles += set->getNumPrimitives();
    return triangles;
}

double trianglesWithin(const ViewFrame& frame, const ScreenRect& bounds) {
    double triangles = 0.0;
    TouchTest touches(bounds);
    for (const osgUtil::RenderLeaf* leaf : frame.seen)
        if (touches(*leaf)) triangles += trianglesOf(*leaf->_drawable);
    return triangles;
}

double pixelsOf(const ViewFrame& frame, const ScreenRect& bounds) {
    const glm::dvec2 size = (bounds.high - bounds.low) / 2.0;
    return size.x > 0.0 && size.y > 0.0 ? size.x * frame.pixels.x() * size.y * frame.pixels.y() : 0.0;
}

} // namespace gnomon
