// SPDX-License-Identifier: MIT
#include "RandomSearch.h"

#include "StabilityRun.h"

#include <algorithm>

namespace gnomon::examples {
namespace {

constexpr unsigned seedsAProcess = 25; // whose truths one process keeps
constexpr double lostBelow = 0.5;
constexpr std::size_t leastShadow = 200, leastTurnedAway = 50; // px; the first of a false one, too

StabilityScene seedsFrom(unsigned first, unsigned count) {
    StabilityScene scene;
    scene.id = "seeds from " + std::to_string(first);
    scene.parameter = "seed";
    for (unsigned i = 0; i < count; ++i) scene.values.push_back(first + i);
    scene.make = [](double seed, int width, int height) {
        return caseOf(randomScene(static_cast<unsigned>(seed)), width, height);
    };
    return scene;
}

/// Of the seeds of a batch.
StabilityPlan planOf(const RandomSearch& search) {
    StabilityPlan plan;
    plan.contenders = search.contenders;
    plan.width = search.width;
    plan.height = search.height;
    plan.workers = search.workers;
    for (unsigned done = 0; done < search.count; done += seedsAProcess)
        plan.scenes.push_back(seedsFrom(search.first + done, std::min(seedsAProcess, search.count - done)));
    return plan;
}

/// One scene under one technique.
StabilityCell cellOf(const RandomSearch& search, const StabilityContender& contender, const RandomScene& scene) {
    StabilityPlan plan;
    plan.contenders = {contender};
    plan.width = search.width;
    plan.height = search.height;
    plan.scenes = {{"plainer", "", "", "", "", "", {0.0}, [scene](double, int width, int height) {
                        return caseOf(scene, width, height);
                    }}};
    return runStability(plan, [](std::size_t, const std::string&) { return true; }).rows[0].cells[0];
}

RandomFault shrunk(const RandomSearch& search, const StabilityContender& contender, unsigned seed,
                   const StabilityCell& cell) {
    RandomFault fault{contender.contender.technique, seed, randomScene(seed), cell};
    for (bool plainer = true; plainer;) {
        plainer = false;
        for (const RandomScene& tried : simpler(fault.plainest)) {
            const StabilityCell tryCell = cellOf(search, contender, tried);
            if (!isRandomFault(tryCell)) continue;
            fault.plainest = tried;
            fault.cell = tryCell;
            plainer = true;
            break;
        }
    }
    return fault;
}

void tellFaults(const RandomSearch& search, const StabilityResults& results,
                const std::function<void(const RandomFault&)>& found) {
    for (std::size_t i = 0; i < results.rows.size(); ++i) {
        const StabilityRow& row = results.rows[i];
        const StabilitySceneText& scene = results.scenes[i / search.contenders.size()];
        for (std::size_t place = 0; place < row.cells.size(); ++place)
            if (isRandomFault(row.cells[place]))
                found(shrunk(search, search.contenders[i % search.contenders.size()],
                             static_cast<unsigned>(scene.values[place]), row.cells[place]));
    }
}

} // namespace

bool isRandomFault(const StabilityCell& cell) {
    if (cell.failure == "crashed" || cell.failure == "hung" || cell.failure == "failed" || cell.notFinite > 0)
        return true;
    const StabilityJudgement& judged = cell.onReceiver ? *cell.onReceiver : cell.everywhere;
    const bool lost = std::max(judged.shadow, judged.wrong) > leastShadow && judged.iou < lostBelow;
    return cell.failure.empty() && !cell.stated() && (lost || judged.turnedAwayWrong > leastTurnedAway);
}

unsigned searchRandomScenes(const RandomSearch& search,
                            const std::function<bool(std::size_t, const std::string&)>& progress,
                            const std::function<void(const RandomFault&)>& found) {
    for (unsigned done = 0; done < search.count; done += search.batch) {
        RandomSearch batch = search;
        batch.first = search.first + done;
        batch.count = std::min(search.batch, search.count - done);
        const std::size_t before = std::size_t(done) * search.contenders.size();
        const auto tell = [&](std::size_t cells, const std::string& doing) { return progress(before + cells, doing); };
        const StabilityResults results = runStability(planOf(batch), tell);
        tellFaults(batch, results, found);
        if (!results.complete) return done;
    }
    return search.count;
}

std::string faultText(const RandomFault& fault) {
    const StabilityJudgement& judged = fault.cell.onReceiver ? *fault.cell.onReceiver : fault.cell.everywhere;
    const std::string what = fault.cell.failure.empty()
                                 ? "IoU " + valueText(judged.iou) + " of " + std::to_string(judged.shadow) + " px, " +
                                       std::to_string(judged.turnedAwayWrong) + " px turned away wrong"
                                 : fault.cell.failure + ", " + fault.cell.message;
    return fault.technique + " breaks (" + what + "): " + describe(fault.plainest);
}

} // namespace gnomon::examples
