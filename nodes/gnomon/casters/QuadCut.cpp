// SPDX-License-Identifier: MIT
#include <gnomon/casters/QuadCut.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/SavedFramebuffers.h>

#include <osg/ContextData>
#include <osg/GLExtensions>

#include <atomic>

namespace gnomon {
namespace {

constexpr GLenum samplesPassed = 0x8914, currentQuery = 0x8865, queryResult = 0x8866;

std::atomic<bool> fromFirst{false};

/// Of a context.
struct QuadCutFound : public osg::Referenced {
    explicit QuadCutFound(unsigned) {}
    bool found = false;
};

/// OpenGL as a few vertices in clip space are drawn under to be counted, without a trace.
class CountingState {
public:
    explicit CountingState(const osg::GLExtensions& gl) : _gl(gl) {
        constexpr GLenum vertexProgram = 0x8620, fragmentProgram = 0x8804;
        glPushAttrib(GL_ALL_ATTRIB_BITS);
        for (const GLenum matrix : {GL_PROJECTION, GL_MODELVIEW}) {
            glMatrixMode(matrix);
            glPushMatrix();
            glLoadIdentity();
        }
        for (const GLenum mode : {GLenum(GL_STENCIL_TEST), GLenum(GL_DEPTH_TEST), GLenum(GL_ALPHA_TEST),
                                  GLenum(GL_CULL_FACE), GLenum(GL_POLYGON_STIPPLE)})
            glDisable(mode);
        if (gl.isVertexProgramSupported) glDisable(vertexProgram);
        if (gl.isFragmentProgramSupported) glDisable(fragmentProgram);
        for (GLenum plane = GL_CLIP_PLANE1; plane <= GL_CLIP_PLANE5; ++plane) glDisable(plane);
        glEnable(GL_CLIP_PLANE0);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDepthMask(GL_FALSE);
        glViewport(0, 0, 4, 4);
        glEnable(GL_SCISSOR_TEST);
        glScissor(2, 2, 1, 1); // its centre is off the corners and on a diagonal
        if (gl.isGlslSupported) gl.glUseProgram(0);
        gl.glGenQueries(1, &_query);
    }
    ~CountingState() {
        _gl.glDeleteQueries(1, &_query);
        if (_gl.isGlslSupported) _gl.glUseProgram(_program);
        for (const GLenum matrix : {GL_MODELVIEW, GL_PROJECTION}) {
            glMatrixMode(matrix);
            glPopMatrix();
        }
        glPopAttrib();
    }
    CountingState(const CountingState&) = delete;
    CountingState& operator=(const CountingState&) = delete;

    /// Whether the middle of a square is seen of which the first corner and the third are high, the others low.
    /// @param side  1: what is high is left; -1: what is low.
    bool isMiddleSeen(double side) const {
        constexpr GLfloat corners[4][3] = {
            {-1.0f, -1.0f, 0.5f}, {1.0f, -1.0f, -0.5f}, {1.0f, 1.0f, 0.5f}, {-1.0f, 1.0f, -0.5f}};
        const GLdouble plane[] = {0.0, 0.0, side, 0.0};
        glClipPlane(GL_CLIP_PLANE0, plane);
        const GLuint list = glGenLists(1); // from a list, as OpenSceneGraph draws
        glNewList(list, GL_COMPILE);
        glBegin(GL_QUADS);
        for (const GLfloat* corner : corners) glVertex3fv(corner);
        glEnd();
        glEndList();
        _gl.glBeginQuery(samplesPassed, _query);
        glCallList(list);
        _gl.glEndQuery(samplesPassed);
        glDeleteLists(list, 1);
        GLuint samples = 0;
        _gl.glGetQueryObjectuiv(_query, queryResult, &samples);
        return samples > 0;
    }

private:
    const osg::GLExtensions& _gl;
    const GLuint _program = _gl.isGlslSupported ? static_cast<GLuint>(glInteger(GL_CURRENT_PROGRAM)) : 0;
    GLuint _query = 0;
};

bool isCounting(const osg::GLExtensions& gl) {
    GLint running = 0;
    gl.glGetQueryiv(samplesPassed, currentQuery, &running);
    return running != 0;
}

} // namespace

bool cutsQuadsFromFirst() { return fromFirst; }

/// Where nothing is seen, as of a window that is covered, the next frame finds it.
void findQuadCut(osg::State& state) {
    bool& found = osg::get<QuadCutFound>(state.getContextID())->found;
    const auto& gl = *state.get<osg::GLExtensions>();
    if (found || !gl.glBeginQuery || !gl.glGetQueryiv || isCoreProfile(state) || isCounting(gl)) return;
    const CountingState counting(gl);
    const bool high = counting.isMiddleSeen(1.0), low = counting.isMiddleSeen(-1.0);
    found = high != low;
    if (found) fromFirst = high;
}

} // namespace gnomon
