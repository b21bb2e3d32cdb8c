// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/MapCasters.h>

#include <glm/common.hpp>

#include <unordered_set>

namespace gnomon {
namespace {

constexpr unsigned restAfter = 60; // changes of others: a second of a scene that moves

osg::ref_ptr<const MapLayer> layerOf(CasterPieces::List pieces, const MapCasters& casters) {
    return new MapLayer(std::move(pieces), casters.origin);
}

} // namespace

osg::ref_ptr<const MapCasters> MapCasters::of(const CasterPieces& pieces,
                                              const osg::ref_ptr<const MapCasters>& before) {
    if (before && before->pieces == &pieces) return before;
    const osg::ref_ptr<MapCasters> now = new MapCasters(pieces);
    before ? now->follow(*before) : now->begin();
    now->measure();
    return now;
}

void MapCasters::begin() {
    origin = pieces->bounds.center();
    CasterPieces::List all;
    for (const auto& piece : pieces->list)
        if (piece->bounds.valid()) all.push_back(piece);
    still = layerOf(std::move(all), *this);
    moving = layerOf({}, *this);
}

void MapCasters::follow(const MapCasters& before) {
    _change = before._change + 1;
    origin = before.origin;
    CasterPieces::List others;
    auto next = before.still->pieces.begin();
    const auto end = before.still->pieces.end();
    for (const auto& piece : pieces->list)
        if (next != end && *next == piece)
            ++next;
        else if (piece->bounds.valid())
            others.push_back(piece);
    std::size_t atRest = 0;
    for (const auto& piece : others) {
        const auto known = before._since.find(piece.get());
        _since.emplace(piece.get(), known == before._since.end() ? _change : known->second);
        if (isAtRest(piece.get())) atRest += piece->triangles;
    }
    const bool sameMoving = others == before.moving->pieces;
    _wasted = before._wasted + (sameMoving ? 0 : atRest);
    if (next != end || !isNear(origin) || _wasted > before.still->triangles + atRest) return divideAnew(before);
    still = before.still;
    moving = sameMoving ? before.moving : layerOf(std::move(others), *this);
}

void MapCasters::divideAnew(const MapCasters& before) {
    std::unordered_set<const CasterPiece*> stood;
    for (const auto& piece : before.still->pieces) stood.insert(piece.get());
    CasterPieces::List standing, others;
    for (const auto& piece : pieces->list) {
        if (!piece->bounds.valid()) continue;
        const bool stands = stood.count(piece.get()) > 0 || isAtRest(piece.get());
        (stands ? standing : others).push_back(piece);
        if (stands) _since.erase(piece.get());
    }
    _wasted = 0;
    if (!isNear(origin)) origin = pieces->bounds.center();
    still = layerOf(std::move(standing), *this);
    moving = layerOf(std::move(others), *this);
}

/// Whether floats about a place are as fine, but for a bit, as about the middle of all.
bool MapCasters::isNear(const osg::Vec3d& place) const {
    return pieces->empty() || (place - pieces->bounds.center()).length() <= pieces->bounds.radius();
}

bool MapCasters::isAtRest(const CasterPiece* piece) const {
    const auto since = _since.find(piece);
    return since != _since.end() && _change - since->second >= restAfter;
}

void MapCasters::measure() {
    if (pieces->empty()) return;
    low = toGlm(pieces->bounds._min - origin);
    high = toGlm(pieces->bounds._max - origin);
    reach = glm::max(glm::abs(low), glm::abs(high));
}

void MapCasters::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& layer : {still, moving}) layer->resizeGLObjectBuffers(maxSize);
}

void MapCasters::releaseGLObjects(osg::State* state) const {
    for (const auto& layer : {still, moving}) layer->releaseGLObjects(state);
}

} // namespace gnomon
