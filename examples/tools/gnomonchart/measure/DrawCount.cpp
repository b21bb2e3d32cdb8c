// SPDX-License-Identifier: MIT
#include "Race.h"

#include <GL/gl.h>

#include <atomic>
#include <dlfcn.h>

namespace gnomon::examples {
namespace {

std::atomic<std::size_t> calls{0};
thread_local bool compiling = false;

void add(std::size_t more) {
    if (!compiling) calls += more;
}

/// OpenGL's own function of this name: the next library's that has it.
template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

std::size_t drawCalls() { return calls; }

} // namespace gnomon::examples

using gnomon::examples::add;
using gnomon::examples::compiling;
using gnomon::examples::next;

extern "C" {

void glNewList(GLuint list, GLenum mode) {
    static const auto real = next<void (*)(GLuint, GLenum)>("glNewList");
    compiling = mode == GL_COMPILE;
    real(list, mode);
}

void glEndList() {
    static const auto real = next<void (*)()>("glEndList");
    compiling = false;
    real();
}

void glCallList(GLuint list) {
    static const auto real = next<void (*)(GLuint)>("glCallList");
    add(1);
    real(list);
}

void glBegin(GLenum mode) {
    static const auto real = next<void (*)(GLenum)>("glBegin");
    add(1);
    real(mode);
}

void glRecti(GLint left, GLint low, GLint right, GLint top) {
    static const auto real = next<void (*)(GLint, GLint, GLint, GLint)>("glRecti");
    add(1);
    real(left, low, right, top);
}

void glBitmap(GLsizei width, GLsizei height, GLfloat x, GLfloat y, GLfloat right, GLfloat up, const GLubyte* bits) {
    static const auto real =
        next<void (*)(GLsizei, GLsizei, GLfloat, GLfloat, GLfloat, GLfloat, const GLubyte*)>("glBitmap");
    add(width > 0 && height > 0 ? 1 : 0); // an empty one moves the raster position
    real(width, height, x, y, right, up, bits);
}

void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    static const auto real = next<void (*)(GLenum, GLint, GLsizei)>("glDrawArrays");
    add(1);
    real(mode, first, count);
}

void glDrawElements(GLenum mode, GLsizei count, GLenum type, const GLvoid* indices) {
    static const auto real = next<void (*)(GLenum, GLsizei, GLenum, const GLvoid*)>("glDrawElements");
    add(1);
    real(mode, count, type, indices);
}

void glMultiDrawArrays(GLenum mode, const GLint* first, const GLsizei* count, GLsizei draws) {
    static const auto real = next<void (*)(GLenum, const GLint*, const GLsizei*, GLsizei)>("glMultiDrawArrays");
    add(static_cast<std::size_t>(draws));
    real(mode, first, count, draws);
}

void glMultiDrawElements(GLenum mode, const GLsizei* count, GLenum type, const GLvoid* const* indices, GLsizei draws) {
    static const auto real =
        next<void (*)(GLenum, const GLsizei*, GLenum, const GLvoid* const*, GLsizei)>("glMultiDrawElements");
    add(static_cast<std::size_t>(draws));
    real(mode, count, type, indices, draws);
}

} // extern "C"
