// SPDX-License-Identifier: MIT
#include "GlErrorCount.h"

#include <string>

namespace gnomon::examples {

struct GlErrorCount::Handler : osg::NotifyHandler {
    explicit Handler(osg::NotifyHandler* next) : after(next) {}
    void notify(osg::NotifySeverity severity, const char* message) override {
        errors += std::string(message).find("detected OpenGL error") != std::string::npos;
        if (after) after->notify(severity, message);
    }
    osg::ref_ptr<osg::NotifyHandler> after;
    int errors = 0;
};

GlErrorCount::GlErrorCount() : _before(osg::getNotifyHandler()), _handler(new Handler(_before)) {
    osg::setNotifyHandler(_handler);
}

GlErrorCount::~GlErrorCount() { osg::setNotifyHandler(_before); }

int GlErrorCount::count() const { return _handler->errors; }

} // namespace gnomon::examples
