// SPDX-License-Identifier: MIT
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/AutoView.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/gl/TriangleClusters.h>

#include <osg/Geometry>
#include <osg/Material>

#include <algorithm>

namespace gnomon {
namespace {

constexpr double ofAShape = 200.0; // triangles: a ShapeDrawable's sphere has some hundred, its box 12

bool isMoreThanWhite(const osg::Material& material) {
    for (const osg::Material::Face face : {osg::Material::FRONT, osg::Material::BACK})
        for (const osg::Vec4& color : {material.getDiffuse(face), material.getSpecular(face)})
            if (std::max({color.r(), color.g(), color.b()}) > 1.0f) return true;
    return false;
}

/// How much of a leaf is drawn again, as LeafReplay does.
double shareWithin(const osgUtil::RenderLeaf& leaf, const ScreenRect& bounds) {
    const osg::ref_ptr<const TriangleClusters> clusters = TriangleClusters::of(*leaf._drawable);
    if (!clusters) return 1.0;
    double drawn = 0.0, all = 0.0;
    for (const auto& run : clusters->touching(bounds, modelviewOf(leaf) * projectionOf(leaf))) drawn += run.count;
    for (const auto& set : leaf._drawable->asGeometry()->getPrimitiveSetList()) all += set->getNumIndices();
    return std::min(1.0, drawn / all);
}

} // namespace

bool isShadedByOpenGl(const osgUtil::StateGraph* graph) {
    if (!isOn(graph, GL_LIGHTING) || resolvedAttribute(graph, osg::StateAttribute::PROGRAM)) return false;
    const auto* material = resolved<osg::Material>(graph, osg::StateAttribute::MATERIAL);
    return !material || !isMoreThanWhite(*material);
}

/// Shadows of lights that are fainter may fall on the same place, and are left out, too.
bool isFaint(const AutoView& view) {
    const auto found = view.frame.strengths.find(view.light.number);
    if (view.frame.group->getComposite() != ShadowCasterGroup::RELIGHT || found == view.frame.strengths.end())
        return false;
    const auto own = std::make_pair(found->second, found->first);
    double together = 0.0;
    for (const auto& [number, strength] : view.frame.strengths)
        if (std::make_pair(strength, number) <= own) together += strength;
    if (!(together < leastContrast)) return false;
    return std::all_of(view.frame.seen.begin(), view.frame.seen.end(),
                       [](const osgUtil::RenderLeaf* leaf) { return isShadedByOpenGl(leaf->_parent); });
}

std::uint64_t fingerprintOf(const std::vector<const osgUtil::RenderLeaf*>& leaves) {
    Fingerprint value;
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        value.mix(static_cast<const void*>(leaf->_drawable.get()));
        value.mix(modelviewOf(*leaf));
    }
    return value.value();
}

std::string whyCutOut(const CasterDrawables& casters) { return casters.cutouts > 0 ? "casters have clear parts" : ""; }

double trianglesOf(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry) return ofAShape;
    double triangles = 0.0;
    for (const auto& set : geometry->getPrimitiveSetList()) triangles += set->getNumPrimitives();
    return triangles;
}

double trianglesWithin(const std::vector<const osgUtil::RenderLeaf*>& leaves, const ScreenRect& bounds) {
    double triangles = 0.0;
    TouchTest touches(bounds);
    for (const osgUtil::RenderLeaf* leaf : leaves)
        if (touches(*leaf)) triangles += shareWithin(*leaf, bounds) * trianglesOf(*leaf->_drawable);
    return triangles;
}

double pixelsOf(const ViewFrame& frame, const ScreenRect& bounds) {
    const glm::dvec2 size = (bounds.high - bounds.low) / 2.0;
    return size.x > 0.0 && size.y > 0.0 ? size.x * frame.pixels.x() * size.y * frame.pixels.y() : 0.0;
}

} // namespace gnomon
