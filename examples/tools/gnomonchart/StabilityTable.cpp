// SPDX-License-Identifier: MIT
#include "StabilityTable.h"

#include "Machine.h"
#include "OutputFile.h"
#include "Progress.h"
#include "RandomSearch.h"
#include "Report.h"
#include "StabilityResults.h"
#include "StabilityRun.h"

#include <algorithm>
#include <iostream>
#include <thread>

namespace gnomon::examples {
namespace {

/// The first value, the middle one and the last.
StabilityScene coarse(StabilityScene scene) {
    const std::vector<double> all = scene.values;
    scene.values = {all.front(), all[all.size() / 2], all.back()};
    return scene;
}

StabilityPlan planOf(const ChartOptions& options) {
    StabilityPlan plan;
    plan.scenes = stabilityScenes(options.stabilityScenes);
    if (options.quick) std::transform(plan.scenes.begin(), plan.scenes.end(), plan.scenes.begin(), coarse);
    plan.contenders = stabilityContenders(options.techniques, !options.quick);
    plan.width = options.view.width;
    plan.height = options.view.height;
    plan.workers = std::max(1u, std::thread::hardware_concurrency());
    plan.folder = options.out;
    plan.made = {{"size", std::to_string(plan.width) + "x" + std::to_string(plan.height)},
                 {"sweep", options.quick ? "three values" : "all values"}};
    return plan;
}

/// What an interrupted run did not measure to the end cannot be judged.
void dropUnfinished(StabilityResults& results) {
    const auto isUnfinished = [](const StabilityRow& row) {
        return row.cells.empty() || std::any_of(row.cells.begin(), row.cells.end(), [](const StabilityCell& cell) {
                   return !cell.measured && cell.failure.empty();
               });
    };
    results.rows.erase(std::remove_if(results.rows.begin(), results.rows.end(), isUnfinished), results.rows.end());
}

/// @param stops  see makeStabilityTable().
template <class Work>
auto withProgress(std::size_t steps, const std::function<bool()>& stops, const Work& work) {
    ProgressLine progress(static_cast<double>(steps));
    return work([&](std::size_t done, const std::string& doing) {
        if (done) progress.show(double(done), doing);
        return !stops();
    });
}

} // namespace

bool makeStabilityTable(const ChartOptions& options, const std::string& command, const std::function<bool()>& stops) {
    StabilityPlan plan = planOf(options);
    plan.made.insert(plan.made.begin(), {"command", command});
    requireFolder(options.out);
    std::size_t cells = 0;
    for (const StabilityScene& scene : plan.scenes) cells += scene.values.size() * plan.contenders.size();
    StabilityResults results =
        withProgress(cells, stops, [&](const auto& progress) { return runStability(plan, progress); });
    dropUnfinished(results);
    for (auto& fact : machineFacts()) results.made.push_back(fact); // after the run: it makes a context
    saveStability(results, options.out);
    writeReport(options.out);
    return results.complete;
}

bool searchRandom(const ChartOptions& options, const std::function<bool()>& stops) {
    RandomSearch search;
    search.first = options.seed;
    search.count = options.random.value_or(search.count);
    search.contenders = stabilityContenders(options.techniques, false);
    const auto isRough = [](const StabilityContender& each) {
        return each.contender.kit != "Gnomon" || each.contender.technique == "box"; // box: shadows of bounding boxes
    };
    search.contenders.erase(std::remove_if(search.contenders.begin(), search.contenders.end(), isRough),
                            search.contenders.end());
    search.workers = std::max(1u, std::thread::hardware_concurrency());
    search.batch = std::max(search.batch, 50 * search.workers); // two processes for each
    const std::size_t cells = std::size_t(search.count) * search.contenders.size();
    std::size_t faults = 0;
    const auto print = [&faults](const RandomFault& fault) {
        std::cout << faultText(fault) << std::endl; // at once: a long search may be ended
        ++faults;
    };
    const unsigned done =
        withProgress(cells, stops, [&](const auto& progress) { return searchRandomScenes(search, progress, print); });
    std::cout << (done < search.count ? "interrupted after " + std::to_string(done) + " of " : std::string())
              << search.count << " random scenes from seed " << search.first << ", " << faults << " faults\n";
    return faults == 0 && done == search.count;
}

} // namespace gnomon::examples
