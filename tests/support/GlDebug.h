// SPDX-License-Identifier: MIT
#pragma once
#include <osg/GraphicsContext>

namespace test {

/// A message of KHR_debug.
struct GlMessage {
    bool error = false;   ///< OpenGL's: a call was refused.
    bool serious = false; ///< of high or medium severity.
    const char* text = "";
};
using GlListener = void (*)(const GlMessage& message, void* user);

/// Has a context, which exists, tell all that OpenGL has to say to `listener`, in the call that it is about.
/// @throws std::runtime_error if this OpenGL has no KHR_debug.
void listenToGl(osg::GraphicsContext& context, GlListener listener, void* user);

void stopListeningToGl(osg::GraphicsContext& context);

/// Where `./check drivers` runs the tests: a case fails by each error and each serious message, unless it listens itself.
void failBySeriousGlMessages(osg::GraphicsContext& context);

} // namespace test
