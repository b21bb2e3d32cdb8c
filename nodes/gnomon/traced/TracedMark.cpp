// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/gl/PlainPixels.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/traced/TracedMark.h>

#include <osg/State>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// What the marks' bounds leave, at which the scissor stands.
DepthPicture partInScissor(const osg::Viewport& viewport) {
    const PixelRect pixels = pixelsInScissor(viewport);
    DepthPicture part;
    part.viewportWidth = static_cast<int>(viewport.width());
    part.viewportHeight = static_cast<int>(viewport.height());
    part.x = pixels.x - static_cast<int>(viewport.x());
    part.y = pixels.y - static_cast<int>(viewport.y());
    part.width = pixels.width;
    part.height = pixels.height;
    return part;
}

/// @return false if this framebuffer's depth cannot be read.
bool readDepth(osg::State& state, ResolvedDepth& resolved, DepthPicture& part) {
    const osg::Viewport& viewport = *state.getCurrentViewport();
    const GLint x = part.x + static_cast<GLint>(viewport.x()), y = part.y + static_cast<GLint>(viewport.y());
    part.depths.resize(std::size_t(part.width) * std::size_t(part.height));
    part.step = std::ldexp(1.0, -std::min(glInteger(GL_DEPTH_BITS), 24));
    part.subpixel = std::ldexp(1.0, -std::clamp(glInteger(GL_SUBPIXEL_BITS), 4, 16));
    const auto read = [&] {
        glReadPixels(x, y, part.width, part.height, GL_DEPTH_COMPONENT, GL_FLOAT, part.depths.data());
    };
    if (ResolvedDepth::isNeeded(state)) {
        const auto place = resolved.read(state, x, y, part.width, part.height, read);
        part.place = place.value_or(part.place);
        return place.has_value();
    }
    part.offPlace = glInteger(GL_SAMPLES) > 0 ? 0.5 : 0.0; // whichever sample a window's depth is
    read();
    return true;
}

/// A fragment where a bit is set. The empty bitmap moves the raster position, which no place off the screen may set.
void drawBits(osg::State& state, const DepthPicture& part, const std::vector<std::uint8_t>& bits) {
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glRasterPos2d(-1.0, -1.0);
    glBitmap(0, 0, 0.0f, 0.0f, static_cast<GLfloat>(part.x), static_cast<GLfloat>(part.y), nullptr);
    glBitmap(part.width, part.height, 0.0f, 0.0f, 0.0f, 0.0f, bits.data());
}

/// The same as rectangles, one for each run of bits in a row: of glBitmap Mesa's llvmpipe (22.3) takes one sample only.
void drawRuns(osg::State& state, const DepthPicture& part, const std::vector<std::uint8_t>& bits) {
    const osg::ref_ptr<osg::RefMatrix> pixels =
        new osg::RefMatrix(osg::Matrixd::ortho2D(0.0, part.viewportWidth, 0.0, part.viewportHeight));
    state.applyProjectionMatrix(pixels);
    state.applyModelViewMatrix(nullptr);
    const std::size_t stride = bits.size() / std::size_t(part.height);
    for (int y = 0; y < part.height; ++y) {
        const std::uint8_t* row = bits.data() + stride * std::size_t(y);
        const auto isSet = [row](int x) { return (row[x / 8] & (0x80 >> (x % 8))) != 0; };
        for (int x = 0, first = 0; x < part.width; first = x) {
            const bool set = isSet(first);
            while (x < part.width && isSet(x) == set) ++x;
            if (set) glRecti(part.x + first, part.y + y, part.x + x, part.y + y + 1);
        }
    }
}

} // namespace

std::string TracedMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    if (glInteger(GL_DEPTH_BITS) == 0) return noDepth;
    const PlainPixels plain(state);
    DepthPicture part = partInScissor(*state.getCurrentViewport());
    if (part.width <= 0 || part.height <= 0) return "";
    if (!readDepth(state, *resolved, part)) return unresolvedDepth;
    part.offPlace += pushedBack.x;
    part.step *= 1.0 + pushedBack.y; // of which depthBufferShadow() allows for a few
    const DrawnError drawn = drawnError(frame.clipFromScene, toGlm(state.getProjectionMatrix()), part.viewportWidth,
                                        rounding, frame.scene->longestSide());
    part.drawnDepth = drawn.depth;
    part.drawnPixels = drawn.pixels;
    pass.stencilEqual(bit, 0, bit);
    TracedFrame seen = frame;
    std::vector<float> depths;
    depths.swap(part.depths);
    seen.picture = part;
    seen.picture.depths.swap(depths);
    const std::vector<std::uint8_t> bits = frames->bitsOf(std::move(seen));
    (glInteger(GL_SAMPLES) > 0 ? drawRuns : drawBits)(state, part, bits);
    return "";
}

} // namespace gnomon
