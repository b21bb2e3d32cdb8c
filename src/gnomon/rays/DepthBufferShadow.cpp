// SPDX-License-Identifier: MIT
#include <gnomon/rays/DepthBufferShadow.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double stepsOff = 4.0;
constexpr double snapsOff = 2.0;
constexpr double coarse = 0.125; // of a pixel: depths that are off by more show at edges

/// How far a depth may be from that of the surface, in depth.
struct DepthError {
    double least = 0.0; ///< by the buffer's steps and the rasteriser's places.
    double most = 0.0;  ///< by the floats of the vertices, too.
};

class DepthTracer {
public:
    DepthTracer(const RayScene& scene, const DepthPicture& picture, const glm::dmat4& clipFromScene,
                const glm::dvec4& light)
        : _scene(scene),
          _picture(picture),
          _sceneFromClip(glm::inverse(clipFromScene)),
          _across(_sceneFromClip[0] * (2.0 / picture.viewportWidth)),
          _light(light) {}

    /// @param x,y  counted from the part's corner.
    bool blocked(int x, int y) const;

private:
    double depth(int x, int y) const {
        return double(_picture.depths[std::size_t(y) * std::size_t(_picture.width) + std::size_t(x)]);
    }
    /// Change of depth from one pixel to the next, on the surface that is seen: to the nearer neighbour in depth.
    double slope(int x, int y, int dx, int dy) const;
    /// Homogeneous, scene: a point of a pixel's ray. In these coordinates all of the ray is linear in depth.
    glm::dvec4 unproject(int x, int y, double depth) const;
    DepthError error(int x, int y, double perDistance) const;
    glm::dvec3 start(int x, int y) const;

    const RayScene& _scene;
    const DepthPicture& _picture;
    const glm::dmat4 _sceneFromClip;
    const glm::dvec4 _across; ///< from one pixel to the next, where depths are alike.
    const glm::dvec4 _light;
};

double DepthTracer::slope(int x, int y, int dx, int dy) const {
    double least = 1.0;
    for (const int side : {-1, 1}) {
        const int u = x + side * dx, v = y + side * dy;
        if (u < 0 || v < 0 || u >= _picture.width || v >= _picture.height) continue;
        if (!(depth(u, v) < 1.0)) continue;
        least = std::min(least, std::abs(depth(u, v) - depth(x, y)));
    }
    return least < 1.0 ? least : 0.0;
}

glm::dvec4 DepthTracer::unproject(int x, int y, double depth) const {
    return _sceneFromClip * glm::dvec4(2.0 * (_picture.x + x + _picture.place.x) / _picture.viewportWidth - 1.0,
                                       2.0 * (_picture.y + y + _picture.place.y) / _picture.viewportHeight - 1.0,
                                       2.0 * depth - 1.0, 1.0);
}

glm::dvec3 cartesian(const glm::dvec4& point) { return glm::dvec3(point) * (1.0 / point.w); }

/// @param perDistance  1 / w in clip space.
DepthError DepthTracer::error(int x, int y, double perDistance) const {
    const double slopes = slope(x, y, 1, 0) + slope(x, y, 0, 1);
    DepthError result;
    result.least = stepsOff * _picture.step + (snapsOff * _picture.subpixel + _picture.offPlace) * slopes;
    result.most = result.least + (_picture.drawnDepth + _picture.drawnPixels * slopes) * std::abs(perDistance);
    return result;
}

/// Where a pixel's ray to the light starts: as far before the surface as its depth may be wrong, or on the surface that
/// is found there where that is too far.
glm::dvec3 DepthTracer::start(int x, int y) const {
    const double seen = depth(x, y);
    const glm::dvec4 surface = unproject(x, y, seen), deeper = 2.0 * _sceneFromClip[2];
    const DepthError off = error(x, y, surface.w);
    const auto nearerBy = [&](double by) { return cartesian(surface - std::min(by, seen) * deeper); };
    const glm::dvec3 nearer = nearerBy(off.most);
    const glm::dvec3 farther = cartesian(surface + std::min(off.most, 1.0 - seen) * deeper); // beyond 1: behind the eye
    const glm::dvec3 along = farther - nearer, pixel = cartesian(surface + _across) - cartesian(surface);
    if (!(glm::dot(along, along) > coarse * coarse * glm::dot(pixel, pixel)))
        return nearer - _scene.margin(nearer) * glm::normalize(along);
    const RayHit hit = _scene.closest({nearer, along, 1.0});
    if (hit)
        return _scene.lifted(nearer + hit.distance * along,
                             glm::dot(hit.normal, along) < 0.0 ? hit.normal : -hit.normal);
    const glm::dvec3 before = nearerBy(off.least); // what is seen does not cast
    return before - _scene.margin(before) * glm::normalize(along);
}

bool DepthTracer::blocked(int x, int y) const {
    if (!(depth(x, y) < 1.0)) return false;
    const glm::dvec3 from = start(x, y), light(_light);
    if (_light.w == 0.0) return _scene.blocked({from, light});
    return _scene.blocked({from, light / _light.w - from, 1.0});
}

} // namespace

std::vector<std::uint8_t> depthBufferShadow(const RayScene& scene, const DepthPicture& picture,
                                            const glm::dmat4& clipFromScene, const glm::dvec4& light) {
    const DepthTracer tracer(scene, picture, clipFromScene, light);
    const std::size_t stride = (std::size_t(picture.width) + 7) / 8;
    std::vector<std::uint8_t> bits(stride * std::size_t(picture.height), 0);
    tbb::parallel_for(0, picture.height, [&](int y) {
        std::uint8_t* row = bits.data() + stride * std::size_t(y);
        for (int x = 0; x < picture.width; ++x)
            if (tracer.blocked(x, y)) row[x / 8] = static_cast<std::uint8_t>(row[x / 8] | (0x80 >> (x % 8)));
    });
    return bits;
}

} // namespace gnomon
