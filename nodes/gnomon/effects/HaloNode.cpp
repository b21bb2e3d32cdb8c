// SPDX-License-Identifier: MIT
#include <gnomon/HaloNode.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/effects/HaloEffect.h>
#include <gnomon/effects/SubgraphCull.h>

#include <osg/Notify>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double mostScale = 1000.0;
constexpr int mostPixels = 8;

/// About a point that keeps its place.
osg::Matrixd scaledAbout(const osg::Vec3d& centre, double factor) {
    return osg::Matrixd::translate(-centre) * osg::Matrixd::scale(factor, factor, factor) *
           osg::Matrixd::translate(centre);
}

/// Of all the leaves, in the frame of their node.
osg::BoundingBoxd boxOfAll(const std::vector<DrawnLeaf>& leaves, const osg::Matrixd& nodeFromEye) {
    osg::BoundingBoxd all;
    for (const DrawnLeaf& entry : leaves) all.expandBy(boxOf(*entry.leaf, modelviewOf(*entry.leaf) * nodeFromEye));
    return all;
}

/// Eye space from drawable, of the larger leaves.
std::vector<osg::Matrixd> largerLeaves(const HaloNode& node, const std::vector<DrawnLeaf>& leaves,
                                       const osg::Matrixd& eyeFromNode) {
    const osg::Matrixd nodeFromEye = osg::Matrixd::inverse(eyeFromNode);
    const osg::Vec3d middle = boxOfAll(leaves, nodeFromEye).center();
    const osg::Matrixd whole = nodeFromEye * scaledAbout(middle, node.getScale()) * eyeFromNode;
    std::vector<osg::Matrixd> larger;
    for (const DrawnLeaf& entry : leaves) {
        const osg::Vec3d own(entry.leaf->_drawable->getBoundingBox().center());
        const osg::Matrixd& place = modelviewOf(*entry.leaf);
        larger.push_back(node.getShape() == HaloNode::WHOLE ? place * whole
                                                            : scaledAbout(own, node.getScale()) * place);
    }
    return larger;
}

/// What is larger may lie before the near plane and behind the far one.
void includeLarger(osgUtil::CullVisitor& cull, const std::vector<DrawnLeaf>& leaves,
                   const std::vector<osg::Matrixd>& larger) {
    osg::BoundingBoxd all;
    for (std::size_t i = 0; i < larger.size(); ++i) all.expandBy(boxOf(*leaves[i].leaf, larger[i]));
    includeInDepths(cull, all, true);
}

} // namespace

HaloNode::HaloNode(const HaloNode& other, const osg::CopyOp& copyOp)
    : EffectNode(other, copyOp),
      _shape(other._shape),
      _scale(other._scale),
      _width(other._width),
      _color(other._color),
      _stencilCure(other._stencilCure) {}

void HaloNode::setShape(Shape shape) {
    _shape = shape == PARTS || shape == PIXELS ? shape : WHOLE;
    dirtyBound();
}

void HaloNode::setScale(double factor) {
    if (std::isnan(factor)) {
        OSG_WARN << "gnomon: HaloNode::setScale(): NaN is refused. Give a factor from 1 (no halo) to 1000."
                 << std::endl;
        return;
    }
    _scale = std::clamp(factor, 1.0, mostScale);
    dirtyBound();
}

void HaloNode::setWidth(int pixels) { _width = std::clamp(pixels, 0, mostPixels); }

void HaloNode::setColor(const osg::Vec4f& color) {
    if (color.isNaN()) {
        OSG_WARN << "gnomon: HaloNode::setColor(): NaN is refused. Give red, green, blue and opacity from 0 to 1."
                 << std::endl;
        return;
    }
    for (int i = 0; i < 4; ++i) _color[i] = std::clamp(color[i], 0.0f, 1.0f);
}

/// Whatever point of the bound the children are scaled about, the larger ones stay within twice the scale.
osg::BoundingSphere HaloNode::computeBound() const {
    osg::BoundingSphere bound = EffectNode::computeBound();
    if (bound.valid() && _shape != PIXELS) bound.radius() *= static_cast<float>(2.0 * _scale - 1.0);
    return bound;
}

osg::ref_ptr<ViewEffect> HaloNode::makeEffect(osgUtil::CullVisitor& cull) {
    if (!isOn()) return nullptr;
    const osg::Matrixd& eyeFromNode = *cull.getModelViewMatrix();
    osg::ref_ptr<HaloEffect> effect = new HaloEffect;
    effect->children =
        new SubgraphCull(cull, *this, eyeFromNode, SubgraphCull::Keep::All); // out of sight, its rim may be in
    effect->report = reportIn(frameOf(cull));
    effect->width = _shape == PIXELS ? _width : 0;
    effect->color = _color;
    effect->stencilCure = _stencilCure;
    if (_shape == PIXELS) return effect;
    const std::vector<DrawnLeaf> leaves = effect->children->leaves();
    effect->larger = largerLeaves(*this, leaves, eyeFromNode);
    includeLarger(cull, leaves, effect->larger);
    return effect;
}

} // namespace gnomon
