// SPDX-License-Identifier: MIT
#include <gnomon/auto/TimeKeeper.h>
#include <gnomon/base/NumberText.h>

#include <OpenThreads/ScopedLock>

#include <algorithm>
#include <initializer_list>
#include <string>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr GLenum timeElapsed = 0x88BF, counterBits = 0x8864, currentQuery = 0x8865;
constexpr std::size_t mostPending = 8; // frames that a renderer may lag behind

std::string rendererName() {
    const GLubyte* text = glGetString(GL_RENDERER);
    return text ? reinterpret_cast<const char*>(text) : "";
}

bool hasName(const std::string& renderer, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

/// llvmpipe draws after the query has ended: it tells some microseconds, whatever is drawn.
bool hasQueries(const osg::GLExtensions& gl) {
    if (!gl.glGetQueryiv || !gl.glGenQueries || !gl.glGetQueryObjectuiv || hasName(rendererName(), {"llvmpipe"}))
        return false;
    GLint bits = 0;
    gl.glGetQueryiv(timeElapsed, counterBits, &bits);
    while (glGetError() != GL_NO_ERROR) bits = 0;
    return bits > 0;
}

/// A program that measures by itself, as osgViewer's statistics do, goes first.
bool isOtherRunning(const osg::GLExtensions& gl) {
    GLint running = 0;
    gl.glGetQueryiv(timeElapsed, currentQuery, &running);
    return running != 0;
}

} // namespace

Renderer currentRenderer() {
    const std::string renderer = rendererName();
    if (renderer.empty()) return Renderer::Unknown;
    const bool processor = hasName(renderer, {"llvmpipe", "softpipe", "SWR", "Software", "SwiftShader"});
    return processor ? Renderer::Processor : Renderer::Graphics;
}

double TimeKeeper::error() const {
    Lock lock(_mutex);
    return _control.error();
}

std::string TimeKeeper::whyNot() const {
    Lock lock(_mutex);
    if (!_works)
        return "this renderer does not tell how long shadows take, so the time that is set has no effect. Set an "
               "error: it is " +
               textOf(_control.error()) + " pixels now.";
    if (_control.isTooSlow())
        return "even with an error of " + textOf(_control.error()) + " pixels, shadows take longer than " +
               textOf(time) + " ms. Allow more time.";
    return {};
}

void TimeKeeper::begin(osg::RenderInfo& renderInfo) {
    if (_renderer->value == Renderer::Unknown) _renderer->value = currentRenderer();
    if (!(time > 0.0)) return;
    const auto& gl = *renderInfo.getState()->get<osg::GLExtensions>();
    Lock lock(_mutex);
    const auto [known, isNew] = _queries.try_emplace(renderInfo.getContextID());
    Queries& queries = known->second;
    if (isNew && _works) _works = hasQueries(gl);
    if (!_works) return;
    read(queries, gl);
    if (queries.pending.size() >= mostPending || isOtherRunning(gl)) return;
    if (queries.unused.empty()) gl.glGenQueries(1, &queries.unused.emplace_back());
    gl.glBeginQuery(timeElapsed, queries.unused.back());
    queries.running = true;
}

void TimeKeeper::end(osg::RenderInfo& renderInfo) {
    Lock lock(_mutex);
    const auto known = _queries.find(renderInfo.getContextID());
    if (known == _queries.end() || !known->second.running) return;
    Queries& queries = known->second;
    renderInfo.getState()->get<osg::GLExtensions>()->glEndQuery(timeElapsed);
    queries.running = false;
    queries.pending.push_back(queries.unused.back());
    queries.unused.pop_back();
}

void TimeKeeper::read(Queries& queries, const osg::GLExtensions& gl) {
    for (GLuint isThere = 1; !queries.pending.empty();) {
        gl.glGetQueryObjectuiv(queries.pending.front(), GL_QUERY_RESULT_AVAILABLE_ARB, &isThere);
        if (!isThere) return;
        GLuint nanoseconds = 0;
        gl.glGetQueryObjectuiv(queries.pending.front(), GL_QUERY_RESULT_ARB, &nanoseconds);
        queries.unused.push_back(queries.pending.front());
        queries.pending.pop_front();
        _control.add(1e-6 * nanoseconds, time);
    }
}

void TimeKeeper::releaseGLObjects(osg::State* state) {
    Lock lock(_mutex);
    if (!state) return _queries.clear(); // the contexts are gone, or go
    const auto known = _queries.find(state->getContextID());
    if (known == _queries.end()) return;
    std::vector<GLuint>& names = known->second.unused;
    names.insert(names.end(), known->second.pending.begin(), known->second.pending.end());
    if (!names.empty()) state->get<osg::GLExtensions>()->glDeleteQueries(GLsizei(names.size()), names.data());
    _queries.erase(known);
}

} // namespace gnomon
