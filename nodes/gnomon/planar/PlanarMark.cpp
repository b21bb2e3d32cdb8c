// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/base/PixelRect.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/planar/PlanarMark.h>

#include <osg/State>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr GLenum clipAbovePlane = GL_CLIP_PLANE0; // the same value as GL_CLIP_DISTANCE0
constexpr GLenum clipBelowLight = GL_CLIP_PLANE1;

/// An offset in window depth, as OpenGL adds its parts up.
double depthOf(const glm::dvec2& offset, const osg::Viewport& viewport, const glm::dvec3& depth) {
    GLint depthBits = 24;
    glGetIntegerv(GL_DEPTH_BITS, &depthBits);
    const PixelRect all = pixelsOf(viewport);
    const double slope = std::abs(depth.x) / all.width + std::abs(depth.y) / all.height; // a pixel
    return offset.x * slope + offset.y * std::ldexp(1.0, -std::min(depthBits, 24));
}

} // namespace

PlanarPrograms::PlanarPrograms()
    : plain(shaderProgram()), clipping(shaderProgram("#define CLIP\n")), edges(new MarkEdges(MarkEdges::Of::Lines)) {}

bool PlanarMark::canReach(const osgUtil::RenderLeaf& leaf) const {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    const auto plane = normalizedPlane(glm::transpose(toGlm(modelviewOf(leaf))) * eyePlane);
    if (!box.valid() || !plane) return true;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (unsigned i = 0; i < 8; ++i) {
        const double height = distance(*plane, toGlm(osg::Vec3d(box.corner(i))));
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    const double margin = 0.01 * (box._max - box._min).length();
    return lowest <= margin && highest >= -margin;
}

std::string PlanarMark::draw(ScreenPass& pass) const {
    const bool drawn = drawParts(pass.renderInfo());
    if (cutToPlane) cut(pass);
    return drawn ? "" : noProgram;
}

/// All lines, for in the first frame it is not known yet which triangles of solids need not be drawn.
void PlanarMark::drawEdges(ScreenPass& pass) const {
    for (const PlanarPart& part : casters->parts) drawPart(pass.renderInfo(), part, false);
}

/// @return false if some program is not to be had.
bool PlanarMark::drawParts(osg::RenderInfo& renderInfo) const {
    osg::State& state = *renderInfo.getState();
    bool drawn = true;
    for (const bool clipping : {false, true}) {
        const auto meant = [&](const PlanarPart& part) { return clips(part) == clipping; };
        if (std::none_of(casters->parts.begin(), casters->parts.end(), meant)) continue;
        state.apply((clipping ? programs->clipping : programs->plain).get());
        if (!hasProgram(state)) {
            drawn = false;
            continue;
        }
        for (const PlanarPart& part : casters->parts)
            if (meant(part)) drawPart(renderInfo, part, true);
    }
    state.apply();
    return drawn;
}

/// @param cullsSolids  draws only those triangles of a solid that are turned to the light.
void PlanarMark::drawPart(osg::RenderInfo& renderInfo, const PlanarPart& part, bool cullsSolids) const {
    const osg::State& state = *renderInfo.getState();
    // A solid cut by the light's height may lack its upper faces.
    const bool culls = cullsSolids && part.solid && !reachesLight, isClipped = clips(part);
    const glm::dmat4 planes = glm::transpose(part.sceneFromMesh);
    setUniform(state, "clipFromVertex", clipFromScene * part.sceneFromMesh);
    if (isClipped) {
        setUniform(state, "abovePlane", planes * (abovePlane - glm::dvec4(0.0, 0.0, 0.0, part.thickness)));
        setUniform(state, "belowLight", planes * belowLight);
    }
    if (isClipped && part.crossing) glEnable(clipAbovePlane);
    if (isClipped && reachesLight) glEnable(clipBelowLight);
    if (culls) glEnable(GL_CULL_FACE);
    glFrontFace(mirrored != part.mirrored ? GL_CW : GL_CCW);
    part.geometry->draw(renderInfo);
    glFrontFace(GL_CCW);
    for (const GLenum mode : {clipAbovePlane, clipBelowLight, GLenum(GL_CULL_FACE)}) glDisable(mode);
}

/// Takes the marks back where what stands in the depth buffer is behind the plane, and where it is before it.
void PlanarMark::cut(ScreenPass& pass) const {
    // In normalised device coordinates, twice as long as window depths.
    const auto moved = [&](const glm::dvec2& by) {
        return 2.0 * depthOf(by, *pass.state().getCurrentViewport(), depth);
    };
    pass.stencilEqual(0, 0, pass.bit());
    pass.testDepth(GL_LEQUAL);
    pass.drawQuad(farthest.z + moved(farthestOffset + tolerance), farthest.x, farthest.y);
    pass.testDepth(GL_GREATER);
    pass.drawQuad(nearest.z + moved(nearestOffset - tolerance), nearest.x, nearest.y);
}

} // namespace gnomon
