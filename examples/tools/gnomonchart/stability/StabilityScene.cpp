// SPDX-License-Identifier: MIT
#include "StabilityScene.h"
#include "../measure/ChartResults.h"
#include "scenes/SceneParts.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {
namespace {

/// A specification without keys; at its best, one that asks for smooth edges alone, too.
bool isJudged(const Contender& contender, bool best) {
    for (const auto& [name, value] : contender.settings) {
        const std::size_t keys = value.find(':');
        if (name == "--shadow" && keys != std::string::npos && !(best && value.substr(keys) == ":edges=smooth"))
            return false;
    }
    return true;
}

} // namespace

const std::vector<StabilityScene>& stabilityScenes() {
    static const std::vector<StabilityScene> all = [] {
        std::vector<StabilityScene> scenes;
        for (const auto section : {lightScenes, receiverScenes, numberScenes, mapScenes, blendingScenes, meshScenes})
            for (StabilityScene& scene : section()) scenes.push_back(std::move(scene));
        return scenes;
    }();
    return all;
}

std::vector<StabilityScene> stabilityScenes(const std::vector<std::string>& ids) {
    std::string allowed;
    for (const StabilityScene& scene : stabilityScenes()) allowed += " " + scene.id;
    for (const std::string& id : ids)
        if (std::none_of(stabilityScenes().begin(), stabilityScenes().end(), [&](const auto& s) { return s.id == id; }))
            throw std::invalid_argument("no scene of the stability table is \"" + id + "\". Allowed:" + allowed + ".");
    std::vector<StabilityScene> chosen;
    for (const StabilityScene& scene : stabilityScenes())
        if (ids.empty() || std::find(ids.begin(), ids.end(), scene.id) != ids.end()) chosen.push_back(scene);
    return chosen;
}

std::vector<Entrant> stabilityContenders(const std::vector<std::string>& parts, bool best) {
    std::vector<Entrant> chosen;
    for (Entrant& entrant : entrants(parts, best)) {
        if (!isJudged(entrant.contender, best)) continue;
        if (entrant.contender.kit == ourKit) entrant.contender.setting = "defaults";
        chosen.push_back(std::move(entrant));
    }
    if (chosen.empty())
        throw std::invalid_argument("no technique whose name contains \"" + parts.front() +
                                    "\" has defaults. See --list.");
    return chosen;
}

} // namespace gnomon::examples
