// SPDX-License-Identifier: MIT
#include "ShadowControls.h"

#include <gnomon/ShadowVolumeTechnique.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::examples {
namespace {

std::string whole(double number) { return std::to_string(std::lround(number)); }

/// The same moment by day, in the night the next minute of sunshine; within the polar night the same time of the next day.
double nextDaylight(const SunClock& clock, double day) {
    constexpr int minutes = 24 * 60;
    for (int i = 0; i < minutes && !(clock.at(day).elevation > 0.0); ++i) day += 1.0 / minutes;
    return day;
}

/// 0 to 360.
double compass(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

constexpr double step = 5.0; // degrees

} // namespace

ShadowControls::ShadowControls(const ViewOptions& options, SceneSetup& setup) : _setup(setup), _sun(options.sun) {
    if (!options.shadows.empty()) {
        _view = options.shadows.front().map.view;
        _showsVolumes = options.shadows.front().volume.view == ShadowVolumeOptions::VOLUMES;
    }
    const std::string given = options.shadows.empty() ? "none" : options.shadows.front().technique;
    for (const std::string& name : shadowTechniques()) {
        if (name == given) _chosen = _choices.size();
        const bool asGiven = name == given && !options.shadows.empty();
        _choices.push_back(asGiven ? options.shadows : Specs{parseShadowSpec(name)});
    }
}

void ShadowControls::nextTechnique() {
    _chosen = (_chosen + 1) % _choices.size();
    cast();
    applySwitches();
}

void ShadowControls::cast() {
    _refusal.clear();
    try {
        _setup.castAsComposed(_choices[_chosen]);
    } catch (const std::invalid_argument& error) {
        _refusal = error.what();
    }
}

void ShadowControls::toggleComposite() { _setup.toggleComposite(); }

void ShadowControls::turnLight(double degrees) {
    _moved.azimuth = compass(_moved.azimuth + degrees);
    _setup.lights->move(_moved, _setup.bounds.center());
}

void ShadowControls::raiseLight(double degrees) {
    const auto given = _setup.lights->given(_setup.bounds.center());
    if (!given) return;
    _moved.elevation = std::clamp(_moved.elevation + degrees, -90.0 - given->elevation, 90.0 - given->elevation);
    _setup.lights->move(_moved, _setup.bounds.center());
}

void ShadowControls::runSun(double seconds) {
    const auto given = _setup.lights->given(_setup.bounds.center());
    if (!_sun || !given) return;
    _sun->day = nextDaylight(_sun->clock, _sun->day + seconds / 86400.0);
    const SunPosition now = _sun->clock.at(_sun->day);
    _moved = {compass(now.azimuth - given->azimuth), std::max(now.elevation, 0.0) - given->elevation};
    _setup.lights->move(_moved, _setup.bounds.center());
}

/// Of the technique that is shown.
void ShadowControls::nextView() {
    if (draws<ShadowVolumeTechnique>()) _showsVolumes = !_showsVolumes;
    if (!draws<ShadowMapTechnique>()) {
        if (!draws<ShadowVolumeTechnique>())
            _refusal = "v shows how maps and volumes lie: press n until map or volume casts";
        return applySwitches();
    }
    using Map = ShadowMapTechnique;
    _view = _view == Map::NOTHING  ? Map::MAP
            : _view == Map::MAP    ? Map::TEXELS
            : _view == Map::TEXELS ? Map::CASCADES
                                   : Map::NOTHING;
    applySwitches();
}

void ShadowControls::applySwitches() {
    for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques) {
        if (auto* map = dynamic_cast<ShadowMapTechnique*>(technique.get())) map->setView(_view);
        if (auto* volume = dynamic_cast<ShadowVolumeTechnique*>(technique.get()))
            volume->setView(_showsVolumes ? ShadowVolumeTechnique::VOLUMES : ShadowVolumeTechnique::NOTHING);
    }
}

void ShadowControls::toggleReports() {
    _showsReports = !_showsReports;
    _setup.diagnose(); // describe() tells what the next frame finds
}

std::vector<std::string> ShadowControls::describe() const {
    std::vector<std::string> lines = {"shadow: " + describeShadow(), "light: " + describeLight()};
    if (_showsReports)
        for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques) {
            for (const ShadowDecision& decision : technique->lastDecision()) lines.push_back(decision.text());
            lines.push_back(technique->lastReport().text());
        }
    lines.push_back("h shows all keys, g hides this text");
    if (!_refusal.empty()) lines.push_back(_refusal);
    if (const std::string low = _setup.lowLight(); !low.empty()) lines.push_back(low);
    for (const std::string& cause : _setup.causes()) lines.push_back(cause);
    return lines;
}

/// "auto, which takes volume, relight".
std::string ShadowControls::describeShadow() const {
    std::string taken;
    for (const osg::ref_ptr<ShadowTechnique>& technique : _setup.techniques)
        for (const ShadowDecision& decision : technique->lastDecision())
            if (const std::string& spec = decision.chosen.spec; taken.find(spec) == std::string::npos)
                taken += (taken.empty() ? ", which takes " : " and ") + spec;
    return techniqueNames(_choices[_chosen]) + taken + ", " + (_setup.blends() ? "blend" : "relight");
}

std::string ShadowControls::describeLight() const {
    const auto given = _setup.lights->given(_setup.bounds.center());
    if (!given) return "the scene's own, which cannot be moved";
    return (_sun ? momentOf(_sun->day) + ", " : "") + "azimuth " + whole(compass(given->azimuth + _moved.azimuth)) +
           ", elevation " + whole(given->elevation + _moved.elevation) + " degrees";
}

const std::vector<Key<ShadowControls>>& shadowKeys() {
    static const std::vector<Key<ShadowControls>> keys = {
        {'n', "Next shadow technique, or none.", [](ShadowControls& c, Hud&) { c.nextTechnique(); }},
        {'r', "Switch between relight and blend.", [](ShadowControls& c, Hud&) { c.toggleComposite(); }},
        {'j', "Turn the light 5 degrees anticlockwise, seen from above.",
         [](ShadowControls& c, Hud&) { c.turnLight(-step); }},
        {'k', "Turn the light 5 degrees clockwise.", [](ShadowControls& c, Hud&) { c.turnLight(step); }},
        {'u', "Raise the light 5 degrees.", [](ShadowControls& c, Hud&) { c.raiseLight(step); }},
        {'d', "Lower the light 5 degrees.", [](ShadowControls& c, Hud&) { c.raiseLight(-step); }},
        {'v', "Show shadow maps, their texels, their cascades; or shadow volumes; or nothing.",
         [](ShadowControls& c, Hud&) { c.nextView(); }},
        {'i', "Show or hide what each technique did in the last frame, and look anew for what takes long to find.",
         [](ShadowControls& c, Hud&) { c.toggleReports(); }},
        {'g', "Hide or show Gnomon's text.", [](ShadowControls&, Hud& hud) { hud.toggle(); }},
    };
    return keys;
}

} // namespace gnomon::examples
