// SPDX-License-Identifier: MIT
#include "StabilityTable.h"

#include "Machine.h"
#include "OutputFile.h"
#include "Progress.h"
#include "StabilityFiles.h"
#include "StabilityRun.h"
#include "StabilityText.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <thread>

namespace gnomon::examples {
namespace {

constexpr std::size_t fewScenes = 6; // of which the text tells all

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
    plan.contenders = stabilityContenders(options.technique, !options.quick);
    plan.width = options.view.width;
    plan.height = options.view.height;
    plan.workers = std::max(1u, std::thread::hardware_concurrency());
    plan.folder = options.out;
    plan.made = {{"size", std::to_string(plan.width) + "x" + std::to_string(plan.height)},
                 {"sweep", options.quick ? "three values" : "all values"}};
    return plan;
}

void print(const StabilityResults& results, const std::string& folder) {
    std::cout << stabilityText(results, results.scenes.size() <= fewScenes) << "the table is " << folder
              << "/stability.csv\n";
}

} // namespace

bool makeStabilityTable(const ChartOptions& options, const std::string& command, const std::function<bool()>& stops) {
    StabilityPlan plan = planOf(options);
    plan.made.insert(plan.made.begin(), {"command", command});
    requireFolder(options.out);
    std::size_t cells = 0;
    for (const StabilityScene& scene : plan.scenes) cells += scene.values.size() * plan.contenders.size();
    StabilityResults results;
    {
        ProgressLine progress(static_cast<double>(cells));
        results = runStability(plan, [&](std::size_t done, std::size_t, const std::string& doing) {
            if (done) progress.show(double(done), doing);
            return !stops();
        });
    }
    for (auto& fact : machineFacts()) results.made.push_back(fact); // after the run: it makes a context
    saveStability(results, options.out);
    print(results, options.out);
    return results.complete;
}

void printStabilityAgain(const std::string& folder) {
    const StabilityResults results = loadStability((std::filesystem::path(folder) / "stability.json").string());
    print(results, folder);
}

} // namespace gnomon::examples
