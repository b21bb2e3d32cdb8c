// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/map/MapRequest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon {
namespace {

constexpr double sameLight = 1e-7;  // of the distance: what floats make of a light at rest
constexpr double sameAmong = 1e-10; // of what is about a lamp: what doubles do

/// Soft: penumbras of a pixel or two are wider than the filter.
double widestTexelOf(const ShadowMapOptions& options) {
    constexpr double plain = 1.5, fine = 0.7, soft = 0.33;
    if (options.edges == ShadowMapOptions::SOFT) return soft;
    return options.edges == ShadowMapOptions::SMOOTH && options.filter == ShadowMapOptions::FINE ? fine : plain;
}

/// A sun and a lamp differ by 1 in w, at least.
bool isSame(const glm::dvec4& a, const glm::dvec4& b, double widest) {
    const double off = sameLight * glm::length(glm::dvec3(b)) + (b.w == 0.0 ? 0.0 : sameAmong * widest);
    return glm::distance(a, b) <= off;
}

bool isSame(const std::optional<SpotCone>& a, const std::optional<SpotCone>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->cutoff == b->cutoff && glm::distance(a->axis, b->axis) <= sameLight;
}

/// What a drawable of unknown bounds is taken for: it may be anywhere in the view.
PlacedBox wholeView(const ViewFrame& view, const glm::dmat4& sceneFromEye) {
    const glm::dmat4 eyeFromClip = glm::inverse(toGlm(view.projection));
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec4& corner : boxCorners(glm::dvec3(-1.0), glm::dvec3(1.0), eyeFromClip)) {
        low = glm::min(low, glm::dvec3(corner) / corner.w);
        high = glm::max(high, glm::dvec3(corner) / corner.w);
    }
    return {low, high, sceneFromEye};
}

} // namespace

MapSettings::MapSettings(const ShadowMapOptions& options)
    : size(options.size),
      cascades(options.cascades),
      blends(options.filter != ShadowMapOptions::NEAREST),
      widestTexel(widestTexelOf(options)) {
    if (options.edges != ShadowMapOptions::SOFT) return;
    sunRadius = std::tan(glm::radians(options.sunAngle / 2.0));
    lampRadius = options.lampSize / 2.0;
    blurRadius = options.radius;
}

double MapRequest::lightRadius(const LightFrame& frame) const {
    if (frame.isParallel && light.w == 0.0) return settings.sunRadius;
    return settings.lampRadius / (frame.isParallel ? glm::length(glm::dvec3(light)) : 1.0);
}

bool MapRequest::isWide(const LightFrame& frame) const { return lightRadius(frame) > 0.0 || settings.blurRadius > 0.0; }

double MapRequest::softness(const LightFrame& frame, MapOutline blocker, double farthest) const {
    blocker.limitNearest(widestRatio);
    return softReach(frame, blocker.nearest, farthest, lightRadius(frame), settings.blurRadius);
}

bool isSameLight(const MapRequest& one, const MapRequest& other, double widest) {
    return isSame(one.cone, other.cone) && isSame(one.light, other.light, widest);
}

std::vector<PlacedBox> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene) {
    const glm::dmat4 sceneFromEye = glm::inverse(eyeFromScene);
    std::vector<PlacedBox> boxes;
    std::vector<std::pair<double, std::size_t>> sized; // by the radius, scene
    boxes.reserve(view.seen.size() + 1);
    sized.reserve(view.seen.size() + 1);
    const auto add = [&](const PlacedBox& box) {
        sized.emplace_back(box.radius, boxes.size());
        boxes.push_back(box);
    };
    bool anywhere = view.movesReceivers;
    const osg::RefMatrix* known = nullptr; // leaves that share a matrix mostly follow one another
    glm::dmat4 sceneFromLeaf(1.0);
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        anywhere = anywhere || !box.valid();
        if (!box.valid()) continue;
        if (!known || known != leaf->_modelview) sceneFromLeaf = sceneFromEye * toGlm(modelviewOf(*leaf));
        known = leaf->_modelview.get();
        add({toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)), sceneFromLeaf});
    }
    if (anywhere) add(wholeView(view, sceneFromEye));
    std::sort(sized.begin(), sized.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<PlacedBox> result;
    result.reserve(boxes.size());
    for (const auto& [size, box] : sized) result.push_back(boxes[box]);
    return result;
}

} // namespace gnomon
