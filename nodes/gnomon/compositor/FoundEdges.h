// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/ShadowJob.h>

#include <osg/GLObjects>

namespace gnomon {

/// The textures of a context's FoundEdges, kept from frame to frame and for as long as the context lives.
///
/// Threads one a context.
class EdgeTextures : public osg::GraphicsObjectManager {
public:
    explicit EdgeTextures(unsigned context) : osg::GraphicsObjectManager("gnomon::EdgeTextures", context) {}

    /// At least of that size.
    void fit(osg::State& state, GLsizei width, GLsizei height);
    GLuint marks() const { return _names[0]; }
    GLuint cuts() const { return _names[1]; }
    GLuint stencil() const { return _stencil; } ///< a renderbuffer.

    bool empty() const { return !_stencil; }

    void flushDeletedGLObjects(double, double&) override {}
    void flushAllDeletedGLObjects() override {}
    void deleteAllGLObjects() override;
    void discardAllGLObjects() override;

protected:
    ~EdgeTextures() override = default;

private:
    GLuint _names[2] = {0, 0};
    GLuint _stencil = 0;
    GLsizei _width = 0, _height = 0;
};

/// True if edges can be found in the framebuffer that is bound: neighbours are of the same picture, and all of a pixel is as its middle.
/// Several samples make edges as smooth as they are. Call where no state set is on the stack.
bool canFindEdges(osg::State& state);

/// Where the marks of a job that finds edges end within pixels. Those that were found last in a context hold.
///
/// Needs   framebuffer objects, alpha.
/// Threads one a context; contexts that share objects draw one after the other.
class FoundEdges {
public:
    /// Draws the marks, and finds their edges. Alpha is anything afterwards where something stands.
    /// @param bit  of the stencil, 0 before and after.
    FoundEdges(const CompositorStage& draw, const ShadowJob& job, unsigned bit);

    /// As Mark::draw(), of Kind::Fades.
    std::string draw(ScreenPass& screen) const;

private:
    const ShadowJob& _job;
    EdgeTextures& _textures;
};

} // namespace gnomon
