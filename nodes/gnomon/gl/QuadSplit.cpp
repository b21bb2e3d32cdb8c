// SPDX-License-Identifier: MIT
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/PlainPixels.h>
#include <gnomon/gl/QuadSplit.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osg/GLExtensions>

#include <map>
#include <mutex>
#include <optional>

namespace gnomon {
namespace {

constexpr GLsizei side = 8; // pixels

/// By context. A driver does not change while a process runs, so that no entry is ever wrong.
class KnownSplits {
public:
    std::optional<QuadSplit> find(unsigned context) const {
        const std::lock_guard<std::mutex> lock(_mutex);
        const auto found = _splits.find(context);
        return found == _splits.end() ? std::nullopt : std::optional(found->second);
    }
    void add(unsigned context, const QuadSplit& split) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _splits[context] = split;
    }

private:
    mutable std::mutex _mutex;
    std::map<unsigned, QuadSplit> _splits;
};

KnownSplits& knownSplits() {
    static KnownSplits splits;
    return splits;
}

/// OpenGL as a few vertices in clip space are drawn under, for their depths alone; put back at its end.
class DepthOnlyState {
public:
    explicit DepthOnlyState(const osg::GLExtensions& gl) : _gl(gl) {
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        for (const GLenum matrix : {GL_PROJECTION, GL_MODELVIEW}) {
            glMatrixMode(matrix);
            glPushMatrix();
            glLoadIdentity();
        }
        for (const GLenum mode : {GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_ALPHA_TEST, GL_CULL_FACE, GL_POLYGON_OFFSET_FILL,
                                  GL_POLYGON_STIPPLE, GL_LIGHTING})
            glDisable(mode);
        for (GLenum plane = GL_CLIP_PLANE0; plane <= GL_CLIP_PLANE5; ++plane) glDisable(plane);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glViewport(0, 0, side, side);
        if (_gl.isGlslSupported) _gl.glUseProgram(0);
    }
    ~DepthOnlyState() {
        if (_gl.isGlslSupported) _gl.glUseProgram(_program);
        for (const GLenum matrix : {GL_MODELVIEW, GL_PROJECTION}) {
            glMatrixMode(matrix);
            glPopMatrix();
        }
        glPopAttrib();
    }
    DepthOnlyState(const DepthOnlyState&) = delete;
    DepthOnlyState& operator=(const DepthOnlyState&) = delete;

private:
    const osg::GLExtensions& _gl;
    const GLuint _program = _gl.isGlslSupported ? static_cast<GLuint>(glInteger(GL_CURRENT_PROGRAM)) : 0;
};

/// Depths to draw to, gone at its end.
class DepthBuffer {
public:
    explicit DepthBuffer(const osg::GLExtensions& gl) : _gl(gl), _framebuffer(gl) {
        gl.glGenRenderbuffers(1, &_name);
        gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, _name);
        gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_DEPTH_COMPONENT24, side, side);
        _framebuffer.attachDepth(_name);
    }
    ~DepthBuffer() { _gl.glDeleteRenderbuffers(1, &_name); }
    DepthBuffer(const DepthBuffer&) = delete;
    DepthBuffer& operator=(const DepthBuffer&) = delete;

    bool isComplete() const { return _framebuffer.isComplete(); }

private:
    const osg::GLExtensions& _gl;
    const ScratchFramebuffer _framebuffer;
    GLuint _name = 0;
};

constexpr GLfloat corners[4][3] = {
    {-1.0f, -1.0f, -0.5f}, {1.0f, -1.0f, 0.5f}, {1.0f, 1.0f, -0.5f}, {-1.0f, 1.0f, 0.5f}};

/// A square whose first corner and the one across from it are near, the other two far.
void drawQuad() {
    for (const GLfloat* corner : corners) glVertex3fv(corner);
}
void drawStrip() {
    for (const int corner : {0, 1, 3, 2}) glVertex3fv(corners[corner]);
}

void draw(GLenum mode, void (*vertices)()) {
    glBegin(mode);
    vertices();
    glEnd();
}

void drawFromList(GLenum mode, void (*vertices)()) {
    const GLuint list = glGenLists(1);
    glNewList(list, GL_COMPILE);
    draw(mode, vertices);
    glEndList();
    glCallList(list);
    glDeleteLists(list, 1);
}

/// True if the square drawn last is far in its middle: cut along the far corners.
bool isFarInTheMiddle() {
    GLfloat depth = 0.0f;
    glReadPixels(side / 2, side / 2 - 1, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    return depth > 0.5f;
}

QuadSplit find(const osg::State& state) {
    const auto& gl = *state.get<osg::GLExtensions>();
    QuadSplit found;
    if (!gl.isFrameBufferObjectSupported || isCoreProfile(state)) return found;
    const DepthOnlyState plain(gl);
    const PlainPixels pixels(state);
    const DepthBuffer depths(gl);
    if (!depths.isComplete()) return found;
    drawFromList(GL_QUADS, drawQuad);
    found.secondToFourth = isFarInTheMiddle();
    draw(GL_QUADS, drawQuad);
    found.arraysSecondToFourth = isFarInTheMiddle();
    draw(GL_QUAD_STRIP, drawStrip);
    found.stripSecondToThird = isFarInTheMiddle();
    return found;
}

/// As osg::Drawable::draw() decides.
QuadSplit withLists(QuadSplit split, const osg::State& state) {
    split.lists = !state.useVertexBufferObject(false) && !state.useVertexArrayObject(false);
    return split;
}

} // namespace

QuadSplit foundQuadSplit(osg::State& state) {
    if (const std::optional<QuadSplit> known = knownSplits().find(state.getContextID()))
        return withLists(*known, state);
    const QuadSplit found = find(state);
    knownSplits().add(state.getContextID(), found);
    return withLists(found, state);
}

QuadSplit knownQuadSplit(const osg::State& state) {
    return withLists(knownSplits().find(state.getContextID()).value_or(QuadSplit()), state);
}

} // namespace gnomon
