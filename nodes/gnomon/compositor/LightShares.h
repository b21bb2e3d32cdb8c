// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/StencilMarks.h>

#include <osg/GLObjects>

#include <vector>

namespace gnomon {

/// The textures of a context's LightShares, kept from frame to frame and for as long as the context lives.
///
/// Threads one a context.
class ShareTextures : public osg::GraphicsObjectManager {
public:
    explicit ShareTextures(unsigned context) : osg::GraphicsObjectManager("gnomon::ShareTextures", context) {}

    /// So many, at least of that size; of 16 bits where the framebuffer that is drawn to has more than 8.
    void fit(osg::State& state, std::size_t count, GLsizei width, GLsizei height);
    GLuint operator[](std::size_t i) const { return _names[i]; }
    GLsizei width() const { return _width; }
    GLsizei height() const { return _height; }

    bool empty() const { return _names.empty(); }

    void flushDeletedGLObjects(double, double&) override {}
    void flushAllDeletedGLObjects() override {}
    void deleteAllGLObjects() override;
    void discardAllGLObjects() override;

protected:
    ~ShareTextures() override = default;

private:
    std::vector<GLuint> _names;
    GLsizei _width = 0, _height = 0;
    GLint _format = 0;
};

/// What share of a light arrives by all its jobs that fade, the least that one of them lets through, a pixel one, whatever its
/// samples: looked up once, into textures of the kit's own, however often it is asked for. In them no depth stands, and what
/// arrives where nothing stands is anything.
///
/// Needs   framebuffer objects.
/// Threads one a context; contexts that share objects draw one after the other.
class LightShares {
public:
    /// Draws the marks.
    /// @param draw    must outlive this, as must the jobs.
    /// @param lights  the jobs of each, one or more.
    /// @param bit     see FoundEdges, as which alpha is used.
    LightShares(const CompositorStage& draw, std::vector<Jobs> lights, unsigned bit);

    /// Sets `bit` where not all of the job's light arrives and something stands, within the job's bounds.
    void mark(const ShadowJob& job, unsigned bit) const;
    /// Multiplies alpha by the share of the job's light that arrives, or by the one that does not.
    void multiplyAlpha(const ShadowJob& job, bool blocked, ScreenPass& screen) const;

private:
    void begin(const Jobs& light, GLuint texture) const;
    void look(const ShadowJob& job, unsigned bit, GLuint texture) const;
    void drawTexture(const ShadowJob& job, ScreenPass& screen) const;

    const CompositorStage& _draw;
    const std::vector<Jobs> _lights;
    ShareTextures& _textures;
};

} // namespace gnomon
