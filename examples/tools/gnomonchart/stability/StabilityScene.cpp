// SPDX-License-Identifier: MIT
#include "StabilityScene.h"

#include "scenes/Sections.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {

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

} // namespace gnomon::examples
