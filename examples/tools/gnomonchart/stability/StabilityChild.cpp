// SPDX-License-Identifier: MIT
#include "../measure/Complaints.h"
#include "../measure/FlickerRun.h"
#include "../measure/StageViewer.h"
#include "../measure/Sweep.h"
#include "../measure/Yardstick.h"
#include "ImageFile.h"
#include "OutputFile.h"
#include "SceneTriangles.h"
#include "StabilityResults.h"
#include "StabilityScene.h"

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

using nlohmann::ordered_json;
using Say = std::function<void(const ordered_json&)>;

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

/// What is true at one value.
struct Value {
    explicit Value(const StabilityCase& made)
        : yardstick(made.scene, false, made.truth.get()),
          flatObjects(objectsOf(*made.scene.content, made.scene.receiver)),
          terrainObjects(objectsOf(*made.scene.content, made.scene.terrain)) {}

    /// Ids of the receivers that a contender shadows are from 1 to this.
    int receiversOf(const Contender& contender) const {
        if (contender.receives == Receives::EVERYTHING) return std::numeric_limits<int>::max();
        return contender.receives == Receives::FLAT ? flatObjects : terrainObjects;
    }

    Yardstick yardstick;
    int flatObjects, terrainObjects;
    std::optional<Film> film; ///< made when it is first needed.
};

/// Measures contenders in one scene over its sweep, and tells what it finds. The truth of a value is made when it is first
/// needed, and kept.
///
/// Cost    a truth: 34 rays a pixel and two small frames; a cell: a context, and two frames. A film: 17 truths, made once
///         for all contenders, and a context and 34 frames for each.
class SceneChild {
public:
    SceneChild(const StabilityPlan& plan, const StabilityScene& scene, const Say& say)
        : _plan(plan), _scene(scene), _say(say), _values(scene.values.size()) {}

    void measure(std::size_t number, const Entrant& entry, int from, const Settings& known) {
        Contender contender = entry.contender;
        if (entry.sought) contender = sought(number, *entry.sought, from, known);
        std::vector<StabilityCell> cells;
        bool hasLeft = false; // its budget
        for (int place = std::max(from, 0); place < int(_scene.values.size()); ++place) {
            _say({{"begin", {number, place}}});
            StabilityCell cell = cellOf(contender, std::size_t(place), hasLeft);
            cell.notes = _complaints.take();
            _say({{"cell", jsonOf(cell)}});
            cells.push_back(std::move(cell));
        }
        const std::optional<std::size_t> filmed = filmedAt(cells);
        if (from > 0 || !filmed) return;
        _say({{"film", {number, *filmed}}});
        _say({{"flicker", jsonOf(flickerOf(contender, *filmed))}});
    }

private:
    /// A peer at its best settings at the middle value.
    Contender sought(std::size_t number, const Peer& peer, int from, const Settings& known) {
        if (from >= 0) return peerContender(peer, "best", known);
        _say({{"begin", {number, -1}}});
        const Settings best =
            bestSettings(peer, value(_values.size() / 2).yardstick, SweepWidth::NARROW, [] { return true; });
        _complaints.take(); // of settings that lost
        _say({{"settings", best}});
        return peerContender(peer, "best", best);
    }

    Value& value(std::size_t place) {
        std::unique_ptr<Value>& value = _values[place];
        if (!value) value = std::make_unique<Value>(_scene.make(_scene.values[place], _plan.width, _plan.height));
        return *value;
    }

    /// Never throws: what goes wrong is in the cell.
    StabilityCell cellOf(const Contender& contender, std::size_t place, bool& hasLeft) {
        StabilityCell cell;
        try {
            measureCell(contender, place, hasLeft, cell);
        } catch (const std::invalid_argument& refusal) {
            cell.failure = "refused";
            cell.message = refusal.what();
        } catch (const std::exception& failure) {
            cell.failure = "failed";
            cell.message = failure.what();
        }
        return cell;
    }

    void measureCell(const Contender& contender, std::size_t place, bool& hasLeft, StabilityCell& cell) {
        const Value& here = value(place);
        const metrics::TruthMaps& truth = here.yardstick.maps();
        Sight sight(contender, here.yardstick.scene());
        const metrics::Visibility seen = sight.visibility();
        const metrics::PixelSets sets = metrics::pixelSets(truth, seen.value);
        cell.diagnosis = sight.diagnosis();
        cell.notFinite = seen.notFinite;
        cell.everywhere = judge(seen.value, truth, sets, sets.agreeing);
        if (contender.receives != Receives::EVERYTHING)
            cell.onReceiver = judge(seen.value, truth, sets, objectsUpTo(truth.receiver, here.receiversOf(contender)));
        cell.measured = true;
        const bool leaves = !hasLeft && !cell.inBudget();
        hasLeft = hasLeft || leaves;
        if (_plan.folder.empty() || (!leaves && place + 1 < _values.size())) return;
        cell.picture = fileName({_scene.id, contender.technique, contender.setting, std::to_string(place)}, ".png");
        OutputFile(_plan.folder + "/" + cell.picture).write(*errorOverlay(seen.value, truth));
    }

    /// While the camera moves; with a picture if a pixel flickers or edges crawl. @throws what the contender throws.
    StabilityFlicker flickerOf(const Contender& contender, std::size_t place) {
        Value& here = value(place);
        if (!here.film) here.film.emplace(here.yardstick, Film::Motion::PIXELS, filmFrames, never);
        Sight sight(contender, here.yardstick.scene());
        StabilityFlicker flicker;
        const metrics::FlickerMeter meter =
            here.film->measure(sight, never, here.receiversOf(contender), &flicker.turnedAwayWrong);
        flicker.value = _scene.values[place];
        flicker.energy = meter.energy();
        flicker.share = meter.share();
        flicker.crawl = meter.crawlBeyondRays();
        flicker.rayCrawl = meter.rayCrawl();
        const bool shows = flicker.share.value_or(0.0) > 0.0 || flicker.crawl.value_or(0.0) > mostCrawl;
        if (_plan.folder.empty() || meter.worst().beyond.empty() || !shows) return flicker;
        flicker.picture = fileName({_scene.id, contender.technique, contender.setting, "flicker"}, ".png");
        OutputFile(_plan.folder + "/" + flicker.picture).write(*flickerStrip(meter.worst()));
        return flicker;
    }

    const StabilityPlan& _plan;
    const StabilityScene& _scene;
    const Say& _say;
    std::vector<std::unique_ptr<Value>> _values;
    Complaints _complaints;
};

} // namespace

void measureScene(const StabilityPlan& plan, const StabilityScene& scene, StabilityPlace from, const Settings& settings,
                  const Say& say) {
    SceneChild child(plan, scene, say);
    for (std::size_t number = from.contender; number < plan.contenders.size(); ++number)
        child.measure(number, plan.contenders[number], number == from.contender ? from.value : -1, settings);
}

} // namespace gnomon::examples
