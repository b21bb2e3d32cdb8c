// SPDX-License-Identifier: MIT
#include <support/GlDebug.h>

#include <gtest/gtest.h>
#include <osg/GLExtensions>

#include <cstdlib>
#include <cstring>
#include <list>
#include <stdexcept>

#ifndef APIENTRY
#define APIENTRY
#endif

namespace test {
namespace {

constexpr GLenum debugOutput = 0x92E0, debugOutputSynchronous = 0x8242, typeError = 0x824C;
constexpr GLenum severityHigh = 0x9146, severityMedium = 0x9147;

using Callback = void(APIENTRY*)(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* user);
using SetCallback = void(APIENTRY*)(Callback callback, const void* user);

/// Who listens in a context. A context that is still there may have something to say at any time: none is forgotten.
struct Listening {
    GlListener listener;
    void* user;
};
const Listening& kept(const Listening& listening) {
    static auto& all = *new std::list<Listening>;
    return all.emplace_back(listening);
}

void APIENTRY hear(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void* user) {
    const auto& listening = *static_cast<const Listening*>(user);
    listening.listener({type == typeError, severity == severityHigh || severity == severityMedium, text},
                       listening.user);
}

/// NVIDIA's driver says so whenever a shader is drawn under state that it was not compiled for.
bool isOfState(const GlMessage& message) {
    return std::strstr(message.text, "being recompiled based on GL state") != nullptr;
}

void fail(const GlMessage& message, void*) {
    if (message.error || (message.serious && !isOfState(message))) ADD_FAILURE() << "OpenGL says: " << message.text;
}

} // namespace

void listenToGl(osg::GraphicsContext& context, GlListener listener, void* user) {
    context.realize();
    context.makeCurrent();
    SetCallback setCallback = nullptr;
    if (!osg::setGLExtensionFuncPtr(setCallback, "glDebugMessageCallback", "glDebugMessageCallbackKHR"))
        throw std::runtime_error("this OpenGL has no KHR_debug");
    glEnable(debugOutput);
    glEnable(debugOutputSynchronous);
    setCallback(hear, &kept({listener, user}));
    context.releaseContext();
}

void stopListeningToGl(osg::GraphicsContext& context) {
    context.makeCurrent();
    glDisable(debugOutput);
    context.releaseContext();
}

void failBySeriousGlMessages(osg::GraphicsContext& context) {
    if (std::getenv("GNOMON_TEST_DRIVER")) listenToGl(context, fail, nullptr);
}

} // namespace test
