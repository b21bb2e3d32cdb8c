// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/CoarseDepth.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon {
namespace {

constexpr int depthBits = 24;

/// In clip space.
using Corners = std::array<glm::dvec4, 8>;

Corners cornersOf(const osg::BoundingBoxd& box, const glm::dmat4& clipFromBox) {
    return boxCorners(toGlm(box._min), toGlm(box._max), clipFromBox);
}

bool isNearer(const glm::dvec4& a, const glm::dvec4& b) { return a.w < b.w; }

double nearestOf(const Corners& corners) { return std::min_element(corners.begin(), corners.end(), isNearer)->w; }
double farthestOf(const Corners& corners) { return std::max_element(corners.begin(), corners.end(), isNearer)->w; }

/// True if some of it is in view and as large as a pixel.
bool isSeen(const Corners& corners, const osg::Vec2d& pixels) {
    const auto isBeforeFarPlane = [](const glm::dvec4& corner) { return corner.z <= corner.w; };
    if (std::none_of(corners.begin(), corners.end(), isBeforeFarPlane)) return false;
    const std::optional<ScreenRect> place = screenBounds({corners.begin(), corners.end()});
    if (!place) return false;
    const glm::dvec2 size = 0.5 * (place->high - place->low) * glm::dvec2(pixels.x(), pixels.y());
    return std::max(size.x, size.y) >= 1.0;
}

} // namespace

/// Depth is d = (a z + b) / w with w = c z + e, so that it changes by |a e - b c| / w² along z. A step of 2^(1 - bits), for d
/// goes from -1 to 1, is w² 2^(1 - bits) / |a e - b c| long, and a pixel 2 w / (scale · pixels) wide.
double coarseDepthFrom(const osg::Matrixd& projection, const DepthPixels& pixels) {
    const double change = std::abs(projection(2, 2) * projection(3, 3) - projection(3, 2) * projection(2, 3));
    const double across =
        std::max(std::abs(projection(0, 0)) * pixels.size.x(), std::abs(projection(1, 1)) * pixels.size.y());
    return std::ldexp(change, depthBits) / (across * pixels.steps);
}

bool reachesCoarseDepth(const LitView& view, const osg::Matrixd& projection, const DepthPixels& pixels) {
    const osg::BoundingBoxd& box = view.casters.bounds;
    return box.valid() &&
           farthestOf(cornersOf(box, toGlm(view.eyeFromGroup * projection))) > coarseDepthFrom(projection, pixels);
}

std::string coarselyPlaced(const LitView& view, const osg::Matrixd& projection, const DepthPixels& pixels) {
    const double coarse = coarseDepthFrom(projection, pixels);
    const glm::dmat4 clipFromGroup = toGlm(view.eyeFromGroup * projection);
    for (const auto& piece : view.casters.list) {
        if (!piece->bounds.valid()) continue;
        const Corners corners = cornersOf(piece->bounds, clipFromGroup);
        if (nearestOf(corners) > coarse && isSeen(corners, pixels.size)) return nameOf(*piece->drawable);
    }
    return {};
}

} // namespace gnomon
