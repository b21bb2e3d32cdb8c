// SPDX-License-Identifier: MIT
#include <gnomon/geometry/Across.h>
#include <gnomon/silhouette/SightStart.h>
#include <gnomon/silhouette/StencilBatches.h>
#include <gnomon/volume/LightVolumes.h>
#include <gnomon/volume/VolumeView.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Where the volume of a part is across the light, in a plane of two coordinates; a lamp's are those of a globe.
PrismLayers layersOf(const LightVolumes& of, unsigned index, unsigned capacity) {
    const SilhouetteMesh::Part& part = of.caster().mesh->parts[index];
    const glm::dvec4& light = of.volumes().light;
    const glm::dvec3 low(part.low), high(part.high), middle = (low + high) / 2.0, half = (high - low) / 2.0;
    PrismLayers layers{glm::dvec2(-4.0), glm::dvec2(4.0), 1, std::min(of.volumes().parts[index].layers, capacity)};
    if (light.w == 0.0) {
        const auto [u, v] = across(glm::dvec3(light));
        const glm::dvec2 at(glm::dot(middle, u), glm::dot(middle, v)),
            reach(glm::dot(half, glm::abs(u)), glm::dot(half, glm::abs(v)));
        layers.low = at - reach;
        layers.high = at + reach;
        return layers;
    }
    const glm::dvec3 away = awayFrom(light, middle);
    const double distance = glm::length(away), radius = glm::length(half);
    if (!(distance > radius)) return layers;
    const double angle = std::asin(radius / distance), height = std::asin(std::clamp(away.z / distance, -1.0, 1.0));
    layers.low.y = height - angle;
    layers.high.y = height + angle;
    if (std::abs(height) + angle >= glm::half_pi<double>()) return layers;
    const double turn = std::asin(std::sin(angle) / std::cos(height)), azimuth = std::atan2(away.y, away.x);
    if (std::abs(azimuth) + turn > glm::pi<double>()) return layers;
    layers.low.x = azimuth - turn;
    layers.high.x = azimuth + turn;
    return layers;
}

void append(std::vector<VolumeGeometry::Range>& ranges, const VolumeGeometry::Range& range) {
    if (range.count == 0) return;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == range.first)
        ranges.back().count += range.count;
    else
        ranges.push_back(range);
}

const ShadowVolumes::Part& volumeOf(const SeenVolumes& all, const SeenPart& seen) {
    return all.meshes[seen.mesh].volumes->volumes().parts[seen.part];
}

void add(VolumeRound& round, const SeenVolumes& all, const SeenPart& seen) {
    VolumeRound::Share& share = round.shares[seen.mesh];
    const ShadowVolumes::Part& part = volumeOf(all, seen);
    VolumeRound::Sides& sides = seen.holding ? share.entered : share.left;
    append(part.grazed ? sides.grazed : sides.usual, {part.first, part.count});
    if (!seen.holding) append(seen.showsBack ? share.bothCaps : share.lightCaps, seen.caps.light);
    append(share.darkCaps, seen.caps.dark);
    if (seen.holding && seen.showsBack) append(share.backs, seen.caps.light);
    round.holding += seen.holding.value_or(0);
}

/// To those from `first` on that are counted from behind, or may be seen from there.
osg::ref_ptr<const VolumeGeometry> giveCaps(LightVolumes& volumes, std::vector<SeenPart>& parts, std::size_t first) {
    const SilhouetteMesh& mesh = *volumes.caster().mesh;
    const bool anyBack = std::any_of(parts.begin() + std::ptrdiff_t(first), parts.end(),
                                     [](const SeenPart& part) { return part.showsBack; });
    std::vector<CapsWanted> wanted;
    std::vector<SeenPart*> of; // those in view
    std::size_t next = first;
    for (unsigned i = 0; i < mesh.parts.size(); ++i) {
        SeenPart* seen = next < parts.size() && parts[next].part == i ? &parts[next++] : nullptr;
        const bool isClosed = seen && !seen->holding, showsBack = seen && seen->showsBack;
        // If one open part shows its back, the next view may have another: all of them are there then, and stay.
        if (!isClosed && !showsBack && !(anyBack && !mesh.parts[i].closed)) continue;
        wanted.push_back({i, isClosed});
        of.push_back(seen);
    }
    std::vector<CapRanges> ranges;
    osg::ref_ptr<const VolumeGeometry> caps = volumes.capsOf(wanted, ranges);
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i]) of[i]->caps = ranges[i];
    return caps;
}

/// Adds the parts of a mesh that can be seen.
void lookAt(LightVolumes& volumes, const glm::dmat4& clipFromScene, SeenVolumes& all) {
    const SilhouetteMesh& mesh = *volumes.caster().mesh;
    const glm::dmat4 clipFromMesh = clipFromScene * volumes.caster().sceneFromMesh;
    if (mesh.parts.empty()) return;
    const SightStart start(clipFromMesh, glm::dvec3(mesh.low), glm::dvec3(mesh.high));
    const std::size_t before = all.parts.size();
    for (unsigned i = 0; i < mesh.parts.size(); ++i) {
        const ShadowVolumes::Part& volume = volumes.volumes().parts[i];
        const VolumeHull hull = volumeHull(glm::dvec3(mesh.parts[i].low), glm::dvec3(mesh.parts[i].high), volume.end,
                                           volumes.volumes().light, clipFromMesh);
        const auto bounds = boundsOf(hull);
        if (!bounds) continue;
        const bool cut = std::any_of(hull.begin(), hull.begin() + 8, [](const auto& at) { return at.z <= -at.w; });
        const bool shows = isInSight(hull) && !volumes.caster().hides(mesh.parts[i], start.eye);
        const std::optional<int> holding =
            shows ? std::nullopt : volumesHolding(start, mesh, volumes.volumes(), i, cut);
        if (holding == 0 && volume.count == 0) continue;
        all.bounds = all.parts.empty() ? *bounds : united(all.bounds, *bounds);
        const bool showsBack = volumes.showsBack(start, i, cut);
        all.parts.push_back({all.meshes.size(), i, holding, showsBack, {}});
    }
    if (all.parts.size() == before) return;
    all.meshes.push_back({&volumes, clipFromMesh, giveCaps(volumes, all.parts, before)});
}

} // namespace

std::vector<VolumeRound> SeenVolumes::rounds(unsigned capacity) const {
    std::size_t layers = 0;
    for (const SeenPart& seen : parts) layers += volumeOf(*this, seen).layers;
    if (layers <= capacity) {
        std::vector<VolumeRound> all(1);
        for (const SeenPart& seen : parts) add(all.front(), *this, seen);
        return all;
    }
    std::vector<PrismLayers> prisms;
    for (const SeenPart& seen : parts) prisms.push_back(layersOf(*meshes[seen.mesh].volumes, seen.part, capacity));
    std::vector<VolumeRound> all;
    for (std::vector<LayerSlice>& round : stencilBatches(prisms, capacity)) {
        std::sort(round.begin(), round.end(),
                  [](const LayerSlice& a, const LayerSlice& b) { return a.tile < b.tile; }); // as they lie in memory
        all.emplace_back();
        for (const LayerSlice& slice : round) add(all.back(), *this, parts[slice.tile]);
    }
    return all;
}

bool SeenVolumes::overflow(unsigned capacity) const {
    return std::any_of(parts.begin(), parts.end(),
                       [&](const SeenPart& seen) { return volumeOf(*this, seen).layers > capacity; });
}

double SeenVolumes::vertexStep(double width, double near) const {
    double most = 0.0;
    for (const SeenPart& seen : parts) {
        const MeshInView& mesh = meshes[seen.mesh];
        const SilhouetteMesh::Part& part = mesh.volumes->caster().mesh->parts[seen.part];
        const glm::dvec3 low(part.low), high(part.high), away = glm::max(glm::max(low, -high), 0.0);
        const glm::dvec4 across = glm::row(mesh.clipFromMesh, 0), towards = glm::row(mesh.clipFromMesh, 3);
        const glm::dvec3 nearest = glm::mix(low, high, glm::lessThan(glm::dvec3(towards), glm::dvec3(0.0)));
        const double w = std::max(glm::dot(towards, glm::dvec4(nearest, 1.0)), near);
        const double step = std::max({away.x, away.y, away.z}) / (1 << 24);
        most = std::max(most, step * glm::length(glm::dvec3(across)) * width / 2.0 / w);
    }
    return most;
}

std::optional<SeenVolumes> seenVolumes(const std::vector<osg::ref_ptr<LightVolumes>>& all,
                                       const glm::dmat4& clipFromScene) {
    SeenVolumes result;
    for (const osg::ref_ptr<LightVolumes>& volumes : all) lookAt(*volumes, clipFromScene, result);
    if (result.parts.empty()) return std::nullopt;
    return result;
}

} // namespace gnomon
