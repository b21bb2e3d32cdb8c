// SPDX-License-Identifier: MIT
#include "StabilityRun.h"

#include "SceneProcess.h"

#include <algorithm>
#include <memory>
#include <poll.h>

namespace gnomon::examples {
namespace {

constexpr int pollMilliseconds = 200;

StabilitySceneText textOf(const StabilityScene& scene) {
    return {scene.id, scene.section, scene.title, scene.about, scene.parameter, scene.unit, scene.values};
}

std::vector<StabilityRow> rowsOf(const StabilityPlan& plan) {
    std::vector<StabilityRow> rows;
    for (const StabilityScene& scene : plan.scenes)
        for (const StabilityContender& entry : plan.contenders) {
            const Contender& contender = entry.contender;
            rows.push_back(
                {scene.id, contender.kit, contender.technique, contender.setting, contender.settings, {}, {}});
        }
    return rows;
}

class Runner {
public:
    Runner(const StabilityPlan& plan, std::vector<StabilityRow>& rows) : _plan(plan), _rows(rows) {}

    template <typename Progress>
    bool run(const Progress& progress) {
        while (true) {
            fill();
            if (_processes.empty()) return true;
            if (!progress(cells(), _processes.front()->doing())) return false;
            turn();
        }
    }

private:
    void fill() {
        for (; _next < _plan.scenes.size() && _processes.size() < std::max(1u, _plan.workers); ++_next)
            _processes.push_back(std::make_unique<SceneProcess>(_plan, _plan.scenes[_next],
                                                                _rows.data() + _next * _plan.contenders.size()));
    }

    void turn() {
        std::vector<pollfd> polled;
        for (const auto& process : _processes) polled.push_back({process->descriptor(), POLLIN, 0});
        const int ready = poll(polled.data(), polled.size(), pollMilliseconds);
        for (std::size_t i = 0; i < _processes.size(); ++i)
            ready > 0 && polled[i].revents ? _processes[i]->read() : _processes[i]->watch();
        const auto isDone = [this](const std::unique_ptr<SceneProcess>& process) {
            if (process->done()) _finished += process->cells();
            return process->done();
        };
        _processes.erase(std::remove_if(_processes.begin(), _processes.end(), isDone), _processes.end());
    }

    std::size_t cells() const {
        std::size_t sum = _finished;
        for (const auto& process : _processes) sum += process->cells();
        return sum;
    }

    const StabilityPlan& _plan;
    std::vector<StabilityRow>& _rows;
    std::vector<std::unique_ptr<SceneProcess>> _processes;
    std::size_t _next = 0, _finished = 0;
};

} // namespace

StabilityResults runStability(const StabilityPlan& plan,
                              const std::function<bool(std::size_t, const std::string&)>& progress) {
    StabilityResults results;
    results.made = plan.made;
    for (const StabilityScene& scene : plan.scenes) results.scenes.push_back(textOf(scene));
    results.rows = rowsOf(plan);
    if (plan.contenders.empty()) return results;
    results.complete = Runner(plan, results.rows).run(progress);
    return results;
}

} // namespace gnomon::examples
