// SPDX-License-Identifier: MIT
#include "StabilityChild.h"

#include "../measure/Complaints.h"
#include "SceneSweep.h"
#include "StabilityFiles.h"

namespace gnomon::examples {
namespace {

using nlohmann::json;
using Say = std::function<void(const json&)>;

class SceneChild {
public:
    SceneChild(const StabilityPlan& plan, const StabilityScene& scene, const Say& say)
        : _scene(scene), _say(say), _sweep(plan, scene) {}

    void measure(std::size_t number, const StabilityContender& entry, int from, const Settings& known) {
        Contender contender = entry.contender;
        if (entry.sought) contender = sought(number, *entry.sought, from, known);
        SceneSweep::Run run(_sweep, contender);
        std::vector<StabilityCell> cells;
        for (int place = std::max(from, 0); place < int(_scene.values.size()); ++place) {
            _say(StabilityLines::begin({number, place}));
            StabilityCell cell = run.cell(std::size_t(place));
            cell.notes = _complaints.take();
            _say(StabilityLines::cell(cell));
            cells.push_back(std::move(cell));
        }
        const std::optional<std::size_t> filmed = filmedAt(cells);
        if (from > 0 || !filmed) return;
        _say(StabilityLines::film({number, int(*filmed)}));
        _say(StabilityLines::flicker(run.flicker(*filmed)));
    }

private:
    Contender sought(std::size_t number, const Peer& peer, int from, const Settings& known) {
        if (from >= 0) return peerContender(peer, "best", known);
        _say(StabilityLines::begin({number, -1}));
        const Settings best = _sweep.bestSettings(peer);
        _complaints.take(); // of settings that lost
        _say(StabilityLines::settings(best));
        return peerContender(peer, "best", best);
    }

    const StabilityScene& _scene;
    const Say& _say;
    SceneSweep _sweep;
    Complaints _complaints;
};

} // namespace

json StabilityLines::begin(const StabilityPlace& place) { return {{"begin", {place.contender, place.value}}}; }
json StabilityLines::cell(const StabilityCell& cell) { return {{"cell", jsonOf(cell)}}; }
json StabilityLines::settings(const Settings& settings) { return {{"settings", settings}}; }
json StabilityLines::film(const StabilityPlace& place) { return {{"film", {place.contender, place.value}}}; }
json StabilityLines::flicker(const StabilityFlicker& flicker) { return {{"flicker", jsonOf(flicker)}}; }

void measureScene(const StabilityPlan& plan, const StabilityScene& scene, StabilityPlace from, const Settings& settings,
                  const Say& say) {
    SceneChild child(plan, scene, say);
    for (std::size_t number = from.contender; number < plan.contenders.size(); ++number)
        child.measure(number, plan.contenders[number], number == from.contender ? from.value : -1, settings);
}

} // namespace gnomon::examples
