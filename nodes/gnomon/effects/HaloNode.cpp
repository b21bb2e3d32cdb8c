// SPDX-License-Identifier: MIT
#include <gnomon/HaloNode.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ViewEffect.h>
#include <gnomon/effects/SubgraphCull.h>

#include <osg/Notify>
#include <osg/Vec4f>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon {
namespace {

/// The halo of one node in one view.
class HaloEffect : public ViewEffect {
public:
    HaloEffect() : ViewEffect(Turn::Last) {}

    int width = 0;    ///< of a rim in pixels; 0 if the children are made larger instead.
    osg::Vec4f color; ///< red, green, blue and opacity.
    osg::ref_ptr<SubgraphCull> children;
    std::vector<osg::Matrixd>
        larger; ///< eye space from drawable, of each of children->leaves(); empty where there is a rim in pixels.

    void prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) override;
    void draw(const CompositorStage& draw) const override;

private:
    void drawLarger(const CompositorStage& draw, LeafReplay::Overlay overlay) const;
    void markRim(const CompositorStage& draw, unsigned bit) const;

    std::vector<DrawnLeaf> _leaves, _larger;
    std::vector<osg::ref_ptr<osgUtil::RenderLeaf>> _largerLeaves; ///< what `_larger` points to.
};

/// All pixels of a disc.
std::vector<glm::ivec2> disc(int radius) {
    std::vector<glm::ivec2> pixels;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            if (x * x + y * y <= radius * radius) pixels.push_back({x, y});
    return pixels;
}

/// The leaves do not depend on what else the stage draws.
void HaloEffect::prepare(osgUtil::RenderStage&, const std::vector<DrawnLeaf>&) {
    const std::vector<DrawnLeaf> unsorted = children->leaves();
    for (std::size_t i = 0; i < larger.size(); ++i) {
        const osgUtil::RenderLeaf& leaf = *unsorted[i].leaf;
        osg::ref_ptr<osgUtil::RenderLeaf> copy =
            new osgUtil::RenderLeaf(leaf._drawable, leaf._projection, new osg::RefMatrix(larger[i]), leaf._depth);
        copy->_parent = leaf._parent;
        _largerLeaves.push_back(copy);
        _larger.push_back({copy, unsorted[i].bin});
    }
    _leaves = children->sortedLeaves();
}

void HaloEffect::draw(const CompositorStage& draw) const {
    const unsigned bit = draw.bits.front();
    draw.clearLeftovers(bit);
    markRim(draw, bit);
    draw.pass(wholeScreen, [&](ScreenPass& screen) {
        screen.takeStencil(bit, bit);
        screen.blendColor(osg::Vec3(color.x(), color.y(), color.z()), color.w());
    });
    draw.clear(bit, wholeScreen);
}

/// The larger children, or a rim in pixels about them, where they would be seen.
void HaloEffect::drawLarger(const CompositorStage& draw, LeafReplay::Overlay overlay) const {
    overlay.color = LeafReplay::Color::None;
    overlay.keepDepth = true;
    if (larger.empty()) overlay.shifts = disc(width);
    LeafReplay replay(draw, overlay);
    for (const DrawnLeaf& entry : larger.empty() ? _leaves : _larger) replay.draw(entry);
}

/// All of that but for what one sees of the children themselves.
void HaloEffect::markRim(const CompositorStage& draw, unsigned bit) const {
    LeafReplay::Overlay rim, seen;
    rim.reference = rim.write = seen.write = bit;
    drawLarger(draw, rim);
    seen.color = LeafReplay::Color::None;
    seen.keepDepth = true;
    seen.equalDepth = true;
    LeafReplay replay(draw, seen);
    for (const DrawnLeaf& entry : _leaves) replay.draw(entry);
}

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
        const osg::Vec3d ofLeaf(entry.leaf->_drawable->getBoundingBox().center());
        const osg::Matrixd& place = modelviewOf(*entry.leaf);
        larger.push_back(node.getShape() == HaloNode::WHOLE ? place * whole
                                                            : scaledAbout(ofLeaf, node.getScale()) * place);
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
      _color(other._color) {}

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
    if (_shape == PIXELS) return effect;
    const std::vector<DrawnLeaf> leaves = effect->children->leaves();
    effect->larger = largerLeaves(*this, leaves, eyeFromNode);
    includeLarger(cull, leaves, effect->larger);
    return effect;
}

} // namespace gnomon
