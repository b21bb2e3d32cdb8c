// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/choice/CandidateChoice.h>
#include <gnomon/compositor/ShadowJob.h>

#include <OpenThreads/Mutex>
#include <osg/GLExtensions>
#include <osg/State>

#include <atomic>
#include <deque>
#include <map>
#include <vector>

namespace gnomon {

/// Who draws, as far as that is known.
enum class Renderer { Unknown, Processor, Graphics };

/// The renderer that is current, by its name.
Renderer currentRenderer();

/// The same, once a view has drawn.
struct RendererFact : public osg::Referenced {
    std::atomic<Renderer> value{Renderer::Unknown};
};

/// What work costs there. Where nobody knows, a graphics processor draws.
inline const CostRates& ratesOf(Renderer renderer) {
    return renderer == Renderer::Processor ? processorRates : graphicsRates;
}

/// Finds the error that keeps the shadows of a view to a time, by timer queries. They are read in later frames, so that
/// nothing waits for OpenGL. Without a time it only asks who draws.
///
/// Threads
/// - Any number. Cull asks, draw tells.
class TimeKeeper : public DrawWatch {
public:
    /// @param time     milliseconds; 0: none.
    /// @param control  its first error. @param renderer  is told.
    TimeKeeper(double time, const ErrorControl& control, RendererFact& renderer)
        : time(time), _control(control), _renderer(&renderer) {}

    /// Pixels.
    double error() const;
    /// Why the time is not kept, as a cause for ShadowTechnique::report(); empty if it is.
    std::string whyNot() const;
    void releaseGLObjects(osg::State* state);

    void begin(osg::RenderInfo& renderInfo) override;
    void end(osg::RenderInfo& renderInfo) override;

    const double time;

protected:
    ~TimeKeeper() override = default;

private:
    /// Of one context.
    struct Queries {
        std::vector<GLuint> unused;
        std::deque<GLuint> pending; ///< the oldest first.
        bool running = false;
    };
    void read(Queries& queries, const osg::GLExtensions& gl);

    mutable OpenThreads::Mutex _mutex;
    ErrorControl _control;
    std::map<unsigned, Queries> _queries; ///< by context.
    bool _works = true;                   ///< the renderer has timer queries.
    const osg::ref_ptr<RendererFact> _renderer;
};

} // namespace gnomon
