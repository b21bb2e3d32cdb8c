// SPDX-License-Identifier: MIT
#include "GlComplaints.h"

#include <osg/State>
#include <support/GlDebug.h>

namespace test {

struct GlComplaints::Log {
    static void keep(const GlMessage& message, void* log) {
        if (message.error) static_cast<Log*>(log)->lines.push_back(message.text);
    }
    std::vector<std::string> lines;
};

GlComplaints::GlComplaints(Camera& camera) : _log(std::make_unique<Log>()), _camera(camera) {
    osg::GraphicsContext& context = *camera.context().graphicsContext();
    listenToGl(context, Log::keep, _log.get());
    context.getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS); // it would take them from glGetError
}

GlComplaints::~GlComplaints() { stopListeningToGl(*_camera.context().graphicsContext()); }

std::vector<std::string> GlComplaints::all() const {
    osg::GraphicsContext& context = *_camera.context().graphicsContext();
    context.makeCurrent();
    std::vector<std::string> lines = _log->lines;
    while (const GLenum error = glGetError()) lines.push_back("error " + std::to_string(error));
    return lines;
}

} // namespace test
