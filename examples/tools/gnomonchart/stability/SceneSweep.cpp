// SPDX-License-Identifier: MIT
#include "SceneSweep.h"

#include "../measure/Errors.h"
#include "../measure/Pictures.h"
#include "../measure/Sweep.h"
#include "FlickerStrip.h"
#include "OutputFile.h"
#include "Overlay.h"
#include "SceneTriangles.h"
#include "StabilityJudge.h"

#include <gnomon/Convert.h>
#include <gnomon/NamedNode.h>

#include <limits>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr int filmFrames = 17;     // 8 steps on, 8 of the turn: a pixel each
constexpr double mostCrawl = 0.02; // px, of steady edges

bool never() { return false; }

int objectsOf(osg::Node& content, const std::string& name) {
    const std::optional<NamedNode> found = findNamed(content, name);
    return found ? static_cast<int>(sceneTriangles(*found->node).objects.size()) : 0;
}

metrics::Mask objectsUpTo(const metrics::Grid<int>& receiver, int last) {
    metrics::Mask mask(receiver.width, receiver.height);
    for (std::size_t i = 0; i < mask.cells.size(); ++i)
        mask.cells[i] = receiver.cells[i] > 0 && receiver.cells[i] <= last;
    return mask;
}

} // namespace

SceneSweep::Value::Value(const StabilityCase& made)
    : yardstick(made.scene, false, made.truth.get()),
      maps(yardstick.maps()),
      flatObjects(objectsOf(*made.scene.content, made.scene.receiver)),
      terrainObjects(objectsOf(*made.scene.content, made.scene.terrain)) {
    const glm::dvec3 shift = toGlm(yardstick.truth().origin() - made.scene.center);
    for (glm::dvec3& position : maps.position.cells) position += shift;
}

SceneSweep::Value& SceneSweep::value(std::size_t place) {
    std::unique_ptr<Value>& value = _values[place];
    if (!value) value = std::make_unique<Value>(_scene.make(_scene.values[place], _plan.width, _plan.height));
    return *value;
}

Settings SceneSweep::bestSettings(const Peer& peer) {
    return examples::bestSettings(peer, value(_values.size() / 2).yardstick, SweepWidth::NARROW, [] { return true; });
}

const Film& SceneSweep::film(std::size_t place) {
    Value& made = value(place);
    if (!made.film) made.film.emplace(made.yardstick, Film::Motion::PIXELS, filmFrames, never);
    return *made.film;
}

StabilityCell SceneSweep::Run::cell(std::size_t place) {
    StabilityCell cell;
    try {
        measure(place, cell);
    } catch (const std::invalid_argument& refusal) {
        cell.failure = "refused";
        cell.message = refusal.what();
    } catch (const std::exception& failure) {
        cell.failure = "failed";
        cell.message = failure.what();
    }
    return cell;
}

void SceneSweep::Run::measure(std::size_t place, StabilityCell& cell) {
    const Value& value = _sweep.value(place);
    Sight sight(_contender, value.yardstick.scene());
    const metrics::Visibility seen = sight.visibility();
    const metrics::PixelSets sets = metrics::pixelSets(value.maps, seen.value);
    cell.diagnosis = sight.diagnosis();
    cell.notFinite = seen.notFinite;
    cell.everywhere = judge(seen.value, value.maps, sets, sets.agreeing);
    if (_contender.receives != Receives::EVERYTHING)
        cell.onReceiver = judge(seen.value, value.maps, sets, objectsUpTo(value.maps.receiver, receivers(value)));
    cell.measured = true;
    addPicture(place, seen.value, cell);
}

/// Ids of the receivers that it shadows are from 1 to this.
int SceneSweep::Run::receivers(const Value& value) const {
    if (_contender.receives == Receives::EVERYTHING) return std::numeric_limits<int>::max();
    return _contender.receives == Receives::FLAT ? value.flatObjects : value.terrainObjects;
}

StabilityFlicker SceneSweep::Run::flicker(std::size_t place) {
    const Value& value = _sweep.value(place);
    Sight sight(_contender, value.yardstick.scene());
    StabilityFlicker flicker;
    const metrics::FlickerMeter meter =
        _sweep.film(place).measure(sight, never, receivers(value), &flicker.turnedAwayWrong);
    flicker.value = _sweep._scene.values[place];
    flicker.energy = meter.energy();
    flicker.share = meter.share();
    flicker.crawl = meter.crawlBeyondRays();
    flicker.rayCrawl = meter.rayCrawl();
    addStrip(meter.worst(), flicker);
    return flicker;
}

/// Those where the budget is left, and at the end.
void SceneSweep::Run::addPicture(std::size_t place, const metrics::Picture& visibility, StabilityCell& cell) {
    const bool leaves = !_left && !cell.inBudget();
    _left = _left || leaves;
    const StabilityScene& scene = _sweep._scene;
    if (_sweep._plan.folder.empty() || (!leaves && place + 1 < scene.values.size())) return;
    cell.picture = fileName({scene.id, _contender.technique, _contender.setting, std::to_string(place)}, ".png");
    OutputFile(_sweep._plan.folder + "/" + cell.picture).write(*errorOverlay(visibility, _sweep.value(place).maps));
}

/// Of films in which a pixel flickers or edges crawl.
void SceneSweep::Run::addStrip(const metrics::FlickerChange& worst, StabilityFlicker& flicker) const {
    const bool shows = flicker.share.value_or(0.0) > 0.0 || flicker.crawl.value_or(0.0) > mostCrawl;
    if (_sweep._plan.folder.empty() || worst.beyond.empty() || !shows) return;
    flicker.picture = fileName({_sweep._scene.id, _contender.technique, _contender.setting, "flicker"}, ".png");
    OutputFile(_sweep._plan.folder + "/" + flicker.picture).write(*flickerStrip(worst));
}

} // namespace gnomon::examples
