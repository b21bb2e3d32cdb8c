// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/casters/KnownCasters.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

namespace gnomon {
namespace {

constexpr unsigned restAfter = 60; // changes of others: a second of a scene that moves

constexpr double farthest = 64.0; // as CasterMesh

/// The middle one of a measure of the drawables, each as often as it has triangles.
template <class Measure>
double middleOf(const Casters& pieces, Measure measure) {
    std::vector<std::pair<double, std::size_t>> all;
    std::size_t triangles = 0;
    for (const auto& piece : pieces.list) {
        if (!piece->bounds.valid()) continue;
        all.emplace_back(measure(*piece), piece->triangles);
        triangles += piece->triangles;
    }
    std::sort(all.begin(), all.end());
    std::size_t before = 0;
    for (const auto& [value, count] : all)
        if (2 * (before += count) >= triangles) return value;
    return 0.0;
}

/// With what draws itself.
osg::BoundingBoxd boundsOf(const Casters& pieces) {
    osg::BoundingBoxd bounds = pieces.bounds;
    for (const auto& drawing : pieces.selfDrawings) bounds.expandBy(drawing->bounds);
    return bounds;
}

/// As CasterExtraction::getRounding() has it.
double roundingOf(const Caster& piece) {
    const osg::BoundingBox& box = piece.drawable->getBoundingBox();
    if (!box.valid()) return 0.0;
    const glm::dmat3 axes(toGlm(piece.groupFromLocal));
    const glm::dvec3 step = glm::max(glm::abs(toGlm(osg::Vec3d(box._min))), glm::abs(toGlm(osg::Vec3d(box._max)))) *
                            (std::numeric_limits<float>::epsilon() / 2.0);
    return glm::length(glm::abs(axes[0]) * step.x + glm::abs(axes[1]) * step.y + glm::abs(axes[2]) * step.z);
}

} // namespace

CasterLayer::CasterLayer(CasterList given, const osg::Vec3d& about, KnownCasters& known,
                         const std::vector<const CasterLayer*>& before)
    : pieces(std::move(given)), origin(about) {
    std::vector<PlacedMesh> placed;
    for (const auto& piece : pieces) {
        triangles += piece->triangles;
        std::optional<PlacedMesh> body;
        if (isBody(*piece)) body = known.placed(*piece, origin);
        if (body)
            placed.push_back(*std::move(body));
        else
            loosePieces.push_back(piece);
    }
    join(before);
    meshes.insert(meshes.end(), placed.begin(), placed.end());
}

void CasterLayer::join(const std::vector<const CasterLayer*>& before) {
    if (loosePieces.empty()) return;
    const auto same = std::find_if(before.begin(), before.end(), [this](const CasterLayer* layer) {
        return layer && layer->origin == origin && layer->loosePieces == loosePieces;
    });
    loose = same != before.end() ? (*same)->loose : meshOf(loosePieces, origin);
    loose->sources.clear(); // the pieces hold them
    PlacedMesh joined{loose, glm::dmat4(1.0), false, false, 1.0, loose->rounding, Hiding::Both, loose->bounds};
    if (!loose->triangles->empty()) meshes.push_back(joined);
}

CasterLayers::CasterLayers(const Casters& casters, const CasterLayers* before, KnownCasters& known)
    : _casters(casters) {
    before ? follow(*before, known) : begin(known);
    measure();
}

std::vector<PlacedMesh> CasterLayers::meshes() const {
    std::vector<PlacedMesh> all = still->meshes;
    all.insert(all.end(), moving->meshes.begin(), moving->meshes.end());
    return all;
}

void CasterLayers::begin(KnownCasters& known) {
    origin = middle();
    CasterList all;
    for (const auto& piece : _casters.list)
        if (piece->bounds.valid()) all.push_back(piece);
    still = new CasterLayer(std::move(all), origin, known, {});
    moving = new CasterLayer({}, origin, known, {});
}

void CasterLayers::follow(const CasterLayers& before, KnownCasters& known) {
    _change = before._change + 1;
    origin = before.origin;
    CasterList others;
    auto next = before.still->pieces.begin();
    const auto end = before.still->pieces.end();
    for (const auto& piece : _casters.list)
        if (next != end && *next == piece)
            ++next;
        else if (piece->bounds.valid())
            others.push_back(piece);
    std::size_t atRest = 0;
    for (const auto& piece : others) {
        const auto since = before._since.find(piece.get());
        _since.emplace(piece.get(), since == before._since.end() ? _change : since->second);
        if (isAtRest(piece.get())) atRest += piece->triangles;
    }
    const bool sameMoving = others == before.moving->pieces;
    _wasted = before._wasted + (sameMoving ? 0 : atRest);
    if (next != end || !isNear(origin) || _wasted > before.still->triangles + atRest) return divideAnew(before, known);
    still = before.still;
    moving = sameMoving ? before.moving : new CasterLayer(std::move(others), origin, known, {before.moving});
}

void CasterLayers::divideAnew(const CasterLayers& before, KnownCasters& known) {
    std::unordered_set<const Caster*> stood;
    for (const auto& piece : before.still->pieces) stood.insert(piece.get());
    CasterList standing, others;
    for (const auto& piece : _casters.list) {
        if (!piece->bounds.valid()) continue;
        const bool stands = stood.count(piece.get()) > 0 || isAtRest(piece.get());
        (stands ? standing : others).push_back(piece);
        if (stands) _since.erase(piece.get());
    }
    _wasted = 0;
    if (!isNear(origin)) origin = middle();
    const std::vector<const CasterLayer*> former{before.still, before.moving};
    still = new CasterLayer(std::move(standing), origin, known, former);
    moving = new CasterLayer(std::move(others), origin, known, former);
}

/// The centre of all, unless a few are so far that floats about it were coarse for the others: then a place among most.
osg::Vec3d CasterLayers::middle() const {
    const osg::BoundingBoxd all = boundsOf(_casters);
    if (!all.valid()) return {};
    if (_casters.empty()) return all.center();
    osg::Vec3d among;
    for (int axis = 0; axis < 3; ++axis)
        among[axis] = middleOf(_casters, [axis](const Caster& piece) { return piece.bounds.center()[axis]; });
    const double most = middleOf(_casters, [&among](const Caster& piece) {
        return (piece.bounds.center() - among).length() + piece.bounds.radius();
    });
    return _casters.bounds.radius() <= farthest * most ? osg::Vec3d(_casters.bounds.center()) : among;
}

/// Whether floats about a place are as fine, but for a bit, as about the middle of all.
bool CasterLayers::isNear(const osg::Vec3d& place) const {
    const osg::BoundingBoxd all = boundsOf(_casters);
    return !all.valid() || (place - all.center()).length() <= all.radius();
}

bool CasterLayers::isAtRest(const Caster* piece) const {
    const auto since = _since.find(piece);
    return since != _since.end() && _change - since->second >= restAfter;
}

void CasterLayers::measure() {
    bounds = boundsOf(_casters);
    if (!bounds.valid()) return;
    low = toGlm(bounds._min - origin);
    high = toGlm(bounds._max - origin);
    reach = glm::max(glm::abs(low), glm::abs(high));
    for (const auto& drawing : _casters.selfDrawings)
        if (drawing->bounds.valid()) widest = widestUnflat = std::max(widest, 2.0 * drawing->bounds.radius());
    double least = std::numeric_limits<double>::infinity();
    for (const auto& piece : _casters.list) {
        if (!piece->bounds.valid()) continue;
        widest = std::max(widest, 2.0 * piece->bounds.radius());
        const osg::Vec3f lowest(piece->bounds._min - origin), highest(piece->bounds._max - origin);
        const bool isFlat = lowest.x() == highest.x() || lowest.y() == highest.y() || lowest.z() == highest.z();
        if (!isFlat) widestUnflat = std::max(widestUnflat, 2.0 * piece->bounds.radius());
        const double ofPiece = roundingOf(*piece);
        rounding = std::max(rounding, ofPiece);
        least = std::min(least, ofPiece);
    }
    // One large ground must not cost what stands on it the light beside its shadows.
    if (rounding > 2.0 * least) rounding = middleOf(_casters, roundingOf);
    for (const auto& layer : {still, moving})
        for (const PlacedMesh& mesh : layer->meshes) largestRounding = std::max(largestRounding, mesh.rounding);
}

} // namespace gnomon
