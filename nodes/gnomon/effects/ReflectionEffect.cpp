// SPDX-License-Identifier: MIT
#include <gnomon/Reflection.h>
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ReplaySelection.h>
#include <gnomon/effects/ReflectionEffect.h>

#include <algorithm>

namespace gnomon {
namespace {

/// Where on the screen any of the leaves can draw; nullopt if nowhere.
std::optional<ScreenRect> boundsOf(const std::vector<DrawnLeaf>& leaves) {
    std::optional<ScreenRect> all;
    for (const DrawnLeaf& entry : leaves)
        if (const auto bounds = screenBoundsOf(*entry.leaf)) all = all ? united(*all, *bounds) : *bounds;
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

} // namespace

void ReflectionEffect::prepare(osgUtil::RenderStage& stage, const std::vector<DrawnLeaf>& leaves) {
    const osg::Matrixd& eyeFromWorld = *stage.getInitialViewMatrix();
    const auto leavesOfSurface = receiversAmong(leaves, surface, eyeFromWorld);
    for (const DrawnLeaf& entry : leaves)
        if (leavesOfSurface.count(entry.leaf)) _surface.push_back(entry);
    if (_surface.empty()) {
        report(whyMissing(surface, "surface", *node, stage));
    }
    const auto bounds = boundsOf(_surface);
    if (!bounds) return _surface.clear();
    _bounds = *bounds;
    _leaves = mirrored->sortedLeaves();
    const auto image = receiversAmong(_leaves, surface, eyeFromWorld * toOsg(reflectionMatrix(eyePlane)));
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
        drawImage(draw, bit, bit);
        if (!stencilCure) drawImage(draw, 0, bit);
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

/// The mirrored leaves, where the bit is that of `reference`.
void ReflectionEffect::drawImage(const CompositorStage& draw, unsigned reference, unsigned bit) const {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = reference;
    overlay.test = bit;
    overlay.mirrored = true;
    overlay.bounds = reference ? _bounds : wholeScreen;
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

} // namespace gnomon
