// SPDX-License-Identifier: MIT
#include "StabilityChild.h"
#include "../measure/Complaints.h"
#include "../measure/Errors.h"
#include "../measure/FlickerRun.h"
#include "../measure/StageViewer.h"
#include "../measure/Sweep.h"
#include "OutputFile.h"
#include "Overlay.h"
#include "SceneTriangles.h"
#include "StabilityResults.h"

#include <gnomon/Convert.h>
#include <gnomon/NamedNode.h>

#include <metrics/Flicker.h>
#include <osg/Image>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

namespace gnomon::examples {
namespace {

/// Measures contenders in one scene over its sweep. The truth of a value is made when it is first needed, and kept.
///
/// Cost    a truth: 34 rays a pixel and two small frames; a cell: a context, and two frames. A film: 17 truths, made once
///         for all contenders, and a context and 34 frames for each.
class SceneSweep {
    struct Value;

public:
    SceneSweep(const StabilityPlan& plan, const StabilityScene& scene) : _plan(plan), _scene(scene) {
        _values.resize(scene.values.size());
    }

    /// One contender from value to value.
    class Run {
    public:
        Run(SceneSweep& sweep, const Contender& contender) : _sweep(sweep), _contender(contender) {}
        /// Never throws: what goes wrong is in the cell.
        StabilityCell cell(std::size_t place);
        /// While the camera moves. @throws what the contender throws.
        StabilityFlicker flicker(std::size_t place);

    private:
        void measure(std::size_t place, StabilityCell& cell);
        int receivers(const Value& value) const;
        void addStrip(const metrics::FlickerChange& worst, StabilityFlicker& flicker) const;
        void addPicture(std::size_t place, const metrics::Picture& visibility, StabilityCell& cell);

        SceneSweep& _sweep;
        const Contender& _contender;
        bool _left = false;
    };

    /// The best settings of a peer at the middle value.
    Settings bestSettings(const Peer& peer);

private:
    /// What is true at one value. Positions are about the scene's centre.
    struct Value {
        explicit Value(const StabilityCase& made);

        Yardstick yardstick;
        metrics::TruthMaps maps;
        int flatObjects, terrainObjects; ///< ids of receivers are from 1 to this.
        std::optional<Film> film;        ///< made when it is first needed.
    };

    Value& value(std::size_t place);
    const Film& film(std::size_t place);

    const StabilityPlan& _plan;
    const StabilityScene& _scene;
    std::vector<std::unique_ptr<Value>> _values;
};

constexpr int gap = 2; // px

/// What is not measured is black.
double greyOf(double visibility) {
    return std::isfinite(visibility) ? 0.15 + 0.7 * std::clamp(visibility, 0.0, 1.0) : 0.0;
}

glm::dvec3 changedColour(double visibility, double beyond) {
    return glm::mix(glm::dvec3(0.4 * greyOf(visibility)), glm::dvec3(1.0, 0.1, 0.1), std::min(1.0, beyond));
}

/// Three pictures side by side: the visibility of a frame and of the next one, then the next one dark, with the change
/// that the truth does not have in red.
osg::ref_ptr<osg::Image> flickerStrip(const metrics::FlickerChange& change) {
    const int width = change.after.width, height = change.after.height;
    ShadedPicture strip(3 * width + 2 * gap, height, glm::dvec3(1.0));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            strip.at(x, y) = glm::dvec3(greyOf(change.before.at(x, y)));
            strip.at(x + width + gap, y) = glm::dvec3(greyOf(change.after.at(x, y)));
            strip.at(x + 2 * (width + gap), y) = changedColour(change.after.at(x, y), change.beyond.at(x, y));
        }
    return bytesOf(strip);
}

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
