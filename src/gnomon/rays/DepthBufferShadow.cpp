// SPDX-License-Identifier: MIT
#include <gnomon/rays/DepthBufferShadow.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>

namespace gnomon {
namespace {

constexpr double stepsOff = 4.0;
constexpr double snapsOff = 2.0;
constexpr double coarse = 0.125; // of a pixel: depths that are off by more show at edges

/// Change of depth from one pixel to the next. On the surface that is seen it is that to one of the neighbours: where two
/// faces meet, to either.
struct Slope {
    double least = 0.0, most = 0.0;
};

/// Change of depth a pixel along an axis, and whether the light ends there on the same surface.
struct EdgeSlope {
    double change = 0.0;
    bool ends = false;
};

/// How far a depth may be from that of the surface, in depth.
struct DepthError {
    double least = 0.0; ///< by the buffer's steps and the rasteriser's places, on the flatter surface.
    double most = 0.0;  ///< by the floats of the vertices, too, and on the steeper one.
};

/// Where a pixel's surface is, by what its depth may mean.
struct Span {
    glm::dvec3 nearest;  ///< to the eye, by all that is known.
    glm::dvec3 before;   ///< the same by the least error.
    glm::dvec3 farthest; ///< from the eye.
    double pixel = 0.0;  ///< squared size of a pixel there.

    glm::dvec3 along() const { return farthest - nearest; }
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
    /// What share of the light reaches the pixel, where one beside it is blocked otherwise; else 0 or 1.
    template <typename IsBlocked>
    double share(int x, int y, IsBlocked isBlocked) const;
    /// @param row  of bits that are 0.
    /// @return pixels that rays were cast for.
    std::size_t traceRow(int y, std::uint8_t* row, const FormerShadow* former, const std::uint8_t* known) const;

private:
    bool mayHaveChanged(int x, int y, const std::vector<RayBox>& changed) const;
    double depth(int x, int y) const {
        return double(_picture.depths[std::size_t(y) * std::size_t(_picture.width) + std::size_t(x)]);
    }
    Slope slope(int x, int y, int dx, int dy) const;
    /// Homogeneous, scene: a point of a pixel's ray. In these coordinates all of the ray is linear in depth.
    glm::dvec4 unproject(const glm::dvec2& at, double depth) const;
    template <typename IsBlocked>
    EdgeSlope edgeSlope(int x, int y, const glm::ivec2& next, IsBlocked isBlocked) const;
    DepthError error(int x, int y, double perDistance) const;
    Span span(int x, int y) const { return span(x, y, glm::dvec2(0.0), depth(x, y), 0.0); }
    /// @param offset  from where the depth was taken, pixels. @param seen  depth there. @param bend  how far off that may be.
    Span span(int x, int y, const glm::dvec2& offset, double seen, double bend) const;
    bool blocked(const Span& span, const glm::dvec3& start) const {
        return _scene.blocked(toLight(start)) && !isLitFromBehind(span);
    }
    /// The caster's surface between the two ends.
    RayHit surfaceIn(const Span& span) const { return _scene.closest({span.nearest, span.along(), 1.0}); }
    glm::dvec3 start(const Span& span) const;
    glm::dvec3 startOn(const Span& span, const RayHit& surface) const;
    /// How a surface lies, as it is seen: 1 towards the light, -1 away from it; 0 if it is no caster's.
    int facing(const Span& span, const RayHit& surface) const;
    Ray toLight(const glm::dvec3& from) const;
    bool isLitFromBehind(const Span& span) const;

    const RayScene& _scene;
    const DepthPicture& _picture;
    const glm::dmat4 _sceneFromClip;
    const glm::dvec4 _across; ///< from one pixel to the next, where depths are alike.
    const glm::dvec4 _light;
};

Slope DepthTracer::slope(int x, int y, int dx, int dy) const {
    Slope slope{1.0, 0.0};
    for (const int side : {-_picture.neighbour, _picture.neighbour}) {
        const int u = x + side * dx, v = y + side * dy;
        if (u < 0 || v < 0 || u >= _picture.width || v >= _picture.height) continue;
        if (!(depth(u, v) < 1.0)) continue;
        const double change = std::abs(depth(u, v) - depth(x, y)) / _picture.neighbour;
        slope = {std::min(slope.least, change), std::max(slope.most, change)};
    }
    return {std::min(slope.least, slope.most), slope.most};
}

glm::dvec4 DepthTracer::unproject(const glm::dvec2& at, double depth) const {
    return _sceneFromClip * glm::dvec4(2.0 * (_picture.x + at.x + _picture.place.x) / _picture.viewportWidth - 1.0,
                                       2.0 * (_picture.y + at.y + _picture.place.y) / _picture.viewportHeight - 1.0,
                                       2.0 * depth - 1.0, 1.0);
}

glm::dvec3 cartesian(const glm::dvec4& point) { return glm::dvec3(point) * (1.0 / point.w); }

/// @param perDistance  1 / w in clip space.
DepthError DepthTracer::error(int x, int y, double perDistance) const {
    const Slope across = slope(x, y, 1, 0), up = slope(x, y, 0, 1);
    const double least = across.least + up.least, most = across.most + up.most;
    const double steps = stepsOff * _picture.step, places = snapsOff * _picture.subpixel + _picture.offPlace;
    const double drawn = (_picture.drawnDepth + _picture.drawnPixels * most) * std::abs(perDistance);
    return {steps + places * least, steps + places * most + drawn};
}

Span DepthTracer::span(int x, int y, const glm::dvec2& offset, double seen, double bend) const {
    const glm::dvec4 surface = unproject(glm::dvec2(x, y) + offset, seen), deeper = 2.0 * _sceneFromClip[2];
    const DepthError off = error(x, y, surface.w);
    const auto nearerBy = [&](double by) { return cartesian(surface - std::min(by, seen) * deeper); };
    const glm::dvec3 pixel = cartesian(surface + _across) - cartesian(surface);
    return {nearerBy(off.most + bend), nearerBy(off.least),
            cartesian(surface + std::min(off.most + bend, 1.0 - seen) * deeper), // beyond 1: behind the eye
            glm::dot(pixel, pixel)};
}

/// Where a pixel's ray to the light starts: as far before the surface as its depth may be wrong, or on the surface that
/// is found there where that is too far.
glm::dvec3 DepthTracer::start(const Span& span) const {
    const glm::dvec3 along = span.along();
    if (!(glm::dot(along, along) > coarse * coarse * span.pixel))
        return span.nearest - _scene.margin(span.nearest) * glm::normalize(along);
    return startOn(span, surfaceIn(span));
}

glm::dvec3 DepthTracer::startOn(const Span& span, const RayHit& surface) const {
    const glm::dvec3 along = span.along();
    if (surface)
        return _scene.lifted(span.nearest + surface.distance * along,
                             glm::dot(surface.normal, along) < 0.0 ? surface.normal : -surface.normal);
    return span.before - _scene.margin(span.before) * glm::normalize(along); // what is seen does not cast
}

int DepthTracer::facing(const Span& span, const RayHit& surface) const {
    if (!surface) return 0;
    const double seen = glm::dot(surface.normal, span.along()),
                 lit = glm::dot(surface.normal, toLight(span.nearest).along);
    return (seen < 0.0) == (lit > 0.0) ? 1 : -1;
}

Ray DepthTracer::toLight(const glm::dvec3& from) const {
    const glm::dvec3 light(_light);
    if (_light.w == 0.0) return {from, light, std::numeric_limits<double>::infinity(), true};
    return {from, light / _light.w - from, 1.0, true};
}

/// True if nothing but the surface itself, which faces away from the light, is between. Nearly all that is in shadow is
/// so from behind its surface, too: then no more is looked for.
bool DepthTracer::isLitFromBehind(const Span& span) const {
    const glm::dvec3 way = glm::normalize(span.along());
    const glm::dvec3 first = span.nearest - _scene.margin(span.nearest) * way;
    const glm::dvec3 last = span.farthest + _scene.margin(span.farthest) * way;
    if (_scene.blocked(toLight(last))) return false;
    const RayHit surface = _scene.closest({first, last - first, 1.0});
    if (!surface) return false;
    const glm::dvec3 at = first + surface.distance * (last - first);
    const bool isFrontToLight = glm::dot(surface.normal, toLight(at).along) > 0.0;
    const glm::dvec3 normal = isFrontToLight ? surface.normal : -surface.normal;
    return glm::dot(normal, way) > 0.0 && !_scene.blocked(toLight(_scene.lifted(at, normal)));
}

bool DepthTracer::blocked(int x, int y) const {
    if (!(depth(x, y) < 1.0)) return false;
    const Span surface = span(x, y);
    return blocked(surface, start(surface));
}

/// Change of depth a pixel along an axis, where the pixel is at an edge along it: it goes to the neighbour that is blocked as the
/// pixel is, or to the nearer one in depth, for beyond a fold another face begins, on which the light ends otherwise. An edge is where
/// the surface goes on to the other neighbour and beyond, to half of its slope a pixel.
template <typename IsBlocked>
EdgeSlope DepthTracer::edgeSlope(int x, int y, const glm::ivec2& next, IsBlocked isBlocked) const {
    struct Side {
        bool seen = false, same = false;
        double change = 1.0; ///< to there.
        double after = 1.0;  ///< from there to the one after; the same if that is beyond the part.
    } sides[2];
    const auto isIn = [&](int u, int v) { return u >= 0 && v >= 0 && u < _picture.width && v < _picture.height; };
    const double here = depth(x, y);
    for (const int sign : {-1, 1}) {
        const int dx = sign * next.x, dy = sign * next.y, u = x + dx, v = y + dy;
        if (!isIn(u, v) || !(depth(u, v) < 1.0)) continue;
        const double to = sign * (depth(u, v) - here);
        const bool hasAfter = isIn(u + dx, v + dy);
        sides[sign > 0] = {true, isBlocked(u, v) == isBlocked(x, y), to,
                           hasAfter ? sign * (depth(u + dx, v + dy) - depth(u, v)) : to};
    }
    const auto& [before, after] = sides;
    const bool isNearer = std::abs(after.change) < std::abs(before.change);
    const Side& best =
        after.seen && (after.same == before.same || !before.seen ? isNearer : after.same) ? after : before;
    if (!best.seen) return {};
    const double most = stepsOff * _picture.step + 0.5 * std::abs(best.change);
    const bool ends = std::any_of(std::begin(sides), std::end(sides), [&](const Side& side) {
        return side.seen && !side.same && std::abs(side.change - best.change) <= most &&
               std::abs(side.after - best.change) <= 2.0 * most;
    });
    return {best.change / _picture.neighbour, ends};
}

/// Places in the pixel where what is seen lies otherwise about the light are another face's. Of 16 columns and 16 rows there is one in
/// each; a quarter turn leaves them where they are.
template <typename IsBlocked>
double DepthTracer::share(int x, int y, IsBlocked isBlocked) const {
    const bool own = isBlocked(x, y);
    const int n = _picture.neighbour;
    const auto differs = [&](int u, int v) {
        return u >= 0 && v >= 0 && u < _picture.width && v < _picture.height && isBlocked(u, v) != own;
    };
    const double asMiddle = own ? 0.0 : 1.0;
    if (!differs(x - n, y) && !differs(x + n, y) && !differs(x, y - n) && !differs(x, y + n)) return asMiddle;
    const EdgeSlope across = edgeSlope(x, y, {n, 0}, isBlocked), up = edgeSlope(x, y, {0, n}, isBlocked);
    if (!across.ends && !up.ends) return asMiddle;
    const glm::dvec2 change(across.change, up.change);
    const double bend = 0.25 * (std::abs(change.x) + std::abs(change.y)), here = depth(x, y);
    const Span middle = span(x, y, glm::dvec2(0.0), here, bend);
    const int lies = facing(middle, surfaceIn(middle));
    int lit = 0, all = 0;
    for (int column = 1; column <= 16; ++column) {
        const glm::dvec2 offset = (glm::dvec2(column, 4 * column % 17) - 0.5) / 16.0 - _picture.place;
        const Span place = span(x, y, offset, std::clamp(here + glm::dot(offset, change), 0.0, 1.0), bend);
        const RayHit surface = surfaceIn(place);
        if (facing(place, surface) != lies) continue;
        ++all;
        lit += !blocked(place, startOn(place, surface));
    }
    return all > 0 ? lit / double(all) : asMiddle;
}

/// True if the way from a to b, or beyond it if `endless`, meets the box.
bool meets(const RayBox& box, const glm::dvec3& a, const glm::dvec3& along, bool endless) {
    double from = 0.0, to = endless ? std::numeric_limits<double>::infinity() : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (along[axis] == 0.0) {
            if (!(a[axis] >= box.low[axis] && a[axis] <= box.high[axis])) return false;
            continue;
        }
        const double low = (box.low[axis] - a[axis]) / along[axis], high = (box.high[axis] - a[axis]) / along[axis];
        from = std::max(from, std::min(low, high));
        to = std::min(to, std::max(low, high));
    }
    return from <= to;
}

/// True if a box of what has changed may be on the way of a pixel's rays.
bool DepthTracer::mayHaveChanged(int x, int y, const std::vector<RayBox>& changed) const {
    if (changed.empty() || !(depth(x, y) < 1.0)) return false;
    const Span surface = span(x, y);
    const Ray ray = toLight(surface.nearest);
    const glm::dvec3 more(glm::length(surface.along()) + 4.0 * _scene.margin(surface.farthest));
    return std::any_of(changed.begin(), changed.end(), [&](const RayBox& box) {
        return meets({box.low - more, box.high + more}, ray.start, ray.along, std::isinf(ray.reach));
    });
}

/// True if a pixel's depth, and those that its slope is taken of, are what they were.
bool isSameAbout(const DepthPicture& a, const DepthPicture& b, int x, int y) {
    const auto same = [&](int u, int v) {
        if (u < 0 || v < 0 || u >= a.width || v >= a.height) return true;
        const std::size_t at = std::size_t(v) * std::size_t(a.width) + std::size_t(u);
        return a.depths[at] == b.depths[at];
    };
    const int n = a.neighbour;
    return same(x, y) && same(x - n, y) && same(x + n, y) && same(x, y - n) && same(x, y + n);
}

bool isSameRow(const DepthPicture& a, const DepthPicture& b, int y) {
    if (y < 0 || y >= a.height) return true;
    const std::size_t first = std::size_t(y) * std::size_t(a.width);
    return std::equal(a.depths.begin() + std::ptrdiff_t(first),
                      a.depths.begin() + std::ptrdiff_t(first + std::size_t(a.width)),
                      b.depths.begin() + std::ptrdiff_t(first));
}

bool isSet(const std::uint8_t* row, int x) { return (row[x / 8] & (0x80 >> (x % 8))) != 0; }

std::size_t DepthTracer::traceRow(int y, std::uint8_t* row, const FormerShadow* former,
                                  const std::uint8_t* known) const {
    std::size_t traced = 0;
    for (int x = 0; x < _picture.width; ++x) {
        const bool keeps =
            former && isSameAbout(_picture, former->picture, x, y) && !mayHaveChanged(x, y, former->changed);
        traced += !keeps && depth(x, y) < 1.0;
        if (keeps ? isSet(known, x) : blocked(x, y))
            row[x / 8] = static_cast<std::uint8_t>(row[x / 8] | (0x80 >> (x % 8)));
    }
    return traced;
}

} // namespace

TracedBits depthBufferShadow(const RayScene& scene, const DepthPicture& picture, const glm::dmat4& clipFromScene,
                             const glm::dvec4& light, const FormerShadow* former) {
    const DepthTracer tracer(scene, picture, clipFromScene, light);
    const std::size_t stride = (std::size_t(picture.width) + 7) / 8;
    TracedBits result;
    result.bits.resize(stride * std::size_t(picture.height), 0);
    std::atomic<std::size_t> traced{0};
    tbb::parallel_for(0, picture.height, [&](int y) {
        std::uint8_t* row = result.bits.data() + stride * std::size_t(y);
        const std::uint8_t* known = former ? former->bits.data() + stride * std::size_t(y) : nullptr;
        const int next = picture.neighbour;
        const bool isAsBefore = former && former->changed.empty() && isSameRow(picture, former->picture, y - next) &&
                                isSameRow(picture, former->picture, y) && isSameRow(picture, former->picture, y + next);
        if (isAsBefore)
            std::copy_n(known, stride, row);
        else
            traced += tracer.traceRow(y, row, former, known);
    });
    result.traced = traced;
    return result;
}

std::vector<std::uint8_t> depthBufferShares(const RayScene& scene, const DepthPicture& picture,
                                            const glm::dmat4& clipFromScene, const glm::dvec4& light,
                                            const std::vector<std::uint8_t>& bits) {
    const DepthTracer tracer(scene, picture, clipFromScene, light);
    const std::size_t stride = (std::size_t(picture.width) + 7) / 8;
    std::vector<std::uint8_t> shares(std::size_t(picture.width) * std::size_t(picture.height));
    const auto isBlocked = [&](int x, int y) { return isSet(bits.data() + stride * std::size_t(y), x); };
    tbb::parallel_for(0, picture.height, [&](int y) {
        std::uint8_t* row = shares.data() + std::size_t(picture.width) * std::size_t(y);
        for (int x = 0; x < picture.width; ++x)
            row[x] = static_cast<std::uint8_t>(std::lround(255.0 * tracer.share(x, y, isBlocked)));
    });
    return shares;
}

} // namespace gnomon
