// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/base/PixelRect.h>
#include <gnomon/base/ProgramText.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/VastLeaves.h>

#include <glm/geometric.hpp>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/Program>
#include <osg/TriangleFunctor>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

constexpr unsigned mostTriangles = 2000;
/// A surface may be off by so many pixels. Under a sun at 7 degrees a shadow's edge is off by eight times as much, and a map with a
/// texel a pixel allows for sixteen times. What is lost at the near plane is a tenth of a step of a float as large as the
/// polygon, as llvmpipe draws it.
constexpr double tolerance = 1.0 / 32.0, lost = 0.1 / (1 << 23);

using Polygon = std::vector<glm::dvec4>;

/// What is left of a convex polygon where a row of distances is not negative (I. Sutherland and G. Hodgman, 1974).
template <class Distance>
Polygon cut(const Polygon& polygon, Distance distance) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0.0) result.push_back(a);
        if ((da >= 0.0) != (db >= 0.0)) result.push_back(a + da / (da - db) * (b - a));
    }
    return result;
}

Polygon cutToView(Polygon polygon) {
    polygon = cut(polygon, [](const glm::dvec4& p) { return p.w + p.z; });
    for (const int axis : {0, 1, 2})
        for (const double side : {-1.0, 1.0})
            if (axis < 2 || side > 0.0)
                polygon = cut(polygon, [&](const glm::dvec4& p) { return p.w - side * p[axis]; });
    return polygon;
}

/// The faces that a state draws: fronts are counter-clockwise on the screen.
struct Faces {
    bool fronts = true, backs = true;

    explicit Faces(const osgUtil::StateGraph* graph) {
        if (!isOn(graph, GL_CULL_FACE)) return;
        const auto* culled = resolved<osg::CullFace>(graph, osg::StateAttribute::CULLFACE);
        const auto* front = resolved<osg::FrontFace>(graph, osg::StateAttribute::FRONTFACE);
        const auto mode = culled ? culled->getMode() : osg::CullFace::BACK;
        fronts = mode == osg::CullFace::BACK;
        backs = mode == osg::CullFace::FRONT;
        if (front && front->getMode() == osg::FrontFace::CLOCKWISE) std::swap(fronts, backs);
    }
};

/// Cuts triangles to what is seen of them.
struct Cutter {
    glm::dmat4 clipFromLocal{1.0};
    double longest = 0.0; ///< of sides, in the eye's unit, that need not be cut so.
    double near = 0.0, scale = 1.0;
    Faces faces{nullptr};
    bool vast = false;
    std::vector<glm::vec4> corners;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) {
        const glm::dvec3 local[] = {toGlm(osg::Vec3d(a)), toGlm(osg::Vec3d(b)), toGlm(osg::Vec3d(c))};
        Polygon polygon;
        for (const glm::dvec3& corner : local) polygon.push_back(clipFromLocal * glm::dvec4(corner, 1.0));
        const auto [x, y, z] = std::array{glm::dvec3(polygon[0].x, polygon[0].y, polygon[0].w),
                                          glm::dvec3(polygon[1].x, polygon[1].y, polygon[1].w),
                                          glm::dvec3(polygon[2].x, polygon[2].y, polygon[2].w)};
        const double turn = glm::dot(x, glm::cross(y, z)); // homogeneous: right behind the eye, too
        if (!(turn > 0.0 ? faces.fronts : faces.backs)) return;
        const auto [low, high] = std::minmax({polygon[0].w, polygon[1].w, polygon[2].w});
        const double side = scale * std::max({glm::distance(local[0], local[1]), glm::distance(local[1], local[2]),
                                              glm::distance(local[2], local[0])});
        const Polygon seen = cutToView(std::move(polygon));
        if (seen.size() < 3) return;
        vast = vast || (side > longest && low < near && high > near);
        for (std::size_t i = 2; i < seen.size(); ++i)
            for (const glm::dvec4& corner : {seen[0], seen[i - 1], seen[i]}) corners.emplace_back(corner);
    }
};

/// By which a matrix lengthens anything at most, about.
double scaleOf(const osg::Matrixd& matrix) {
    double longest = 0.0;
    for (int row = 0; row < 3; ++row)
        longest = std::max(longest, osg::Vec3d(matrix(row, 0), matrix(row, 1), matrix(row, 2)).length2());
    return std::sqrt(longest);
}

bool isSimple(const osg::Geometry& geometry) {
    unsigned indices = 0;
    for (const auto& primitives : geometry.getPrimitiveSetList()) {
        if (primitives->getMode() < GL_TRIANGLES || primitives->getNumInstances() > 0) return false;
        indices += primitives->getNumIndices();
    }
    return indices <= 3 * mostTriangles;
}

bool isDrawnPlainly(const osgUtil::StateGraph* graph) {
    const ProgramPlaces places = placesIn(graph);
    return !places.movesVertices && !places.setsDepth && writesDepth(graph);
}

} // namespace

std::vector<VastLeaf> vastLeaves(const std::vector<DrawnLeaf>& leaves, const osg::Viewport& viewport) {
    std::vector<VastLeaf> result;
    const osgUtil::RenderLeaf* last = nullptr; // leaves that share matrices mostly follow one another
    double near = 0.0, longest = 0.0, scale = 0.0;
    for (const DrawnLeaf& entry : leaves) {
        const osgUtil::RenderLeaf& leaf = *entry.leaf;
        const osg::Matrixd& projection = projectionOf(leaf);
        if (projection(3, 3) != 0.0 || !(projection(2, 2) < -1.0)) continue; // no perspective, or an endless one
        if (!last || last->_projection != leaf._projection) {
            near = projection(3, 2) / (projection(2, 2) - 1.0);
            longest = tolerance / lost * near * 2.0 / (projection(1, 1) * pixelsOf(viewport).height);
        }
        if (!last || last->_modelview != leaf._modelview) scale = scaleOf(modelviewOf(leaf));
        last = &leaf;
        const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
        const osg::Geometry* geometry = leaf._drawable->asGeometry();
        const double size = scale * osg::Vec3d(box._max - box._min).length();
        if (!geometry || !box.valid() || !(size > longest)) continue;
        if (!isSimple(*geometry) || !isDrawnPlainly(leaf._parent) || !isFilled(leaf)) continue;
        osg::TriangleFunctor<Cutter> cutter;
        cutter.clipFromLocal = toGlm(modelviewOf(leaf) * projection);
        cutter.longest = longest;
        cutter.near = near;
        cutter.scale = scale;
        cutter.faces = Faces(leaf._parent);
        geometry->accept(cutter);
        if (cutter.vast) result.push_back({entry, std::move(cutter.corners)});
    }
    return result;
}

} // namespace gnomon
