// SPDX-License-Identifier: MIT
#include "ChartRun.h"
#include "Complaints.h"
#include "Contender.h"
#include "Errors.h"
#include "FlickerRun.h"
#include "Machine.h"
#include "OutputFile.h"
#include "Overlay.h"
#include "Pictures.h"
#include "Progress.h"
#include "Race.h"

#include <gnomon/metrics/Intensity.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>

namespace gnomon::examples {
namespace {

// Rough costs in pictures drawn, for the time left.
constexpr double truthWork = 40.0, filmFrameWork = 15.0, stillWork = 6.0, sweptValueWork = 5.0;

/// One contender or, with a peer, the best that its sweep finds.
struct Entry {
    Contender contender;
    const Peer* peer = nullptr;
};

bool isAsked(const std::string& technique, const std::string& part) { return technique.find(part) != technique.npos; }

std::vector<Entry> entries(const std::string& part) {
    std::vector<Entry> result;
    for (const Contender& contender : gnomonContenders())
        if (isAsked(contender.technique, part)) result.push_back({contender});
    for (const Peer& peer : peers()) {
        if (!isAsked(peer.name, part)) continue;
        result.push_back({peerContender(peer, "defaults", {})});
        if (!peer.knobs.empty()) result.push_back({peerContender(peer, "best", {}), &peer});
    }
    if (result.empty()) throw std::invalid_argument("no technique's name holds \"" + part + "\".");
    return result;
}

double sweepWork(const Peer& peer, SweepWidth width) {
    std::size_t values = 0;
    for (const Knob& knob : peer.knobs) values += knob.values.size();
    return sweptValueWork * (width == SweepWidth::WIDE ? double(values) : std::min(double(values), 6.0));
}

class Run {
public:
    Run(const ChartPlan& plan, const std::function<void(const ChartResults&)>& save, const std::function<bool()>& stops)
        : _plan(plan),
          _save(save),
          _stops(stops),
          _entries(entries(plan.technique)),
          _progress(sceneWork() * double(plan.scenes.size())) {
        _results.made = plan.made;
        for (auto& fact : machineFacts()) _results.made.push_back(fact);
        _results.made.emplace_back("load at the start", machineLoad());
    }

    ChartResults run() {
        _save(_results);
        for (std::size_t i = 0; i < _plan.scenes.size() && !_stops(); ++i) {
            _done = sceneWork() * double(i);
            measureScene(_plan.scenes[i]);
        }
        _results.made.emplace_back("load at the end", machineLoad());
        _results.complete = !_stops();
        _save(_results);
        return _results;
    }

private:
    double contenderWork(const Entry& entry) const {
        return stillWork + 4.0 * _plan.flickerFrames + (entry.peer ? sweepWork(*entry.peer, _plan.sweep) : 0.0);
    }
    double raceWork() const { return 2.0 * _plan.frames * double(_entries.size() + 1); }
    double sceneWork() const {
        double work = truthWork + 2.0 * _plan.flickerFrames * filmFrameWork + raceWork();
        for (const Entry& entry : _entries) work += contenderWork(entry);
        return work;
    }

    void show(const std::string& doing) { _progress.show(_done, doing); }

    void measureScene(const std::string& name) {
        show(name + ": truth");
        const Yardstick yardstick(_plan.scene(name), _plan.disc);
        addScene(yardstick);
        _done += truthWork;
        makeFilms(yardstick);
        const std::size_t first = _results.points.size();
        std::vector<Contender> racers;
        for (const Entry& entry : _entries) {
            if (_stops()) return;
            racers.push_back(measureContender(entry, yardstick));
            _done += contenderWork(entry);
            _save(_results);
        }
        _films.clear();
        raceAll(yardstick.scene(), racers, first);
    }

    void addScene(const Yardstick& yardstick) {
        ChartSceneResult scene;
        yardstick.describe(scene);
        scene.truthPicture = fileName({scene.name, "truth"}, ".png");
        write(*bytesOf(yardstick.shaded()), scene.truthPicture);
        _results.scenes.push_back(scene);
    }

    void makeFilms(const Yardstick& yardstick) {
        for (const Film::Motion motion : {Film::Motion::CAMERA, Film::Motion::LIGHT}) {
            if (_stops() || _plan.flickerFrames < 2) return;
            show(yardstick.scene().name + ": truth of moving pictures");
            _films.emplace_back(yardstick, motion, _plan.flickerFrames);
            _done += _plan.flickerFrames * filmFrameWork;
        }
    }

    /// @return the contender as it is to race.
    Contender measureContender(const Entry& entry, const Yardstick& yardstick) {
        Contender contender = entry.contender;
        show(yardstick.scene().name + ": " + contender.technique + ", " + contender.setting);
        ChartPoint point;
        try {
            if (entry.peer) contender = swept(*entry.peer, yardstick);
            point = pointOf(contender, yardstick);
            measureErrors(contender, yardstick, point);
        } catch (const std::exception& error) {
            point = pointOf(contender, yardstick);
            point.failure = error.what();
        }
        for (const std::string& said : _complaints.take()) point.notes.push_back(said);
        _results.points.push_back(std::move(point));
        return contender;
    }

    Contender swept(const Peer& peer, const Yardstick& yardstick) {
        const auto goesOn = [this] { return !_stops(); };
        const Settings best = bestSettings(peer, yardstick, _plan.sweep, goesOn);
        _complaints.take(); // of settings that lost
        return peerContender(peer, "best", best);
    }

    static ChartPoint pointOf(const Contender& contender, const Yardstick& yardstick) {
        ChartPoint point;
        point.scene = yardstick.scene().name;
        point.kit = contender.kit;
        point.technique = contender.technique;
        point.setting = contender.setting;
        point.settings = contender.settings;
        return point;
    }

    void measureErrors(const Contender& contender, const Yardstick& yardstick, ChartPoint& point) {
        const std::string base = fileName({point.scene, point.technique, point.setting}, "");
        Sight sight(contender, yardstick.scene());
        const metrics::Visibility visibility = sight.visibility();
        point.notes = sight.diagnosis();
        point.errors = metrics::shadowMetrics(visibility, yardstick.maps(), yardstick.limits());
        write(*errorOverlay(visibility.value, yardstick.maps()), point.overlay = base + "-errors.png");
        const ShadedPicture shaded = shadedPicture(contender, yardstick.scene());
        point.shadedRmse = metrics::shadedError(shaded, yardstick.shaded(), yardstick.agreeing());
        write(*bytesOf(shaded), point.picture = base + ".png");
        measureFlicker(sight, point);
    }

    /// Of the two films the worse.
    void measureFlicker(Sight& sight, ChartPoint& point) {
        for (const Film& film : _films) {
            if (_stops()) return;
            const metrics::FlickerMeter meter = film.measure(sight);
            point.flickerEnergy = std::max(point.flickerEnergy, meter.energy()); // nothing is less than anything
            point.flickerShare = std::max(point.flickerShare, meter.share());
            point.crawl = std::max(point.crawl, meter.crawl());
        }
    }

    void raceAll(const ChartScene& scene, const std::vector<Contender>& racers, std::size_t first) {
        if (_stops()) return;
        show(scene.name + ": starting " + std::to_string(racers.size()) + " viewers");
        const double before = _done;
        const RaceResults race = examples::race(scene, racers, _plan.frames, [&](int done, int all) {
            _done = before + raceWork() * done / all;
            show(scene.name + ": timing, round " + std::to_string(done + 1) + " of " + std::to_string(all));
            return !_stops();
        });
        _complaints.take();
        _results.scenes.back().frame = race.frame;
        for (std::size_t i = 0; i < racers.size(); ++i) {
            ChartPoint& point = _results.points[first + i];
            point.cost = race.contenders[i].cost;
            if (point.failure.empty()) point.failure = race.contenders[i].failure;
        }
        _save(_results);
    }

    void write(const osg::Image& image, const std::string& file) const {
        OutputFile(_plan.folder + "/" + file).write(image);
    }

    const ChartPlan& _plan;
    const std::function<void(const ChartResults&)>& _save;
    const std::function<bool()>& _stops;
    const std::vector<Entry> _entries;
    Complaints _complaints;
    Progress _progress;
    double _done = 0.0;
    std::vector<Film> _films; ///< of the scene that is being measured.
    ChartResults _results;
};

} // namespace

ChartResults runChart(const ChartPlan& plan, const std::function<void(const ChartResults&)>& save,
                      const std::function<bool()>& stops) {
    return Run(plan, save, stops).run();
}

std::vector<std::string> chartTechniques() {
    std::vector<std::string> names;
    for (const Contender& contender : gnomonContenders())
        if (names.empty() || names.back() != contender.technique) names.push_back(contender.technique);
    for (const Peer& peer : peers()) names.push_back(peer.name);
    return names;
}

} // namespace gnomon::examples
