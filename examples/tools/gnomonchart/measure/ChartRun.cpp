// SPDX-License-Identifier: MIT
#include "ChartRun.h"
#include "Complaints.h"
#include "Contender.h"
#include "FlickerRun.h"
#include "ImageFile.h"
#include "OutputFile.h"
#include "ProcessorAlone.h"
#include "Race.h"
#include "TimeLeft.h"

#include <metrics/Visibility.h>
#include <osg/Notify>
#include <osg/ref_ptr>

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>

namespace gnomon::examples {
namespace {

// Rough costs in pictures drawn, for the time left.
constexpr double truthWork = 40.0, filmFrameWork = 15.0, stillWork = 6.0, sweptValueWork = 5.0,
                 aloneContenderWork = 2.0;
constexpr int mostFramesAlone = 20; // more do not change a median that no pixel disturbs

double sweepWork(const Peer& peer, SweepWidth width) {
    std::size_t values = 0;
    for (const Knob& knob : peer.knobs) values += knob.values.size();
    return sweptValueWork * (width == SweepWidth::WIDE ? double(values) : std::min(double(values), 6.0));
}

std::vector<std::string> scenesLeft(const ChartPlan& plan) {
    const auto& kept = plan.kept.at("scenes");
    std::vector<std::string> left;
    for (const std::string& name : plan.scenes)
        if (std::none_of(kept.begin(), kept.end(), [&](const auto& scene) { return scene.at("name") == name; }))
            left.push_back(name);
    return left;
}

class Run {
public:
    Run(const ChartPlan& plan, const std::function<void(const ChartResults&)>& save, const std::function<bool()>& stops)
        : _plan(plan),
          _save(save),
          _stops(stops),
          _entries(entrants(plan.techniques, true, plan.brief)),
          _scenes(scenesLeft(plan)),
          _progress(sceneWork() * double(_scenes.size())) {
        _results.kept = plan.kept;
        _results.made = plan.made;
        for (auto& fact : machineFacts()) _results.made.push_back(fact);
        _results.made.emplace_back("load at the start", machineLoad());
    }

    ChartResults run() {
        _save(_results);
        for (std::size_t i = 0; i < _scenes.size() && !_stops(); ++i) {
            if (!hasTime(i)) {
                leaveOut(i);
                break;
            }
            _done = sceneWork() * double(i);
            tryScene(_scenes[i]);
        }
        _results.made.emplace_back("load at the end", machineLoad());
        _results.complete = !_stops();
        _save(_results);
        return _results;
    }

private:
    double contenderWork(const Entrant& entry) const {
        return stillWork + 4.0 * _plan.flickerFrames + (entry.sought ? sweepWork(*entry.sought, _plan.sweep) : 0.0);
    }
    double raceWork() const { return 2.0 * _plan.frames * double(_entries.size() + 1); }
    double aloneWork() const { return aloneContenderWork * double(_entries.size()); }
    double sceneWork() const {
        double work = truthWork + 2.0 * _plan.flickerFrames * filmFrameWork + raceWork() + aloneWork();
        for (const Entrant& entry : _entries) work += contenderWork(entry);
        return work;
    }

    /// Whether the next scene ends in time if it takes as long as those before took on average, and a half more.
    bool hasTime(std::size_t scenes) const {
        const double spent = _progress.seconds();
        return scenes == 0 || spent + 1.5 * spent / double(scenes) <= _plan.seconds;
    }

    void leaveOut(std::size_t from) {
        std::string names;
        for (std::size_t i = from; i < _scenes.size(); ++i) names += (i > from ? ", " : "") + _scenes[i];
        _results.made.emplace_back("left out for lack of time", names);
    }

    void show(const std::string& doing) { _progress.show(_done, doing); }

    /// A model that is not installed, say, costs its own scene and no other.
    void tryScene(const std::string& name) {
        try {
            measureScene(name);
        } catch (const std::exception& failure) {
            if (_plan.scenes.size() == 1) throw;
            _results.made.emplace_back("left out: " + name, failure.what());
        }
    }

    void measureScene(const std::string& name) {
        show(name + ": truth");
        const Yardstick yardstick(_plan.scene(name), _plan.disc);
        addScene(yardstick);
        _done += truthWork;
        makeFilms(yardstick);
        _field = {_results.points.size(), {}, {}};
        for (const Entrant& entry : _entries) {
            if (_stops()) return;
            measureContender(entry, yardstick);
            _done += contenderWork(entry);
            _save(_results);
        }
        _films.clear();
        raceAll(yardstick.scene());
        timeAlone(yardstick.scene().name);
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
            _films.emplace_back(yardstick, motion, _plan.flickerFrames, _stops);
            _done += _plan.flickerFrames * filmFrameWork;
        }
    }

    void measureContender(const Entrant& entry, const Yardstick& yardstick) {
        Contender contender = entry.contender;
        show(yardstick.scene().name + ": " + contender.technique + ", " + contender.setting);
        if (entry.sought) contender = swept(*entry.sought, yardstick);
        if (entry.sought && contender.settings.empty())
            repeatDefaults();
        else
            addPoint(contender, yardstick);
    }

    /// The best are the defaults, which were measured just before.
    void repeatDefaults() {
        ChartPoint point = _results.points.back();
        point.setting = "best";
        _results.points.push_back(std::move(point));
        _field.racerOf.push_back(_field.racers.size() - 1);
    }

    void addPoint(const Contender& contender, const Yardstick& yardstick) {
        ChartPoint point = pointOf(contender, yardstick);
        try {
            measureErrors(contender, yardstick, point);
        } catch (const std::exception& error) {
            point.failure = error.what();
        }
        for (const std::string& said : _complaints.take()) point.notes.push_back(said);
        _results.points.push_back(std::move(point));
        _field.racerOf.push_back(_field.racers.size());
        _field.racers.push_back(contender);
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
        if (!sight.decisions().empty()) point.prediction = predictionOf(sight.decisions().front());
        point.errors = metrics::shadowMetrics(visibility, yardstick.maps(), yardstick.limits());
        write(*errorOverlay(visibility.value, yardstick.maps()), point.overlay = base + "-errors.png");
        const ShadedPicture shaded = shadedPicture(contender, yardstick.scene());
        point.shadedRmse = metrics::shadedError(shaded, yardstick.shaded(), yardstick.agreeing());
        write(*bytesOf(shaded), point.picture = base + ".png");
        measureFlicker(sight, point);
    }

    /// What auto expects of its choice. The race has its own for the times.
    static ChartPrediction predictionOf(const ShadowDecision& decision) {
        const ShadowCandidate& chosen = decision.chosen;
        return {chosen.spec, chosen.error, {chosen.spec, chosen.flying}, {chosen.spec, chosen.moving}};
    }

    /// Of the two films the worse.
    void measureFlicker(Sight& sight, ChartPoint& point) {
        for (const Film& film : _films) {
            const metrics::FlickerMeter meter = film.measure(sight, _stops);
            if (_stops()) return;                                                // half a film is no measure
            point.flickerEnergy = std::max(point.flickerEnergy, meter.energy()); // nothing is less than anything
            point.flickerShare = std::max(point.flickerShare, meter.share());
            point.crawl = std::max(point.crawl, meter.crawl());
        }
    }

    void raceAll(const ChartScene& scene) {
        if (_stops()) return;
        show(scene.name + ": starting " + std::to_string(_field.racers.size()) + " viewers");
        const double before = _done;
        const RaceResults race = examples::race(scene, _field.racers, _plan.frames, _shaders, [&](int done, int all) {
            _done = before + raceWork() * done / all;
            show(scene.name + ": timing, round " + std::to_string(done + 1) + " of " + std::to_string(all));
            return !_stops();
        });
        _complaints.take();
        _results.scenes.back().frame = race.frame;
        for (std::size_t i = 0; i < _field.racerOf.size(); ++i)
            setCost(race.contenders[_field.racerOf[i]], _results.points[_field.firstPoint + i]);
        _save(_results);
    }

    static void setCost(const RaceResult& result, ChartPoint& point) {
        point.cost = result.cost;
        if (point.failure.empty()) point.failure = result.failure;
        if (point.prediction && result.steady) point.prediction->steady = *result.steady;
        if (point.prediction && result.moving) point.prediction->moving = *result.moving;
    }

    /// Where OpenGL draws in spite of all, that is said once, and no other scene tries.
    void timeAlone(const std::string& scene) {
        if (_stops() || !_aloneFailure.empty()) return;
        const double before = _done;
        std::size_t told = 0;
        const auto goesOn = [&] {
            _done = before + aloneWork() * double(told++) / double(_field.racers.size());
            show(scene + ": the processor alone");
            return !_stops();
        };
        try {
            const int frames = std::min(_plan.frames, mostFramesAlone);
            setAlone(timesAlone({_plan.alone, scene, frames}, _field.racers, goesOn));
        } catch (const std::runtime_error& failure) {
            _aloneFailure = failure.what();
            _results.made.emplace_back("processor alone", "not measured: " + _aloneFailure);
        }
        _done = before + aloneWork();
        _save(_results);
    }

    void setAlone(const std::vector<std::optional<AloneTimes>>& times) {
        for (std::size_t i = 0; i < _field.racerOf.size(); ++i) {
            std::optional<ChartCost>& cost = _results.points[_field.firstPoint + i].cost;
            const std::size_t racer = _field.racerOf[i];
            if (!cost || racer >= times.size() || !times[racer]) continue;
            cost->steadyAlone = times[racer]->steady;
            cost->movingAlone = times[racer]->moving;
            _results.scenes.back().frameAlone = times[racer]->frame;
        }
    }

    void write(const osg::Image& image, const std::string& file) const {
        OutputFile(_plan.folder + "/" + file).write(image);
    }

    /// Who races in the scene that is being measured.
    struct Field {
        std::size_t firstPoint = 0;
        std::vector<Contender> racers;
        std::vector<std::size_t> racerOf; ///< by points from firstPoint on.
    };

    const ShaderCache _shaders; // before any context
    const ChartPlan& _plan;
    const std::function<void(const ChartResults&)>& _save;
    const std::function<bool()>& _stops;
    const std::vector<Entrant> _entries;
    const std::vector<std::string> _scenes; ///< still to be measured.
    Complaints _complaints;
    TimeLeft _progress;
    double _done = 0.0;
    Field _field;
    std::string _aloneFailure; ///< why the processor alone cannot be measured.
    std::vector<Film> _films;  ///< of the scene that is being measured.
    ChartResults _results;
};

using nlohmann::ordered_json;
using Facts = std::vector<std::pair<std::string, std::string>>;

/// Whether it may differ between runs that go on with one another.
bool mayDiffer(const std::string& fact) { return fact == "command" || fact == "date"; }

void requireSame(const Facts& earlier, const Facts& now) {
    for (const auto& fact : now)
        if (!mayDiffer(fact.first) && std::find(earlier.begin(), earlier.end(), fact) == earlier.end())
            throw std::invalid_argument("--resume: the results in the folder were not made with " + fact.first + " " +
                                        fact.second + ". Leave --resume out to measure everything again.");
}

} // namespace

ChartResults runChart(const ChartPlan& plan, const std::function<void(const ChartResults&)>& save,
                      const std::function<bool()>& stops) {
    return Run(plan, save, stops).run();
}

ordered_json keptOf(const ordered_json& earlier, const ChartPlan& plan) {
    requireSame(earlier["made"].get<Facts>(), plan.made);
    requireSame(earlier["made"].get<Facts>(), machineFacts());
    ordered_json kept = {{"scenes", earlier["scenes"]}, {"points", ordered_json::array()}};
    if (!earlier.value("complete", false) && !kept["scenes"].empty()) kept["scenes"].erase(kept["scenes"].size() - 1);
    for (const ordered_json& point : earlier["points"])
        for (const ordered_json& scene : kept["scenes"])
            if (scene.at("name") == point.at("scene")) kept["points"].push_back(point);
    return kept;
}

} // namespace gnomon::examples
