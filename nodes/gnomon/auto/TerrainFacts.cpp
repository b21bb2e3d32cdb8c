// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/TerrainFacts.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon {
namespace {

constexpr double steepShare = 0.8;      // of the light's slope: ground as steep as that shadows itself soon
constexpr std::size_t mostSamples = 64; // casters that are asked for the ground below their shadows

/// How far the ground lies off the straight line between both ends of a shadow, half-way.
std::optional<double> bend(const Ground& ground, const osg::BoundingBoxd& caster, const glm::dvec2& away) {
    const osg::Vec3d centre = caster.center();
    const glm::dvec2 from(centre.x(), centre.y()), to = from + (caster.zMax() - caster.zMin()) * away;
    const glm::dvec2 middle = (from + to) / 2.0;
    const auto a = ground.height(from.x, from.y), b = ground.height(middle.x, middle.y), c = ground.height(to.x, to.y);
    if (!a || !b || !c) return std::nullopt;
    return std::abs(*b - (*a + *c) / 2.0);
}

} // namespace

TerrainFacts TerrainKnowledge::of(const AutoView& view, const Selection& receiver) {
    TerrainFacts facts;
    if (!hasPart(OptionalPart::Terrain)) {
        facts.obstacle = "this build has no Qhull";
        return facts;
    }
    const glm::dvec3 sun(view.towards);
    const double across = glm::length(glm::dvec2(sun));
    if (!view.frame.receivers) facts.obstacle = "no terrain is named as receiver";
    if (facts.obstacle.empty() && !(view.towards.w == 0.0 && sun.z > 0.0))
        facts.obstacle = "the light is no sun above the horizon";
    const std::string cutOut = whyCutOut(view.casters);
    if (!cutOut.empty()) facts.obstacle = cutOut;
    if (!facts.obstacle.empty()) return facts;
    _drawn = TerrainPlace::inFrameOf(*view.frame.group, receiver).drawn(_drawn);
    const Ground& ground = *_drawn->ground;
    const double slope = _drawn->steepest;
    if (_drawn->isAsSteepAs(sun, steepShare)) {
        facts.obstacle = "the terrain is so steep that it may shadow itself";
        return facts;
    }
    std::vector<double> bends;
    const std::size_t step = view.casters.list.size() / mostSamples + 1;
    for (std::size_t i = 0; i < view.casters.list.size(); i += step) {
        const CasterDrawable& piece = *view.casters.list[i];
        if (!piece.bounds.valid() || _drawn->drawables.count(piece.drawable.get())) continue;
        if (const auto found = bend(ground, piece.bounds, -glm::dvec2(sun) / sun.z)) bends.push_back(*found);
    }
    std::sort(bends.begin(), bends.end());
    const double rise = bends.empty() ? 0.0 : bends[std::size_t(0.95 * double(bends.size() - 1))];
    facts.off = rise / std::max(sun.z / std::max(across, 1e-12) - slope, 1e-3);
    return facts;
}

} // namespace gnomon
