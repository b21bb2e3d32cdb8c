// SPDX-License-Identifier: MIT
#include "GlComplaints.h"

#include <osg/GLExtensions>
#include <osg/State>

#include <stdexcept>

#ifndef APIENTRY
#define APIENTRY
#endif

namespace test {
namespace {

constexpr GLenum debugOutput = 0x92E0, debugOutputSynchronous = 0x8242, typeError = 0x824C;

using Callback = void(APIENTRY*)(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* user);
using SetCallback = void(APIENTRY*)(Callback callback, const void* user);

void APIENTRY keep(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message, const void* user) {
    if (type == typeError)
        const_cast<std::vector<std::string>*>(static_cast<const std::vector<std::string>*>(user))->push_back(message);
}

} // namespace

struct GlComplaints::Log {
    std::vector<std::string> lines;
};

GlComplaints::GlComplaints(Camera& camera) : _log(std::make_unique<Log>()), _camera(camera) {
    osg::GraphicsContext& context = *camera.context().graphicsContext();
    context.realize();
    context.makeCurrent();
    SetCallback setCallback = nullptr;
    if (!osg::setGLExtensionFuncPtr(setCallback, "glDebugMessageCallback", "glDebugMessageCallbackKHR"))
        throw std::runtime_error("this OpenGL has no KHR_debug");
    glEnable(debugOutput);
    glEnable(debugOutputSynchronous);
    setCallback(keep, &_log->lines);
    context.getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS); // it would take them from glGetError
    context.releaseContext();
}

GlComplaints::~GlComplaints() {
    osg::GraphicsContext& context = *_camera.context().graphicsContext();
    context.makeCurrent();
    glDisable(debugOutput);
    context.releaseContext();
}

std::vector<std::string> GlComplaints::all() const {
    osg::GraphicsContext& context = *_camera.context().graphicsContext();
    context.makeCurrent();
    std::vector<std::string> lines = _log->lines;
    while (const GLenum error = glGetError()) lines.push_back("error " + std::to_string(error));
    return lines;
}

} // namespace test
