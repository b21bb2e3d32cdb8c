// SPDX-License-Identifier: MIT
#pragma once

#include <gnomon/ScreenRect.h>
#include <gnomon/base/PixelRect.h>

#include <glm/vec2.hpp>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osg/Viewport>

#include <vector>

namespace gnomon {

constexpr GLenum framebufferSrgb = 0x8DB9; ///< GL_FRAMEBUFFER_SRGB.
constexpr GLenum depthClamp = 0x864F;      ///< GL_DEPTH_CLAMP: in OpenGL 3.2, not in OSG's headers of 3.6.

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

/// Pixels to which OpenGL confines whatever is drawn, by a stencil test that osg::State knows nothing of: those of one eye
/// in OSG's interlaced stereo, which has 0 in the stencil buffer for the left eye's and 1 for the right eye's.
struct StencilPattern {
    unsigned bit = 0;   ///< that holds it; 0 if there is none.
    unsigned value = 0; ///< of that bit, in those pixels.

    /// The one that stands now. Call where no state set is on the stack.
    static StencilPattern read(osg::State& state);
    /// Puts the test back as OSG has it.
    void restore(osg::State& state) const;

    /// As glStencilFunc(), switched on, and in those pixels only. Where a test asks for NOTEQUAL or LEQUAL, what it asks
    /// for has been written in those pixels only, so that it holds of itself.
    void test(GLenum function, unsigned reference, unsigned mask) const;
};

/// While it lives, of several colour buffers only the first is drawn to: normals, IDs and the like in the others stay.
class FirstColorBuffer {
public:
    explicit FirstColorBuffer(const osg::State& state);
    ~FirstColorBuffer();
    FirstColorBuffer(const FirstColorBuffer&) = delete;
    FirstColorBuffer& operator=(const FirstColorBuffer&) = delete;

private:
    const osg::State& _state;
    std::vector<GLenum> _all; ///< empty if there are not several.
};

/// True in a core profile, which has neither OpenGL's matrices and lights nor what CleanState draws with.
bool isCoreProfile(const osg::State& state);

/// Puts OpenGL's stencil, depth, blending, scissor and colour mask to their defaults and tells osg::State so.
void leaveDefaults(osg::State& state);

/// Switches blending on: what is drawn times `source` is added to what stands times `destination`.
void addBlended(const osg::State& state, GLenum source, GLenum destination);

/// Binds a texture that no osg::Texture knows, and leaves it to osg::State to bind what is needed next. Unit 0 is the active one then.
void bindTexture(osg::State& state, unsigned unit, GLuint texture);
/// Makes its texels, of any contents: one a pixel, looked up as they are. @param texture  0 is made first.
void sizeTexture(osg::State& state, GLuint& texture, GLint format, GLsizei width, GLsizei height);

/// What is neither cut away by the scissor nor by the viewport.
PixelRect pixelsInScissor(const osg::Viewport& viewport);
/// Pixels of a viewport whose centres lie within bounds, and one more on either side.
PixelRect pixelsWithin(const ScreenRect& bounds, const osg::Viewport& viewport);
/// Whole quads of pixels, which OpenGL shades together, as far as they are in view. What is left of the window or below it is no
/// pixel.
PixelRect wholeQuads(const PixelRect& pixels, const osg::Viewport& viewport);

/// Rectangle over the whole viewport; depth in normalised device coordinates, z = atCenter + x·slopeX + y·slopeY.
void drawQuad(osg::State& state, double atCenter = 0.0, double slopeX = 0.0, double slopeY = 0.0);

/// The same with a texture on it. @param low, high  texture coordinates at its lower left and its upper right corner.
void drawTexturedQuad(osg::State& state, const glm::dvec2& low, const glm::dvec2& high, double depth = 0.0);

/// A convex polygon in normalised device coordinates; as drawQuad() if there are no corners.
void drawPolygon(osg::State& state, const std::vector<glm::dvec2>& corners, double depth);

} // namespace gnomon
