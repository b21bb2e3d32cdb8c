// SPDX-License-Identifier: MIT
#include <gnomon/OptionalParts.h>
#include <gnomon/auto/SelfTest.h>
#include <gnomon/geometry/ConvexHull.h>
#include <gnomon/gl/DrawClock.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osg/Geometry>
#include <osg/State>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace gnomon {
namespace {

constexpr GLsizei side = 256;    // pixels
constexpr unsigned dense = 100;  // of a side of the mesh: triangles of three pixels, as dense casters have
constexpr int draws = 64;        // in a row
constexpr double enough = 4.0;   // ms
constexpr double tooLong = 25.0; // ms: a slow renderer is not asked twice
constexpr int rounds = 3;        // the fastest counts
constexpr double pixels = double(side) * side, triangles = 2.0 * dense * dense;

/// What a unit takes where the defaults of CostRates hold, milliseconds: as CostRatios has them.
constexpr CostRatios reference = {0.15, 1.1e-4, 1.25e-6, 6e-6, 2e-4, 1.7e-6, 6.5e-2};

/// @param cells  of a side.
osg::ref_ptr<osg::Geometry> makeMesh(unsigned cells) {
    const auto place = [cells](unsigned step) { return 2.0f * float(step) / float(cells) - 1.0f; };
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned y = 0; y <= cells; ++y)
        for (unsigned x = 0; x <= cells; ++x) vertices->push_back({place(x), place(y), 0.0f});
    for (unsigned y = 0; y < cells; ++y)
        for (unsigned x = 0; x < cells; ++x) {
            const unsigned at = y * (cells + 1) + x;
            for (const unsigned corner : {0u, 1u, cells + 2, 0u, cells + 2, cells + 1}) indices->push_back(at + corner);
        }
    osg::ref_ptr<osg::Geometry> mesh = new osg::Geometry;
    mesh->setVertexArray(vertices);
    mesh->addPrimitiveSet(indices);
    mesh->setUseDisplayList(false);
    mesh->setUseVertexBufferObjects(true);
    return mesh;
}

/// Colours, depths and stencil to draw to, and a texture to read.
class Target {
public:
    explicit Target(const osg::GLExtensions& gl) : _gl(gl), _framebuffer(gl) {
        gl.glGenRenderbuffers(2, _buffers);
        add(_buffers[0], GL_RGBA8, {GL_COLOR_ATTACHMENT0_EXT});
        add(_buffers[1], GL_DEPTH24_STENCIL8_EXT, {GL_DEPTH_ATTACHMENT_EXT, GL_STENCIL_ATTACHMENT_EXT});
        const GLint before = glInteger(GL_TEXTURE_BINDING_2D);
        glGenTextures(1, &_texture);
        glBindTexture(GL_TEXTURE_2D, _texture);
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, side, side, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
    }
    ~Target() {
        glDeleteTextures(1, &_texture);
        _gl.glDeleteRenderbuffers(2, _buffers);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    bool isComplete() const { return _framebuffer.isComplete(); }
    GLuint texture() const { return _texture; }

private:
    void add(GLuint buffer, GLenum format, std::initializer_list<GLenum> places) const {
        _gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffer);
        _gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, format, side, side);
        for (const GLenum place : places)
            _gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, place, GL_RENDERBUFFER_EXT, buffer);
    }

    const osg::GLExtensions& _gl;
    const ScratchFramebuffer _framebuffer;
    GLuint _buffers[2] = {0, 0}, _texture = 0;
};

/// The pieces of work, each drawn once by a call.
class Pieces {
public:
    Pieces(osg::RenderInfo& renderInfo, const Target& target)
        : _renderInfo(renderInfo),
          _state(*renderInfo.getState()),
          _target(target),
          _mesh(makeMesh(dense)),
          _quad(makeMesh(1)) {}
    ~Pieces() {
        _mesh->releaseGLObjects(&_state);
        _quad->releaseGLObjects(&_state);
    }
    Pieces(const Pieces&) = delete;
    Pieces& operator=(const Pieces&) = delete;

    void call() {
        glEnable(GL_STENCIL_TEST);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, 1, 1);
        for (int i = 0; i < draws; ++i) {
            glStencilFunc(GL_ALWAYS, i & 1, ~0u);
            draw(*_quad);
        }
    }
    void triangle() {
        writeDepth();
        draw(*_mesh);
    }
    void texel() {
        writeDepth();
        glClear(GL_DEPTH_BUFFER_BIT);
        drawQuad(_state);
    }
    void relit() {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glEnable(GL_LIGHTING);
        glEnable(GL_LIGHT0);
        draw(*_mesh);
        glDisable(GL_LIGHT0);
        glDisable(GL_LIGHTING);
    }
    void filled() {
        addBlended(_state, GL_ONE, GL_ONE);
        drawQuad(_state);
    }
    void tap() {
        const GLint before = glInteger(GL_TEXTURE_BINDING_2D);
        glBindTexture(GL_TEXTURE_2D, _target.texture());
        glEnable(GL_TEXTURE_2D);
        drawQuad(_state);
        glDisable(GL_TEXTURE_2D);
        glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
    }

private:
    static void writeDepth() {
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
    }
    void draw(const osg::Geometry& mesh) {
        _state.applyProjectionMatrix(nullptr);
        _state.applyModelViewMatrix(nullptr);
        mesh.draw(_renderInfo);
    }

    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    const Target& _target;
    const osg::ref_ptr<osg::Geometry> _mesh, _quad;
};

/// Milliseconds that a piece takes, `once` of them at the first time.
template <class Once, class Many>
double timeOf(const Once& once, const Many& many) {
    const double first = once();
    if (first > tooLong) return first;
    const int count = std::clamp(int(enough / std::max(first, 1e-3)), 1, 256);
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) best = std::min(best, many(count) / count);
    return best;
}

double drawn(osg::State& state, Pieces& pieces, void (Pieces::*piece)()) {
    DrawClock clock(state);
    const auto many = [&](int count) {
        clock.start();
        for (int i = 0; i < count; ++i) (pieces.*piece)();
        const double time = clock.stop();
        leaveDefaults(state);
        return time;
    };
    many(1); // programs and buffers are made
    return timeOf([&] { return many(1); }, many);
}

double threadMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

/// What the processor does by itself: geometry in double precision, as in everything that it finds for shadows.
double reckoned() {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 64; ++i) points.emplace_back(std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 3.1 + 1.0));
    const auto many = [&](int count) {
        const double from = threadMilliseconds();
        for (int i = 0; i < count; ++i) convexHull(points);
        return threadMilliseconds() - from;
    };
    return timeOf([&] { return many(1); }, many);
}

} // namespace

std::optional<CostRatios> measureCosts(osg::RenderInfo& renderInfo) {
    osg::State& state = *renderInfo.getState();
    const osg::GLExtensions& gl = *state.get<osg::GLExtensions>();
    if (!gl.isFrameBufferObjectSupported || !gl.glGenFramebuffers) return std::nullopt;
    const unsigned unit = state.getActiveTextureUnit();
    const osg::Viewport* const before = state.getCurrentViewport();
    GLint scissor[4];
    glGetIntegerv(GL_SCISSOR_BOX, scissor);
    std::optional<CostRatios> result;
    {
        const Target target(gl);
        if (!target.isComplete()) return std::nullopt;
        const osg::ref_ptr<osg::Viewport> viewport = new osg::Viewport(0, 0, side, side);
        const CleanState clean(state, viewport);
        state.setActiveTextureUnit(0);
        leaveDefaults(state);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        Pieces pieces(renderInfo, target);
        const auto ratio = [&](void (Pieces::*piece)(), double units, double byReference) {
            return drawn(state, pieces, piece) / units / byReference;
        };
        result.emplace();
        result->triangle = ratio(&Pieces::triangle, triangles, reference.triangle);
        result->texel = ratio(&Pieces::texel, pixels, reference.texel);
        result->tap = ratio(&Pieces::tap, pixels, reference.tap);
        result->relit = ratio(&Pieces::relit, triangles, reference.relit);
        result->filled = ratio(&Pieces::filled, pixels, reference.filled);
        result->processor = hasPart(OptionalPart::Terrain) ? reckoned() / reference.processor : 1.0;
        // On llvmpipe the same calls take forty times as long in some contexts as in others, but they are the processor's.
        result->call = drawsByProcessor() ? result->processor : ratio(&Pieces::call, draws, reference.call);
    }
    state.setActiveTextureUnit(unit);
    if (before)
        state.applyAttribute(before); // osg::State must not remember the test's own, which is gone
    else
        state.haveAppliedAttribute(osg::StateAttribute::VIEWPORT);
    leaveDefaults(state);
    glScissor(scissor[0], scissor[1], scissor[2], scissor[3]);
    return result->clamped();
}

} // namespace gnomon
