// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osg/Viewport>

#include <vector>

namespace gnomon {

constexpr GLenum depthClamp = 0x864F; ///< GL_DEPTH_CLAMP: in OpenGL 3.2, not in OSG's headers of 3.6.

/// OpenGL as OSG leaves it after an empty scene, with the depth test off: no program, texture, blending or culling, and
/// the stage's viewport. Holds from construction to destruction; state sets that lay on the stack must have been popped
/// before.
class CleanState {
public:
    CleanState(osg::State& state, osg::Viewport* viewport);
    ~CleanState();
    CleanState(const CleanState&) = delete;
    CleanState& operator=(const CleanState&) = delete;

private:
    osg::State& _state;
    osg::ref_ptr<osg::StateSet> _set;
};

/// True in a core profile, which has neither OpenGL's matrices and lights nor what CleanState draws with.
bool isCoreProfile(const osg::State& state);

/// Puts OpenGL's stencil, depth, blending, scissor and colour mask to their defaults and tells osg::State so.
void leaveDefaults(osg::State& state);

/// Switches blending on: what is drawn times `source` is added to what stands times `destination`.
void addBlended(const osg::State& state, GLenum source, GLenum destination);

/// What is neither cut away by the scissor nor by the viewport, in window coordinates.
struct PixelRect {
    GLint x = 0, y = 0;
    GLsizei width = 0, height = 0;

    bool empty() const { return width <= 0 || height <= 0; }
};
PixelRect pixelsInScissor(const osg::Viewport& viewport);

/// Rectangle over the whole viewport; depth in normalised device coordinates, z = atCenter + x·slopeX + y·slopeY.
void drawQuad(osg::State& state, double atCenter = 0.0, double slopeX = 0.0, double slopeY = 0.0);

/// A convex polygon in normalised device coordinates; as drawQuad() if there are no corners.
void drawPolygon(osg::State& state, const std::vector<glm::dvec2>& corners, double depth);

} // namespace gnomon
