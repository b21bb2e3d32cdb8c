// SPDX-License-Identifier: MIT
#include <support/GlDebug.h>
#include <support/Picture.h>

#include <osg/GLExtensions>

#include <algorithm>
#include <cstring>

namespace test {

View fromAbove(double half, int size) {
    View view;
    view.width = view.height = size;
    view.view.makeLookAt({0.0, 0.0, 50.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    view.projection.makeOrtho(-half, half, -half, half, 1.0, 100.0);
    return view;
}

View perspective(const osg::Vec3d& eye, const osg::Vec3d& centre, int width, int height, double fovy, double near,
                 double far) {
    View view;
    view.width = width;
    view.height = height;
    view.view.makeLookAt(eye, centre, {0.0, 0.0, 1.0});
    view.projection.makePerspective(fovy, static_cast<double>(width) / height, near, far);
    return view;
}

std::uint32_t grey(unsigned value) { return 0xff000000u | value << 16 | value << 8 | value; }

int Picture::count(unsigned value) const {
    return static_cast<int>(std::count(pixels.begin(), pixels.end(), grey(value)));
}

int Picture::different(const Picture& other) const {
    int result = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) result += pixels[i] != other.pixels.at(i);
    return result;
}

Picture pictureOf(const gnomon::HeadlessContext& context, int left, int width) {
    const osg::ref_ptr<osg::Image> image = context.image();
    Picture picture;
    picture.width = width > 0 ? width : image->s();
    picture.height = image->t();
    picture.pixels.resize(static_cast<std::size_t>(picture.width * picture.height));
    for (int y = 0; y < picture.height; ++y)
        std::memcpy(&picture.pixels[static_cast<std::size_t>(y * picture.width)], image->data(left, y),
                    static_cast<std::size_t>(picture.width) * 4);
    return picture;
}

void settle(osg::Camera& camera, const View& view) {
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setCullingMode(camera.getCullingMode() & ~osg::CullSettings::SMALL_FEATURE_CULLING);
    camera.setClearColor({0.0f, 0.0f, 0.25f, 1.0f});
    camera.setViewMatrix(view.view);
    camera.setProjectionMatrix(view.projection);
}

Camera::Camera(osg::Node* root, const View& view, const gnomon::HeadlessContext::Options& given) {
    gnomon::HeadlessContext::Options options = given;
    options.width = view.width;
    options.height = view.height;
    _context = std::make_unique<gnomon::HeadlessContext>(options);
    failBySeriousGlMessages(*_context->graphicsContext());
    _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    _viewer.setLightingMode(osg::View::NO_LIGHT);
    _context->attach(*_viewer.getCamera());
    settle(*_viewer.getCamera(), view);
    _viewer.setSceneData(root);
}

void Camera::setView(const View& view) {
    _viewer.getCamera()->setViewMatrix(view.view);
    _viewer.getCamera()->setProjectionMatrix(view.projection);
}

Picture Camera::frame() {
    _viewer.frame();
    return pictureOf(*_context);
}

struct NoFramebufferCopies::Functions {
    explicit Functions(osg::GLExtensions& extensions) : all(extensions), blit(extensions.glBlitFramebuffer) {}
    osg::GLExtensions& all;
    const decltype(osg::GLExtensions::glBlitFramebuffer) blit;
};

NoFramebufferCopies::NoFramebufferCopies(Camera& camera) {
    camera.frame();
    auto& extensions = *camera.context().graphicsContext()->getState()->get<osg::GLExtensions>();
    _functions = std::make_unique<Functions>(extensions);
    extensions.glBlitFramebuffer = nullptr;
}

NoFramebufferCopies::~NoFramebufferCopies() { _functions->all.glBlitFramebuffer = _functions->blit; }

Picture render(osg::Node* root, const View& view) { return Camera(root, view).frame(); }

} // namespace test
