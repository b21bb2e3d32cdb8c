// SPDX-License-Identifier: MIT
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/base/NumberText.h>

namespace gnomon {
namespace {

constexpr double refits = 0.15; // share of the frames of a moving view in which a map is drawn again

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

std::string specOf(const TerrainShadowOptions& terrain) {
    SpecText text(terrain.method == TerrainShadowOptions::HULL ? "hull" : "drape");
    if (terrain.error != TerrainShadowOptions().error) text.add("error", textOf(terrain.error));
    return text.text();
}

} // namespace

std::string AutoCandidate::spec() const {
    switch (kind) {
    case Kind::Planar:
        return "planar";
    case Kind::Terrain:
        return specOf(terrain);
    case Kind::Map:
        return specOf(map);
    case Kind::Mixed:
        return "volume+" + specOf(map);
    case Kind::Volume:
        return "volume";
    case Kind::Traced:
        return "traced";
    default:
        return "none";
    }
}

bool AutoCandidate::isSame(const AutoCandidate& other) const {
    if (kind != other.kind) return false;
    if (kind == Kind::Terrain) return terrain.method == other.terrain.method && terrain.error == other.terrain.error;
    return !hasMap() || (map.size == other.map.size && map.filter == other.map.filter &&
                         map.cascades == other.map.cascades && map.edges == other.map.edges);
}

double AutoCandidate::time(const AutoCosts& costs, const AutoMotion& motion) const {
    const AutoCosts::Factors& factors = costs.factors[std::size_t(kind)];
    const double drawn = timeOf(still, costs.rates), changed = timeOf(change, costs.rates);
    const double refitted = hasMap() ? refits * motion.view * changed : 0.0;
    const double atRest = (1.0 - motion.scene) * drawn + refitted, moving = motion.scene * (drawn + changed);
    return factors.still * atRest + factors.moving * moving;
}

ShadowCandidate AutoCandidate::judged(const AutoCosts& costs, const AutoMotion& motion) const {
    return {spec(),
            error,
            time(costs, motion),
            time(costs, {}),
            time(costs, {0.0, 1.0}),
            time(costs, {1.0, 0.0}),
            obstacle,
            kind == Kind::Mixed};
}

} // namespace gnomon
