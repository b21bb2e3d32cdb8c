// SPDX-License-Identifier: MIT
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/auto/AutoCandidate.h>

namespace gnomon {
namespace {

/// "NAME", or "NAME:key=value,key=value".
class SpecText {
public:
    explicit SpecText(const char* name) : _text(name) {}
    void add(const char* key, const std::string& value) {
        _text += (_any ? "," : ":") + (key + ("=" + value));
        _any = true;
    }
    const std::string& text() const { return _text; }

private:
    std::string _text;
    bool _any = false;
};

std::string specOf(const ShadowMapOptions& map) {
    constexpr const char* filters[] = {"nearest", "bilinear", "bicubic", "fine"};
    const ShadowMapOptions plain;
    SpecText text("map");
    if (map.size != plain.size) text.add("size", std::to_string(map.size));
    if (map.filter != plain.filter) text.add("filter", filters[map.filter]);
    if (map.cascades != plain.cascades) text.add("cascades", std::to_string(map.cascades));
    if (map.edges == ShadowMapOptions::SMOOTH) text.add("edges", "smooth");
    return text.text();
}

using Kind = AutoCandidate::Kind;

constexpr unsigned keptRounds = 60; // techniques that no view has chosen since are let go, with all that they keep

template <typename Technique>
osg::ref_ptr<ShadowTechnique> exact(const AutoCandidate& candidate) {
    osg::ref_ptr<Technique> technique = new Technique;
    technique->setEdges(candidate.smooth ? Technique::SMOOTH : Technique::HARD);
    return technique;
}

osg::ref_ptr<ShadowTechnique> make(const AutoCandidate& candidate) {
    if (candidate.kind == Kind::Volume) return exact<ShadowVolumeTechnique>(candidate);
    if (candidate.kind == Kind::Traced) return exact<TracedShadowTechnique>(candidate);
    if (candidate.kind == Kind::Terrain) return exact<TerrainShadowGeode>(candidate); // by hull
    osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
    map->setOptions(candidate.map);
    return map;
}

} // namespace

std::string AutoCandidate::spec() const {
    const std::string edges = smooth ? ":edges=smooth" : "";
    switch (kind) {
    case Kind::Terrain:
        return "hull" + edges;
    case Kind::Map:
        return specOf(map);
    case Kind::Volume:
        return "volume" + edges;
    case Kind::Traced:
        return "traced" + edges;
    default:
        return "none";
    }
}

bool AutoCandidate::isSame(const AutoCandidate& other) const {
    if (kind != other.kind || smooth != other.smooth) return false;
    return kind != Kind::Map || (map.size == other.map.size && map.filter == other.map.filter &&
                                 map.cascades == other.map.cascades && map.edges == other.map.edges);
}

double AutoCandidate::time(const RendererRates& rates, const AutoMotion& motion) const {
    return timeOf(still, rates) + motion.light * timeOf(light, rates) + motion.casters * timeOf(casters, rates) +
           motion.view * timeOf(view, rates);
}

ShadowCandidate AutoCandidate::judged(const RendererRates& rates, const AutoMotion& motion) const {
    return {spec(),  error, time(rates, motion), time(rates, {}), time(rates, {0.0, 0.0, 1.0}), time(rates, {1.0}),
            obstacle};
}

osg::ref_ptr<const ShadowTechnique> InnerTechniques::of(const AutoCandidate& candidate, const Selection& receiver,
                                                        unsigned round) {
    if (candidate.kind == Kind::Nothing) return nullptr;
    Made* made =
        _made.find([&](const Made& entry) { return entry.candidate.isSame(candidate) && entry.receiver == receiver; });
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
