// SPDX-License-Identifier: MIT
#include <gnomon/gl/DrawClock.h>

#include <chrono>
#include <ctime>
#include <string>

namespace gnomon {
namespace {

constexpr GLenum timestamp = 0x8E28; // GL_TIMESTAMP

std::string glText(GLenum what) {
    const GLubyte* text = glGetString(what);
    return text ? reinterpret_cast<const char*>(text) : "";
}

double passedMilliseconds() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(now).count();
}

} // namespace

std::string rendererName() { return glText(GL_RENDERER) + ", OpenGL " + glText(GL_VERSION); }

bool drawsByProcessor() {
    const std::string renderer = glText(GL_RENDERER);
    for (const char* name : {"llvmpipe", "softpipe", "SWR", "Software", "SwiftShader"})
        if (renderer.find(name) != std::string::npos) return true;
    return false;
}

double processorMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

/// Mesa's OSMesa has no timer queries, and OSG finds another library's for it: so none are made where the processor draws.
DrawClock::DrawClock(const osg::State& state)
    : _gl(*state.get<osg::GLExtensions>()),
      _processor(drawsByProcessor()),
      _queries(!_processor && _gl.isARBTimerQuerySupported && _gl.glGenQueries && _gl.glQueryCounter &&
               _gl.glGetQueryObjectui64v) {
    if (_queries) _gl.glGenQueries(2, _names);
}

DrawClock::~DrawClock() {
    if (_queries) _gl.glDeleteQueries(2, _names);
}

void DrawClock::start() {
    if (_queries) return _gl.glQueryCounter(_names[0], timestamp);
    glFinish();
    _from = _processor ? processorMilliseconds() : passedMilliseconds();
}

double DrawClock::stop() {
    if (!_queries) {
        glFinish();
        return (_processor ? processorMilliseconds() : passedMilliseconds()) - _from;
    }
    _gl.glQueryCounter(_names[1], timestamp);
    GLuint64 from = 0, to = 0;
    _gl.glGetQueryObjectui64v(_names[0], GL_QUERY_RESULT_ARB, &from);
    _gl.glGetQueryObjectui64v(_names[1], GL_QUERY_RESULT_ARB, &to);
    return to > from ? double(to - from) * 1e-6 : 0.0;
}

} // namespace gnomon
