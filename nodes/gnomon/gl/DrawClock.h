// SPDX-License-Identifier: MIT
#pragma once
#include <osg/GLExtensions>
#include <osg/State>

namespace gnomon {

/// What OpenGL calls the renderer that is current, and its version, in one line.
std::string rendererName();
/// True if the renderer that is current draws by the processor.
bool drawsByProcessor();

/// How long the commands between start() and stop() take: by timer queries on a graphics processor, else by processor time.
///
/// Cost   it waits until OpenGL has done all of them: for frames that are measured now and then.
/// Needs  a current context. Without ARB_timer_query it takes the time that passes.
class DrawClock {
public:
    explicit DrawClock(const osg::State& state);
    ~DrawClock();
    DrawClock(const DrawClock&) = delete;
    DrawClock& operator=(const DrawClock&) = delete;

    void start();
    /// Milliseconds since start().
    double stop();

private:
    const osg::GLExtensions& _gl;
    const bool _processor, _queries;
    GLuint _names[2] = {0, 0};
    double _from = 0.0;
};

/// Milliseconds of processor time, of all threads of the program.
double processorMilliseconds();

} // namespace gnomon
