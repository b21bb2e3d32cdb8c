// SPDX-License-Identifier: MIT
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/auto/InnerTechniques.h>

namespace gnomon {
namespace {

using Kind = AutoCandidate::Kind;

constexpr unsigned keptRounds = 60; // techniques that no view has chosen since are let go, with all that they keep

osg::ref_ptr<ShadowTechnique> make(const AutoCandidate& candidate) {
    if (candidate.kind == Kind::Volume) return new ShadowVolumeTechnique;
    if (candidate.kind == Kind::Traced) return new TracedShadowTechnique;
    if (candidate.kind == Kind::Terrain) {
        osg::ref_ptr<TerrainShadowGeode> terrain = new TerrainShadowGeode;
        terrain->setMethod(TerrainShadowOptions::HULL);
        return terrain;
    }
    if (candidate.kind == Kind::Map) {
        osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
        map->setOptions(candidate.map);
        return map;
    }
    osg::ref_ptr<PlanarShadowNode> planar = new PlanarShadowNode;
    planar->setPlanes(candidate.planes);
    return planar;
}

} // namespace

osg::ref_ptr<const ShadowTechnique> InnerTechniques::of(const AutoCandidate& candidate, const Selection& receiver,
                                                        unsigned round) {
    if (candidate.kind == Kind::Nothing) return nullptr;
    Made* made = _made.find([&](const Made& entry) {
        return entry.candidate.isSame(candidate) && entry.candidate.planes == candidate.planes &&
               entry.receiver == receiver;
    });
    if (!made) {
        made = &_made.add({candidate, receiver, make(candidate), round});
        made->technique->setReceiver(receiver);
    }
    made->lastRound = round;
    const osg::ref_ptr<const ShadowTechnique> result = made->technique;
    _made.dropWhile([this, round](const Made& entry) {
        const bool isOld = round - entry.lastRound > keptRounds;
        if (isOld) _passesOfGone += entry.technique->passes();
        return isOld;
    });
    return result;
}

void InnerTechniques::clear() {
    _passesOfGone = passes();
    _made = {};
}

unsigned InnerTechniques::passes() const {
    unsigned all = _passesOfGone;
    for (const Made& made : _made) all += made.technique->passes();
    return all;
}

void InnerTechniques::forEach(const std::function<void(ShadowTechnique&)>& visit) const {
    for (const Made& made : _made) visit(*made.technique);
}

} // namespace gnomon
