// SPDX-License-Identifier: MIT
#include "TownControls.h"
#include "TownOptions.h"

#include <algorithm>
#include <cmath>

namespace gnomon::examples {
namespace {

constexpr double step = 0.5; // hours

std::string whole(double number) { return std::to_string(std::lround(number)); }

std::string clockTime(double hour) {
    const long minutes = std::lround(hour * 60.0);
    return std::to_string(minutes / 60) + (minutes % 60 < 10 ? ":0" : ":") + std::to_string(minutes % 60);
}

} // namespace

TownControls::TownControls(TownScene& town) : _town(town) {
    const ShadowSpec& given = town.view().shadows.front();
    for (const std::string& name : townTechniques()) {
        if (name == given.technique) _chosen = _choices.size();
        _choices.push_back(name == given.technique ? given : parseShadowSpec(name));
    }
}

void TownControls::nextTechnique() {
    _chosen = (_chosen + 1) % _choices.size();
    _town.setup().castAsComposed({_choices[_chosen]});
}

void TownControls::toggleComposite() { _town.setup().toggleComposite(); }

void TownControls::passTime(double hours) { _town.setHour(std::clamp(_town.hour() + hours, firstHour, lastHour)); }

std::vector<std::string> TownControls::describe() const {
    const bool blends = _town.setup().blends();
    const SunPosition sun = townSun(_town.hour());
    std::vector<std::string> lines = {"shadow: " + _choices[_chosen].text + " (n: next)",
                                      std::string("composite: ") + (blends ? "blend" : "relight") + " (r: the other)",
                                      "sun at " + clockTime(_town.hour()) + ": azimuth " + whole(sun.azimuth) +
                                          ", elevation " + whole(sun.elevation) + " degrees (j: earlier, k: later)",
                                      "h shows all keys, g hides this text"};
    for (const std::string& cause : _town.setup().diagnose()) lines.push_back(cause);
    return lines;
}

const std::vector<Key<TownControls>>& townKeys() {
    static const std::vector<Key<TownControls>> keys = {
        {'n', "Next shadow technique: none, box, hull.", [](TownControls& c, Hud&) { c.nextTechnique(); }},
        {'r', "Switch between relight and blend.", [](TownControls& c, Hud&) { c.toggleComposite(); }},
        {'j', "Half an hour earlier.", [](TownControls& c, Hud&) { c.passTime(-step); }},
        {'k', "Half an hour later.", [](TownControls& c, Hud&) { c.passTime(step); }},
        {'g', "Hide or show Gnomon's text.", [](TownControls&, Hud& hud) { hud.toggle(); }},
    };
    return keys;
}

} // namespace gnomon::examples
