// SPDX-License-Identifier: MIT
#include <gnomon/FrameCauses.h>
#include <gnomon/Convert.h>
#include <gnomon/CopiedNodes.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/Plane.h>
#include <gnomon/Reflection.h>
#include <gnomon/ReflectionEffect.h>
#include <gnomon/ScreenBounds.h>

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
    for (const StageLeaf& entry : mirrored.leaves()) all.expandBy(boxOf(*entry.leaf, *entry.leaf->_modelview));
    includeInDepths(cull, all, false);
}

} // namespace

PlanarReflectionNode::PlanarReflectionNode() : _saved(std::make_shared<SavedColors>()) {}

PlanarReflectionNode::PlanarReflectionNode(const PlanarReflectionNode& other, const osg::CopyOp& copyOp)
    : StageEffectNode(other, copyOp),
      _plane(other._plane),
      _surface(other._surface),
      _reflectance(other._reflectance),
      _stencilCure(other._stencilCure),
      _saved(std::make_shared<SavedColors>()) {
    _surface.node = CopiedNodes(other, *this).of(_surface.node.get());
}

PlanarReflectionNode::~PlanarReflectionNode() = default;

void PlanarReflectionNode::setPlane(const osg::Vec4d& plane) {
    _plane = plane;
    dirtyBound();
}

void PlanarReflectionNode::setReflectance(const osg::Vec3f& share) {
    if (share.isNaN()) {
        OSG_WARN << "gnomon: PlanarReflectionNode::setReflectance() refuses NaN: shares are 0 (none) to 1 (all)."
                 << std::endl;
        return;
    }
    for (int i = 0; i < 3; ++i) _reflectance[i] = std::clamp(share[i], 0.0f, 1.0f);
}

osg::BoundingSphere PlanarReflectionNode::computeBound() const {
    osg::BoundingSphere bound = StageEffectNode::computeBound();
    const auto plane = normalizedPlane(toGlm(_plane));
    if (!bound.valid() || !plane) return bound;
    const osg::Vec3d image = osg::Vec3d(bound.center()) * toOsg(reflectionMatrix(*plane));
    bound.expandBy(osg::BoundingSphere(image, bound.radius()));
    return bound;
}

osg::ref_ptr<StageEffect> PlanarReflectionNode::makeEffect(osgUtil::CullVisitor& cull) {
    const osg::Matrixd& eyeFromNode = *cull.getModelViewMatrix();
    const auto plane = normalizedPlane(toGlm(_plane));
    const auto eyePlane = plane ? transformedPlane(toGlm(eyeFromNode), *plane) : plane;
    if (_surface == Selection())
        report(frameOf(cull), "has no surface: name what the image is seen in with setSurface().");
    else if (!eyePlane)
        report(frameOf(cull),
               "cannot mirror in its plane, whose normal is zero or not a number (or the transforms above "
               "it are not): give (a, b, c, d) of a x + b y + c z + d = 0.");
    else if (isSeen(*eyePlane, *cull.getProjectionMatrix())) {
        osg::ref_ptr<ReflectionEffect> effect = new ReflectionEffect;
        effect->node = this;
        effect->eyePlane = *eyePlane;
        effect->mirrored =
            new SubgraphCull(cull, *this, eyeFromNode * toOsg(reflectionMatrix(*eyePlane)), SubgraphCull::Keep::InView);
        effect->saved = _saved;
        effect->frameNumber = frameOf(cull);
        includeImages(cull, *effect->mirrored);
        return effect;
    }
    return nullptr;
}

void PlanarReflectionNode::resizeGLObjectBuffers(unsigned maxSize) {
    StageEffectNode::resizeGLObjectBuffers(maxSize);
    _saved->resizeGLObjectBuffers(maxSize);
}

void PlanarReflectionNode::releaseGLObjects(osg::State* state) const {
    StageEffectNode::releaseGLObjects(state);
    _saved->release(state);
}

} // namespace gnomon
