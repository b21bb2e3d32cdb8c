// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Notify>

namespace gnomon::examples {

/// Counts OpenGL's errors, of which OpenSceneGraph warns, while it lives. All messages go where they went.
class GlErrorCount {
public:
    GlErrorCount();
    ~GlErrorCount();
    GlErrorCount(const GlErrorCount&) = delete;
    GlErrorCount& operator=(const GlErrorCount&) = delete;

    int count() const;

private:
    struct Handler;
    osg::ref_ptr<osg::NotifyHandler> _before;
    osg::ref_ptr<Handler> _handler;
};

} // namespace gnomon::examples
