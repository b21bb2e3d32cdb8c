// SPDX-License-Identifier: MIT
#include "SceneTruth.h"
#include "SceneTriangles.h"

#include <gnomon/Convert.h>
#include <gnomon/HeadlessContext.h>
#include <gnomon/ShadowTruth.h>

#include <osg/AlphaFunc>
#include <osg/Depth>
#include <osgViewer/Viewer>

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using metrics::Grid;
using metrics::Picture;

constexpr double discDegrees = 0.533; // the sun's, seen from the Earth
constexpr int discStrata = 4;         // a side: 16 rays for each of a pixel's 16

bool isFinite(const osg::Vec3d& v) { return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z()); }

/// Where most corners are: floats about it tell the places there, however far a stray body is.
osg::Vec3d middleOf(const SceneTriangles& triangles) {
    std::vector<osg::Vec3d> corners;
    for (const unsigned corner : triangles.indices)
        if (isFinite(triangles.vertices[corner])) corners.push_back(triangles.vertices[corner]);
    if (corners.empty())
        throw std::runtime_error("the scene has no triangles, so it has no truth. Give a scene with triangles.");
    osg::Vec3d middle;
    const auto half = corners.begin() + std::ptrdiff_t(corners.size() / 2);
    for (int axis = 0; axis < 3; ++axis) {
        std::nth_element(corners.begin(), half, corners.end(),
                         [axis](const osg::Vec3d& a, const osg::Vec3d& b) { return a[axis] < b[axis]; });
        middle[axis] = (*half)[axis];
    }
    return middle;
}

std::unique_ptr<RayScene> treeOf(const SceneTriangles& triangles, const osg::Vec3d& origin) {
    std::vector<glm::vec3> vertices;
    vertices.reserve(triangles.vertices.size());
    for (const osg::Vec3d& v : triangles.vertices) vertices.push_back(glm::vec3(toGlm(v - origin)));
    TriangleSoup soup;
    soup.vertices = vertices.data();
    soup.vertexCount = vertices.size();
    soup.indices = triangles.indices.data();
    soup.indexCount = triangles.indices.size();
    if (triangles.hasCutouts())
        soup.solidAt = [&triangles](unsigned triangle, double u, double v) {
            return triangles.solidAt(triangle, u, v);
        };
    return std::make_unique<RayScene>(soup);
}

/// What the scene's own state draws where, told by its depth alone.
class DepthCamera {
public:
    DepthCamera(osg::Node& scene, int width, int height) : _width(width), _height(height), _context(width, height) {
        _viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        _context.attach(*_viewer.getCamera());
        _viewer.getCamera()->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        _viewer.setSceneData(&scene);
    }
    bool fits(const SceneCamera& camera) const { return camera.width == _width && camera.height == _height; }
    /// @param culls  as the scene has it; false: no face, as rays have it.
    osg::ref_ptr<osg::Image> depth(const SceneCamera& camera, bool culls) {
        using M = osg::StateAttribute;
        _viewer.getCamera()->getOrCreateStateSet()->setMode(GL_CULL_FACE, culls ? M::INHERIT : M::OFF | M::OVERRIDE);
        _viewer.getCamera()->setProjectionMatrix(camera.projection);
        _viewer.getCamera()->setViewMatrix(camera.view);
        _viewer.frame();
        return _context.depth();
    }

private:
    const int _width, _height;
    HeadlessContext _context; // before the viewer: it must outlive it
    osgViewer::Viewer _viewer;
};

/// Lets what blends leave its depth where it is there, as rays see it, and nowhere else.
class BlendedDepths : public osg::NodeVisitor {
public:
    BlendedDepths() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Drawable& drawable) override {
        const std::optional<Cutout> cutout = Cutout::blended(getNodePath(), drawable);
        if (!cutout) return;
        constexpr unsigned forced =
            osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
        osg::StateSet& state = *drawable.getOrCreateStateSet();
        state.setAttributeAndModes(new osg::AlphaFunc(cutout->test()), forced);
        state.setAttributeAndModes(new osg::Depth(osg::Depth::LESS), forced);
    }
};

osg::ref_ptr<osg::Node> withBlendedDepths(const osg::Node& scene) {
    using C = osg::CopyOp;
    const osg::ref_ptr<osg::Node> copy = osg::clone(
        &scene, C(C::DEEP_COPY_NODES | C::DEEP_COPY_DRAWABLES | C::DEEP_COPY_STATESETS | C::DEEP_COPY_USERDATA));
    BlendedDepths visitor;
    copy->accept(visitor);
    return copy;
}

/// Window depth of a surface at a pixel's centre, and how far it may be off where that very surface is drawn.
struct Depth {
    double value = 0.0, tolerance = 0.0;
};

/// A plane is a plane in clip space too, so that its depth is linear over the screen. Half a pixel for where the
/// rasteriser takes a sample and rounds corners to, eight steps of a 24-bit buffer for its float arithmetic.
Depth depthOf(const TruthPixel& pixel, const TruthView& view, const glm::dmat4& worldFromClip) {
    const glm::dvec4 clip = view.clipFromWorld * glm::dvec4(pixel.position, 1.0);
    const glm::dvec4 plane =
        glm::transpose(worldFromClip) * glm::dvec4(pixel.normal, -glm::dot(pixel.normal, pixel.position));
    const double across = std::abs(plane.x / plane.z) / view.width, up = std::abs(plane.y / plane.z) / view.height;
    return {0.5 + 0.5 * clip.z / clip.w, 0.5 * (across + up) + std::ldexp(8.0, -24)};
}

/// A scene's depths, and those it has if no face is culled.
struct Depths {
    osg::ref_ptr<osg::Image> drawn, unculled;
};

double depthAt(const osg::Image& image, int x, int y) {
    return double(*reinterpret_cast<const float*>(image.data(unsigned(x), unsigned(y))));
}

/// The truth's receivers, but 0 where something else than they is drawn: what lies close behind a culled face, too.
Grid<int> drawnIds(const TruthImage& truth, const Grid<int>& receiver, const TruthView& view, const Depths& depths) {
    const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
    Grid<int> drawn(truth.width, truth.height);
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            if (!truth.at(x, y).seen()) continue;
            const Depth expected = depthOf(truth.at(x, y), view, worldFromClip);
            const double actual = depthAt(*depths.drawn, x, y);
            if (actual == depthAt(*depths.unculled, x, y) && std::abs(actual - expected.value) <= expected.tolerance)
                drawn.at(x, y) = receiver.at(x, y);
        }
    return drawn;
}

metrics::TruthMaps emptyMaps(int width, int height) {
    metrics::TruthMaps maps;
    maps.lit = maps.blockerDistance = maps.facing = maps.edgeLength = Picture(width, height);
    maps.litCentre = maps.undecided = metrics::Mask(width, height);
    maps.litBeside.fill(maps.undecided);
    maps.receiver = maps.blocker = Grid<int>(width, height);
    maps.position = Grid<glm::dvec3>(width, height);
    return maps;
}

/// Ids of objects from 1, 0 is none.
int idOf(const SceneTriangles& triangles, unsigned triangle) {
    return triangle == RayHit::none ? 0 : static_cast<int>(triangles.object[triangle]) + 1;
}

metrics::TruthMaps mapsOf(const TruthImage& truth, const SceneTriangles& triangles) {
    metrics::TruthMaps maps = emptyMaps(truth.width, truth.height);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const TruthPixel& pixel = truth.pixels[i];
        maps.lit.cells[i] = double(pixel.lit);
        if (!pixel.seen()) continue;
        maps.litCentre.cells[i] = pixel.litCentre;
        maps.undecided.cells[i] = pixel.undecided;
        for (std::size_t k = 0; k < maps.litBeside.size(); ++k) maps.litBeside[k].cells[i] = pixel.litBeside[k];
        maps.blockerDistance.cells[i] = pixel.blockerDistance;
        maps.receiver.cells[i] = idOf(triangles, pixel.receiver);
        maps.blocker.cells[i] = idOf(triangles, pixel.blocker);
        maps.facing.cells[i] = pixel.facing;
        maps.edgeLength.cells[i] = triangles.longestEdge(pixel.receiver);
        maps.position.cells[i] = pixel.position;
    }
    return maps;
}

bool isBelow(const SceneTriangles::Object& object, const osg::Node& node) {
    return std::find(object.path.begin(), object.path.end(), &node) != object.path.end();
}

/// All triangles but those below a node.
SceneTriangles without(const SceneTriangles& all, const osg::Node& node) {
    SceneTriangles left = all;
    left.indices.clear();
    left.object.clear();
    for (std::size_t i = 0; i < all.count(); ++i) {
        if (isBelow(all.objects[all.object[i]], node)) continue;
        left.object.push_back(all.object[i]);
        left.indices.insert(left.indices.end(), all.indices.begin() + std::ptrdiff_t(3 * i),
                            all.indices.begin() + std::ptrdiff_t(3 * i + 3));
    }
    return left;
}

} // namespace

struct SceneTruth::Parts {
    Parts(osg::Node& node, Clear clear)
        : triangles(sceneTriangles(node, clear)),
          scene(clear == Clear::PASSES && triangles.hasCutouts() ? withBlendedDepths(node)
                                                                 : osg::ref_ptr<osg::Node>(&node)),
          origin(middleOf(triangles)),
          tree(treeOf(triangles, origin)) {}

    TruthView view(const SceneCamera& camera, const osg::Vec4d& light) const {
        const osg::Vec4d local(light - osg::Vec4d(origin * light.w(), 0.0));
        return {toGlm(osg::Matrixd::translate(origin) * camera.view * camera.projection), camera.width, camera.height,
                toGlm(local)};
    }

    Depths depths(const SceneCamera& camera) {
        if (depthCamera && !depthCamera->fits(camera)) depthCamera.reset(); // one context at a time
        if (!depthCamera) depthCamera = std::make_unique<DepthCamera>(*scene, camera.width, camera.height);
        return {depthCamera->depth(camera, true), depthCamera->depth(camera, false)};
    }

    const SceneTriangles triangles;
    const osg::ref_ptr<osg::Node> scene;
    std::unique_ptr<DepthCamera> depthCamera; ///< of the last picture's size.
    const osg::Vec3d origin;
    const std::unique_ptr<RayScene> tree;
};

SceneTruth::SceneTruth(osg::Node& scene, Clear clear) : _parts(new Parts(scene, clear)) {}
SceneTruth::~SceneTruth() = default;

metrics::TruthMaps SceneTruth::maps(const SceneCamera& camera, const osg::Vec4d& light) const {
    const TruthView view = _parts->view(camera, light);
    const TruthImage truth = shadowTruth(*_parts->tree, *_parts->tree, view);
    metrics::TruthMaps maps = mapsOf(truth, _parts->triangles);
    maps.drawn = drawnIds(truth, maps.receiver, view, _parts->depths(camera));
    if (light.w() == 0.0) maps.towardsLight = {light.x(), light.y(), light.z()};
    return maps;
}

metrics::Picture SceneTruth::litByDisc(const SceneCamera& camera, const osg::Vec4d& light) const {
    const RayScene& tree = *_parts->tree;
    const TruthImage truth = softShadowTruth(tree, tree, _parts->view(camera, light), discDegrees, discStrata);
    metrics::Picture result(truth.width, truth.height);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) result.cells[i] = double(truth.pixels[i].lit);
    return result;
}

metrics::Mask SceneTruth::alone(const SceneCamera& camera, const osg::Vec4d& light, const osg::Node& body) const {
    const SceneTriangles& all = _parts->triangles;
    const SceneTriangles others = without(all, body);
    const std::unique_ptr<RayScene> casters = others.count() ? treeOf(others, origin()) : nullptr;
    const TruthView view = _parts->view(camera, light);
    const TruthImage truth = shadowTruth(*_parts->tree, casters ? *casters : *_parts->tree, view);
    const auto isOfBody = [&](const TruthPixel& pixel) {
        return pixel.seen() && isBelow(all.objects[all.object[pixel.receiver]], body);
    };
    const auto isShadowed = [&](int x, int y) {
        for (int v = std::max(y - 2, 0); v <= std::min(y + 2, view.height - 1); ++v)
            for (int u = std::max(x - 2, 0); u <= std::min(x + 2, view.width - 1); ++u)
                if (isOfBody(truth.at(u, v)) && truth.at(u, v).blocker != RayHit::none) return true;
        return false;
    };
    metrics::Mask mask(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) mask.at(x, y) = isOfBody(truth.at(x, y)) && !(casters && isShadowed(x, y));
    return mask;
}

osg::Vec3d SceneTruth::origin() const { return _parts->origin; }
std::size_t SceneTruth::triangles() const { return _parts->triangles.count(); }

} // namespace gnomon::examples
