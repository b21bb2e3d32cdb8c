// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/Plane.h>
#include <gnomon/Reflection.h>
#include <gnomon/Selection.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ViewEffect.h>
#include <gnomon/effects/SubgraphCull.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/gl/FrameColorCopy.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <osg/Notify>
#include <osg/Vec3f>

#include <algorithm>
#include <memory>
#include <vector>

namespace gnomon {
namespace {

/// What one mirror shows in one view.
class ReflectionEffect : public ViewEffect {
public:
    ReflectionEffect() : ViewEffect(Turn::BeforeBlending) {}

    osg::ref_ptr<const osg::Node> node; ///< whose effect it is.
    Selection surface;
    osg::Vec3f reflectance;
    osg::ref_ptr<SubgraphCull> mirrored; ///< the children, as their leaves stand in the mirror.
    glm::dvec4 eyePlane{0.0};            ///< unit normal, towards the side that is mirrored.
    std::shared_ptr<FrameColorCopy> saved;

    void prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) override;
    void draw(const CompositorStage& draw) const override;

private:
    void drawSurface(const CompositorStage& draw, unsigned write, bool standing) const;
    void drawImage(const CompositorStage& draw, unsigned bit) const;
    void mirrorPositions(const CompositorStage& draw) const;
    void restorePositions(const CompositorStage& draw) const;
    void mix(const CompositorStage& draw, unsigned bit) const;

    std::vector<DrawnLeaf> _surface, _leaves;
    ScreenRect _bounds = wholeScreen;
};

/// Where on the screen any of the leaves can draw; nullopt if nowhere.
std::optional<ScreenRect> screenBoundsOf(const std::vector<DrawnLeaf>& leaves) {
    std::optional<ScreenRect> all;
    for (const DrawnLeaf& entry : leaves)
        if (const auto bounds = gnomon::screenBoundsOf(*entry.leaf)) all = all ? united(*all, *bounds) : *bounds;
    return all;
}

/// All of the lights, clip planes and texture coordinates of a stage, as if the eye stood elsewhere.
void applyPositions(osg::State& state, osgUtil::RenderStage& stage, const osg::Matrixd& eyeFromEye) {
    osgUtil::RenderLeaf* none = nullptr;
    osg::Matrix inherited = stage.getInheritedPositionalStateContainerMatrix() * eyeFromEye, own = eyeFromEye;
    if (stage.getInheritedPositionalStateContainer())
        stage.getInheritedPositionalStateContainer()->draw(state, none, &inherited);
    if (stage.getPositionalStateContainer()) stage.getPositionalStateContainer()->draw(state, none, &own);
}

void ReflectionEffect::prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) {
    const osg::Matrixd& eyeFromWorld = *stage.getInitialViewMatrix();
    const auto leavesOfSurface = receiversAmong(leaves, surface, eyeFromWorld, *node);
    for (const DrawnLeaf& entry : leaves)
        if (leavesOfSurface.count(entry.leaf)) _surface.push_back(entry);
    if (_surface.empty()) {
        report(whyMissing(surface, "surface", *node, stage));
    }
    const auto bounds = screenBoundsOf(_surface);
    if (!bounds) return _surface.clear();
    _bounds = *bounds;
    _leaves = mirrored->sortedLeaves();
    const auto image = receiversAmong(_leaves, surface, eyeFromWorld * toOsg(reflectionMatrix(eyePlane)), *node);
    const auto isSurface = [&image](const DrawnLeaf& entry) { return image.count(entry.leaf) > 0; };
    _leaves.erase(std::remove_if(_leaves.begin(), _leaves.end(), isSurface), _leaves.end());
}

void ReflectionEffect::draw(const CompositorStage& draw) const {
    if (_surface.empty()) return;
    const unsigned bit = draw.bits.front();
    draw.clearLeftovers(bit);
    drawSurface(draw, bit, true);
    bool saves = false;
    draw.pass(_bounds, [&](ScreenPass& screen) {
        saves = saved->save(draw.state, *draw.stage.getViewport());
        if (!saves) return;
        screen.stencilAny(bit);
        screen.writeColor(draw.stage.getClearColor());
        screen.writeFarDepth();
    });
    if (saves) {
        mirrorPositions(draw);
        drawImage(draw, bit);
        restorePositions(draw);
        mix(draw, bit);
        drawSurface(draw, bit, false);
    } else
        report("the image cannot be drawn into a multisampled framebuffer object. Set the camera's "
               "multisample buffers to 0, or multisample its window instead.");
    draw.clear(bit, _bounds);
}

/// @param standing  it has been drawn and what one sees of it gets the bit; else its depth is drawn where the bit is.
void ReflectionEffect::drawSurface(const CompositorStage& draw, unsigned bit, bool standing) const {
    LeafReplay::Overlay overlay;
    overlay.color = LeafReplay::Color::None;
    overlay.equalDepth = standing;
    overlay.reference = bit;
    overlay.bounds = _bounds;
    (standing ? overlay.write : overlay.test) = bit;
    if (!standing) overlay.stencilFunction = GL_EQUAL;
    LeafReplay replay(draw, overlay);
    for (const DrawnLeaf& entry : _surface) replay.draw(entry);
}

/// The mirrored leaves, where the bit is.
void ReflectionEffect::drawImage(const CompositorStage& draw, unsigned bit) const {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = overlay.test = bit;
    overlay.mirrored = true;
    overlay.bounds = _bounds;
    LeafReplay replay(draw, overlay);
    TouchTest touches(overlay.bounds);
    for (const DrawnLeaf& entry : _leaves)
        if (touches(*entry.leaf)) replay.draw(entry);
}

/// The clip plane keeps what the mirror image shows of things before the mirror.
void ReflectionEffect::mirrorPositions(const CompositorStage& draw) const {
    applyPositions(draw.state, draw.stage, toOsg(reflectionMatrix(eyePlane)));
    draw.state.applyModelViewMatrix(nullptr);
    const GLdouble behind[4] = {-eyePlane.x, -eyePlane.y, -eyePlane.z, -eyePlane.w};
    glClipPlane(LeafReplay::mirrorClipPlane, behind);
}

void ReflectionEffect::restorePositions(const CompositorStage& draw) const {
    applyPositions(draw.state, draw.stage, osg::Matrixd());
}

/// The surface's own colours come back over the image, and far depth for the surface to be drawn at.
void ReflectionEffect::mix(const CompositorStage& draw, unsigned bit) const {
    draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilAny(bit);
        screen.beginMix(reflectance);
        saved->draw(draw.state);
        screen.endMix();
        screen.writeFarDepth();
    });
}

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
