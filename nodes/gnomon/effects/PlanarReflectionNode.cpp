// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/Plane.h>
#include <gnomon/Reflection.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/effects/ReflectionEffect.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/geometric.hpp>
#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// True if the eye is on the side that is mirrored.
bool isSeen(const glm::dvec4& eyePlane, const osg::Matrixd& projection) {
    return glm::dot(eyePlane, eyeIn(toGlm(projection))) > 0.0;
}

/// Depths of what is mirrored, as far as the far plane is concerned: no image is nearer than the surface.
void includeImages(osgUtil::CullVisitor& cull, SubgraphCull& mirrored) {
    osg::BoundingBoxd all;
    for (const DrawnLeaf& entry : mirrored.leaves()) all.expandBy(boxOf(*entry.leaf, modelviewOf(*entry.leaf)));
    includeInDepths(cull, all, false);
}

} // namespace

PlanarReflectionNode::PlanarReflectionNode() : _saved(std::make_shared<FrameColorCopy>()) {}

PlanarReflectionNode::PlanarReflectionNode(const PlanarReflectionNode& other, const osg::CopyOp& copyOp)
    : EffectNode(other, copyOp),
      _plane(other._plane),
      _surface(other._surface, other),
      _reflectance(other._reflectance),
      _stencilCure(other._stencilCure),
      _saved(std::make_shared<FrameColorCopy>()) {}

PlanarReflectionNode::~PlanarReflectionNode() = default;

void PlanarReflectionNode::setPlane(const osg::Vec4d& plane) {
    _plane = plane;
    dirtyBound();
}

void PlanarReflectionNode::setReflectance(const osg::Vec3f& share) {
    if (share.isNaN()) {
        OSG_WARN << "gnomon: PlanarReflectionNode::setReflectance(): NaN is refused. Give shares from 0 (no image) to "
                    "1 (a perfect mirror)."
                 << std::endl;
        return;
    }
    for (int i = 0; i < 3; ++i) _reflectance[i] = std::clamp(share[i], 0.0f, 1.0f);
}

std::vector<Selection> PlanarReflectionNode::namedParts() const {
    if (getSurface() == Selection()) return {};
    return {getSurface()};
}

osg::BoundingSphere PlanarReflectionNode::computeBound() const {
    osg::BoundingSphere bound = EffectNode::computeBound();
    const auto plane = normalizedPlane(toGlm(_plane));
    if (!bound.valid() || !plane) return bound;
    const osg::Vec3d image = osg::Vec3d(bound.center()) * toOsg(reflectionMatrix(*plane));
    bound.expandBy(osg::BoundingSphere(image, bound.radius()));
    return bound;
}

osg::ref_ptr<ViewEffect> PlanarReflectionNode::makeEffect(osgUtil::CullVisitor& cull) {
    const osg::Matrixd& eyeFromNode = *cull.getModelViewMatrix();
    const auto plane = normalizedPlane(toGlm(_plane));
    const auto eyePlane = plane ? transformedPlane(toGlm(eyeFromNode), *plane) : plane;
    const Selection surface = getSurface();
    if (_surface.isGone(*this))
        report(frameOf(cull), "the node given to setSurface() is gone, because nothing else kept it. Add the surface "
                              "to the scene, and name it anew.");
    else if (surface == Selection())
        report(frameOf(cull),
               "no surface is named, so there is no image. Name the node that shows the image with setSurface().");
    else if (!eyePlane)
        report(frameOf(cull), "the plane's normal, or a transform above the node, is zero or not a number, so there is "
                              "no image. Give (a, b, c, d) of the plane a x + b y + c z + d = 0.");
    else if (isSeen(*eyePlane, *cull.getProjectionMatrix())) {
        osg::ref_ptr<ReflectionEffect> effect = new ReflectionEffect;
        effect->node = this;
        effect->eyePlane = *eyePlane;
        effect->mirrored =
            new SubgraphCull(cull, *this, eyeFromNode * toOsg(reflectionMatrix(*eyePlane)), SubgraphCull::Keep::InView);
        effect->saved = _saved;
        effect->report = reportIn(frameOf(cull));
        effect->surface = surface;
        effect->reflectance = _reflectance;
        effect->stencilCure = _stencilCure;
        includeImages(cull, *effect->mirrored);
        return effect;
    }
    return nullptr;
}

void PlanarReflectionNode::resizeGLObjectBuffers(unsigned maxSize) {
    EffectNode::resizeGLObjectBuffers(maxSize);
    _saved->resizeGLObjectBuffers(maxSize);
}

void PlanarReflectionNode::releaseGLObjects(osg::State* state) const {
    EffectNode::releaseGLObjects(state);
    _saved->release(state);
}

} // namespace gnomon
