// SPDX-License-Identifier: MIT
// Windows whose contexts share textures and buffers, and a technique that outlives a context. Mesa shares framebuffer
// objects too, which OpenGL does not: so here a name that another context made means an empty one, as elsewhere.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <osg/FrameBufferObject>
#include <osg/GLExtensions>
#include <osgViewer/GraphicsWindow>

#include <cstring>
#include <map>

using namespace test;

namespace {

EGLDisplay display() {
    static const EGLDisplay display = [] {
        const EGLDisplay found = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        eglInitialize(found, nullptr, nullptr);
        eglBindAPI(EGL_OPENGL_API);
        return found;
    }();
    return display;
}

EGLConfig config() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE,
                             EGL_PBUFFER_BIT,
                             EGL_RENDERABLE_TYPE,
                             EGL_OPENGL_BIT,
                             EGL_ALPHA_SIZE,
                             8,
                             EGL_DEPTH_SIZE,
                             24,
                             EGL_STENCIL_SIZE,
                             8,
                             EGL_NONE};
    EGLConfig result = nullptr;
    EGLint count = 0;
    eglChooseConfig(display(), wanted, &result, 1, &count);
    return result;
}

/// A window in memory that may share its context.
class SharedWindow : public osgViewer::GraphicsWindowEmbedded {
public:
    SharedWindow(const View& view, SharedWindow* with)
        : osgViewer::GraphicsWindowEmbedded(traitsOf(view, with).get()),
          _context(eglCreateContext(display(), config(), with ? with->_context : EGL_NO_CONTEXT, nullptr)) {
        const EGLint size[] = {EGL_WIDTH, view.width, EGL_HEIGHT, view.height, EGL_NONE};
        _surface = eglCreatePbufferSurface(display(), config(), size);
        picture.width = view.width;
        picture.height = view.height;
        picture.pixels.resize(static_cast<std::size_t>(view.width * view.height));
    }

    bool makeCurrentImplementation() override { return eglMakeCurrent(display(), _surface, _surface, _context); }
    bool releaseContextImplementation() override { return true; }
    void swapBuffersImplementation() override {
        glReadPixels(0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.pixels.data());
    }

    Picture picture;

protected:
    ~SharedWindow() override {
        eglDestroySurface(display(), _surface);
        eglDestroyContext(display(), _context);
    }

private:
    static osg::ref_ptr<Traits> traitsOf(const View& view, SharedWindow* with) {
        osg::ref_ptr<Traits> traits = new Traits;
        traits->width = view.width;
        traits->height = view.height;
        traits->sharedContext = with;
        traits->doubleBuffer = false;
        return traits;
    }

    const EGLContext _context;
    EGLSurface _surface;
};

/// While it lives, each context knows only the framebuffer objects that it made itself.
class OwnFramebuffers {
public:
    explicit OwnFramebuffers(osg::GLExtensions& gl) : _gl(gl) {
        real = {gl.glGenFramebuffers, gl.glBindFramebuffer};
        made.clear();
        gl.glGenFramebuffers = generate;
        gl.glBindFramebuffer = bind;
    }
    ~OwnFramebuffers() {
        _gl.glGenFramebuffers = real.generate;
        _gl.glBindFramebuffer = real.bind;
    }
    OwnFramebuffers(const OwnFramebuffers&) = delete;
    OwnFramebuffers& operator=(const OwnFramebuffers&) = delete;

private:
    static void GL_APIENTRY generate(GLsizei count, GLuint* names) {
        real.generate(count, names);
        for (GLsizei i = 0; i < count; ++i) made[eglGetCurrentContext()][names[i]] = names[i];
    }
    static void GL_APIENTRY bind(GLenum target, GLuint name) {
        GLuint& known = made[eglGetCurrentContext()][name];
        if (name && !known) real.generate(1, &known);
        real.bind(target, known);
    }

    struct Real {
        decltype(osg::GLExtensions::glGenFramebuffers) generate;
        decltype(osg::GLExtensions::glBindFramebuffer) bind;
    };
    inline static Real real;
    inline static std::map<EGLContext, std::map<GLuint, GLuint>> made;
    osg::GLExtensions& _gl;
};

/// A viewer of one such window.
struct Viewer {
    Viewer(osg::Node* root, const View& view, SharedWindow* with = nullptr) : window(new SharedWindow(view, with)) {
        viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        viewer.setLightingMode(osg::View::NO_LIGHT);
        osg::Camera& camera = *viewer.getCamera();
        camera.setGraphicsContext(window);
        camera.setViewport(0, 0, view.width, view.height);
        test::settle(camera, view);
        viewer.setSceneData(root);
        viewer.realize();
        window->makeCurrent();
    }
    Picture frame() {
        viewer.frame();
        window->makeCurrent();
        glFinish();
        error = error ? error : glGetError();
        return window->picture;
    }

    osg::ref_ptr<SharedWindow> window;
    osgViewer::Viewer viewer;
    GLenum error = GL_NO_ERROR;
};

osg::ref_ptr<gnomon::ShadowTechnique> technique(const std::string& name) {
    if (name == "traced") return new gnomon::TracedShadowTechnique;
    const osg::ref_ptr<gnomon::ShadowMapTechnique> map = new gnomon::ShadowMapTechnique;
    if (name == "soft map") {
        map->setEdges(gnomon::ShadowMapTechnique::SOFT);
        map->setSunAngle(3.0);
    }
    return map;
}

class SharedContexts : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Techniques, SharedContexts, testing::Values("map", "soft map", "traced"),
                         [](const auto& name) { return name.param == "soft map" ? "softMap" : name.param; });

View other() { return perspective({9.0, -10.0, 8.0}, {0.0, 0.0, 0.5}, 300, 220); }

} // namespace

TEST_P(SharedContexts, EachWindowHasItsOwnFramebuffers) {
    const TracedCase given = labEight();
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
        const auto build = [&] {
            Scene scene = given.build();
            scene.addShadow(technique(GetParam()));
            scene.group->setComposite(composite);
            return scene;
        };
        Camera first(build().root, given.view), second(build().root, other()); // each alone
        Scene scene = build();
        Viewer one(scene.root, given.view), two(scene.root, other(), one.window);
        const unsigned id = one.window->getState()->getContextID();
        ASSERT_EQ(two.window->getState()->getContextID(), id);
        const OwnFramebuffers own(*osg::GLExtensions::Get(id, true));
        for (int frame = 0; frame < 3; ++frame) {
            EXPECT_EQ(one.frame().different(first.frame()), 0) << frame;
            EXPECT_EQ(two.frame().different(second.frame()), 0) << frame;
        }
        EXPECT_EQ(one.error, GLenum(GL_NO_ERROR));
        EXPECT_EQ(two.error, GLenum(GL_NO_ERROR));
    }
}

// The group is in no graph when its window closes, so that OSG tells nobody below it; the next window's context has the same
// number.
TEST_P(SharedContexts, OneThatIsGoneIsNotTakenForTheNext) {
    const TracedCase given = labEight();
    Scene scene = given.build();
    scene.addShadow(technique(GetParam()));
    const Picture expected = render(scene.root, given.view);
    Scene next = given.build();
    next.addShadow(technique(GetParam()));
    const osg::ref_ptr<osg::Group> nothing = new osg::Group;
    unsigned id = 0;
    {
        Viewer before(next.root, given.view);
        before.frame();
        id = before.window->getState()->getContextID();
        before.viewer.setSceneData(nothing);
        before.frame();
    }
    Viewer after(next.root, given.view);
    ASSERT_EQ(after.window->getState()->getContextID(), id);
    for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(after.frame().different(expected), 0) << frame;
    EXPECT_EQ(after.error, GLenum(GL_NO_ERROR));
}
