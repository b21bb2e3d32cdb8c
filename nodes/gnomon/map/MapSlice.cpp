// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/map/MapSlice.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon {
namespace {

constexpr double mostRatio = 1e6;      // of a lamp's distances: what is nearer is at the lamp itself
constexpr double widestRatio = 64.0;   // the same of what softens edges: by what is nearer they are as wide
constexpr double widestSpread = 128.0; // texels: as map_filter.frag has it

/// True of what the light sees edge-on, and of triangles of no area: hard edges have nothing between them.
bool isThin(const LightFrame& frame, const MapOutline& outline) {
    const glm::dvec2 size = fitMap(frame, outline, outline, 0.0, 0.0, 1.0).size;
    return std::min(size.x, size.y) <= 2e-6 * std::max(size.x, size.y); // fitMap() makes no side less than half of that
}

/// What a drawable of unknown bounds is taken for: it may be anywhere in the view.
MapReceiver wholeView(const ViewFrame& view, const glm::dmat4& sceneFromEye) {
    const glm::dmat4 eyeFromClip = glm::inverse(toGlm(view.projection));
    MapReceiver receiver{{glm::dvec3(std::numeric_limits<double>::infinity()), {}, sceneFromEye}, 0.0};
    receiver.high = -receiver.low;
    for (const glm::dvec4& corner : boxCorners(glm::dvec3(-1.0), glm::dvec3(1.0), eyeFromClip)) {
        receiver.low = glm::min(receiver.low, glm::dvec3(corner) / corner.w);
        receiver.high = glm::max(receiver.high, glm::dvec3(corner) / corner.w);
    }
    receiver.size = glm::distance(receiver.low, receiver.high);
    return receiver;
}

/// The same of each body: all of them may be thin together, for one is very far away.
bool areThin(const MapRequest& cause, const LightFrame& frame) {
    const auto isBoxThin = [&frame](const MapLayer::Box& box) {
        MapOutline outline(frame);
        outline.addBox({box.low, box.high});
        return outline.empty() || isThin(frame, outline);
    };
    const auto areAll = [&](const MapLayer& layer) {
        return std::all_of(layer.bodyBoxes.begin(), layer.bodyBoxes.end(), isBoxThin);
    };
    return areAll(*cause.casters->still) && areAll(*cause.casters->moving) &&
           std::all_of(cause.casters->own.begin(), cause.casters->own.end(),
                       [&](const OwnCaster& caster) { return isBoxThin(caster.box); });
}

LayerOutlines outlinesOf(const MapRequest& cause, const MapLayer& layer, const LightFrame& frame) {
    LayerOutlines outlines{MapOutline(frame), {}};
    for (const MapLayer::Box& box : layer.bodyBoxes) outlines.bodies.addBox({box.low, box.high});
    if (!cause.flats) return outlines;
    for (const MapLayer::Box& box : layer.flatBoxes) {
        outlines.flats.emplace_back(frame);
        outlines.flats.back().addBox({box.low, box.high});
    }
    return outlines;
}

} // namespace

/// Soft: penumbras of a pixel or two are wider than the filter.
double widestTexel(const ShadowMapOptions& options) {
    constexpr double plain = 1.5, fine = 0.7, soft = 0.33;
    if (options.edges == ShadowMapOptions::SOFT) return soft;
    return options.edges == ShadowMapOptions::SMOOTH && options.filter == ShadowMapOptions::FINE ? fine : plain;
}

double MapRequest::lightRadius(const LightFrame& frame) const {
    if (settings.edges != ShadowMapOptions::SOFT) return 0.0;
    if (frame.sun && light.w == 0.0) return std::tan(glm::radians(settings.sunAngle / 2.0));
    return settings.lampSize / 2.0 / (frame.sun ? glm::length(glm::dvec3(light)) : 1.0);
}

bool MapRequest::isWide(const LightFrame& frame) const {
    return settings.edges == ShadowMapOptions::SOFT && (lightRadius(frame) > 0.0 || settings.radius > 0.0);
}

double MapRequest::softness(const LightFrame& frame, MapOutline blocker, double farthest) const {
    blocker.limitNearest(widestRatio);
    return softReach(frame, blocker.nearest, farthest, lightRadius(frame), settings.radius);
}

std::vector<MapReceiver> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene) {
    const glm::dmat4 sceneFromEye = glm::inverse(eyeFromScene);
    std::vector<MapReceiver> result;
    bool anywhere = false;
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        anywhere = anywhere || !box.valid();
        if (!box.valid()) continue;
        MapReceiver receiver{
            {toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)), sceneFromEye * toGlm(modelviewOf(*leaf))}, 0.0};
        receiver.size = glm::length(glm::dvec3(receiver.sceneFromBox * glm::dvec4(receiver.high - receiver.low, 0.0)));
        result.push_back(receiver);
    }
    if (anywhere) result.push_back(wholeView(view, sceneFromEye));
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.size > b.size; });
    return result;
}

glm::dvec4 beyond(const MapLayer::Box& flat, const glm::dvec4& light, const glm::dvec3& reach) {
    const glm::dvec3 size = flat.high - flat.low;
    const int axis = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : 2;
    const double level = flat.low[axis], side = light[axis] - light.w * level > 0.0 ? 1.0 : -1.0;
    glm::dvec4 result(0.0, 0.0, 0.0, side * level - 1e-6 * glm::length(reach)); // what eye space makes of a place in it
    result[axis] = -side;
    return result;
}

MapSlice::MapSlice(const LightFrame& given, const MapRequest& cause)
    : frame(given), still(outlinesOf(cause, *cause.casters->still, given)), reach(given), needed(given), held(given) {
    takeBlockers(cause);
}

void MapSlice::clear() { reach = needed = held = MapOutline(frame); }

void MapSlice::takeStill(const MapRequest& cause) { still = outlinesOf(cause, *cause.casters->still, frame); }

/// Of those that are empty none, and none of what is flat and behind the bodies: it darkens nothing that they may not, but
/// widens edges where it is far from where they are.
void MapSlice::takeBlockers(const MapRequest& cause) {
    blockers.clear();
    const bool wide = cause.isWide(frame);
    const auto add = [&](const MapOutline& outline, const HalfSpaces& halfSpaces) {
        if (!outline.empty()) blockers.push_back({outline, halfSpaces});
    };
    const auto addFlats = [&](const LayerOutlines& outlines, const MapLayer& layer, const MapOutline& bodies) {
        for (std::size_t i = 0; i < outlines.flats.size(); ++i)
            if (wide || !(bodies.isBefore(outlines.flats[i]) || isThin(frame, outlines.flats[i])))
                add(outlines.flats[i], {beyond(layer.flatBoxes[i], cause.light, cause.casters->layers->reach)});
    };
    const LayerOutlines moving = outlinesOf(cause, *cause.casters->moving, frame);
    MapOutline bodies = still.bodies;
    bodies.merge(moving.bodies);
    for (const OwnCaster& caster : cause.casters->own) bodies.addBox({caster.box.low, caster.box.high});
    if (!bodies.empty() && (wide || !isThin(frame, bodies) || !areThin(cause, frame))) add(bodies, {});
    addFlats(still, *cause.casters->still, bodies);
    addFlats(moving, *cause.casters->moving, bodies);
}

void MapSlice::find(const MapRequest& cause, const std::vector<MapReceiver>& receivers, const HalfSpaces& halfSpaces,
                    TexelDensity pixels, int texels) {
    clear();
    for (const MapBlocker& blocker : blockers)
        addNeeded(cause, blocker, receivers, both(halfSpaces, blocker.halfSpaces), pixels);
    texel = pixels.side;
    needed.limitNearest(mostRatio);
    findHeld(cause, texels);
}

/// Of edges that are wider than the filter: what is about each place, too, and how far away what blocks the light is.
void MapSlice::findHeld(const MapRequest& cause, int texels) {
    held = needed;
    if (needed.empty()) return;
    if (!cause.isWide(frame)) {
        if (isAlone) // what is farther than all that blocks the light, a sky say, is compared as if it were there
            held.farthest = std::min(needed.farthest, std::max(needed.nearest, reach.farthest));
        return;
    }
    const double most = 1.5 * widestSpread / texels * needed.length(); // a map so much larger has wider texels
    MapOutline blocking = reach;
    blocking.nearest = nearestBlocker;
    held.grow(std::min(cause.softness(frame, blocking, needed.farthest), most));
    held.cut(reach);
    blocking.farthest = needed.farthest;
    blocking.limitNearest(widestRatio);
    held.nearest = std::min(held.nearest, blocking.nearest);
}

/// What of what one of them can darken is seen.
void MapSlice::addNeeded(const MapRequest& cause, const MapBlocker& blocker, const std::vector<MapReceiver>& receivers,
                         HalfSpaces halfSpaces, TexelDensity& pixels) {
    const auto add = [&](auto& to) {
        for (const MapReceiver& receiver : receivers) to.addBox(receiver, halfSpaces);
    };
    MapOutline dark = blocker.outline, seen(frame);
    if (cause.isWide(frame)) {
        MapOutline all(frame);
        add(all);
        if (all.empty()) return;
        dark.grow(cause.softness(frame, blocker.outline, all.farthest));
    }
    if (frame.sun) halfSpaces = both(std::move(halfSpaces), dark.sides()); // a lamp's have sides of their own
    add(seen);
    seen.cut(dark);
    if (seen.empty()) return;
    add(pixels);
    nearestBlocker = needed.empty() ? blocker.outline.nearest : std::min(nearestBlocker, blocker.outline.nearest);
    needed.merge(seen);
    reach.merge(dark);
}

} // namespace gnomon
