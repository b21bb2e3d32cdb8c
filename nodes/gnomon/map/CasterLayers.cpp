// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/map/CasterLayers.h>

#include <glm/common.hpp>

#include <unordered_set>

namespace gnomon {
namespace {

constexpr unsigned restAfter = 60; // changes of others: a second of a scene that moves

osg::ref_ptr<const CasterLayer> layerOf(CasterDrawables::List pieces, const CasterLayers& casters) {
    return new CasterLayer(std::move(pieces), casters.origin);
}

} // namespace

osg::ref_ptr<const CasterLayers> CasterLayers::of(const CasterDrawables& pieces,
                                                  const osg::ref_ptr<const CasterLayers>& before) {
    if (before && before->pieces == &pieces) return before;
    const osg::ref_ptr<CasterLayers> now = new CasterLayers(pieces);
    before ? now->follow(*before) : now->begin();
    now->measure();
    return now;
}

void CasterLayers::begin() {
    origin = pieces->bounds.center();
    CasterDrawables::List all;
    for (const auto& piece : pieces->list)
        if (piece->bounds.valid()) all.push_back(piece);
    still = layerOf(std::move(all), *this);
    moving = layerOf({}, *this);
}

void CasterLayers::follow(const CasterLayers& before) {
    _change = before._change + 1;
    origin = before.origin;
    CasterDrawables::List others;
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

void CasterLayers::divideAnew(const CasterLayers& before) {
    std::unordered_set<const CasterDrawable*> stood;
    for (const auto& piece : before.still->pieces) stood.insert(piece.get());
    CasterDrawables::List standing, others;
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
bool CasterLayers::isNear(const osg::Vec3d& place) const {
    return pieces->empty() || (place - pieces->bounds.center()).length() <= pieces->bounds.radius();
}

bool CasterLayers::isAtRest(const CasterDrawable* piece) const {
    const auto since = _since.find(piece);
    return since != _since.end() && _change - since->second >= restAfter;
}

void CasterLayers::measure() {
    if (pieces->empty()) return;
    low = toGlm(pieces->bounds._min - origin);
    high = toGlm(pieces->bounds._max - origin);
    reach = glm::max(glm::abs(low), glm::abs(high));
}

void CasterLayers::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& layer : {still, moving}) layer->resizeGLObjectBuffers(maxSize);
}

void CasterLayers::releaseGLObjects(osg::State* state) const {
    for (const auto& layer : {still, moving}) layer->releaseGLObjects(state);
}

} // namespace gnomon
