// SPDX-License-Identifier: MIT
#pragma once
#include "../scenes/ChartScene.h"
#include "ChartResults.h"
#include "Sweep.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// What a run of the chart is to do.
struct ChartPlan {
    std::vector<std::string> scenes;                          ///< by name.
    std::function<ChartScene(const std::string& name)> scene; ///< makes one of them.
    std::vector<std::string> techniques;                      ///< parts of the names of those to measure; none: all.
    std::string folder;                                       ///< for pictures; is there.
    double seconds = 1e9;   ///< no scene is begun that would not be done by then; the first always is.
    int frames = 60;        ///< timed, of each motion.
    int flickerFrames = 16; ///< of each of the two films.
    SweepWidth sweep = SweepWidth::WIDE;
    bool brief = false;                                    ///< only settings that are brief, see Contender.
    bool disc = true;                                      ///< measure against the sun's disc too.
    std::vector<std::string> alone;                        ///< see AlonePlan::command.
    std::vector<std::pair<std::string, std::string>> made; ///< what is known of the run already.
    nlohmann::ordered_json kept = ChartResults().kept;     ///< what is measured already of `scenes`, see keptOf().
};

/// Measures every technique in every scene: errors of still pictures, flicker, then costs, all in one race. A contender
/// that fails has its reason in its point; the others go on.
///
/// @param save   called after each point with all there is so far.
/// @param stops  asked often: true ends the run soon, and what it has stays.
/// @return the results, complete unless stopped.
/// @throws std::invalid_argument if one of `techniques` is in no technique's name.
ChartResults runChart(const ChartPlan& plan, const std::function<void(const ChartResults&)>& save,
                      const std::function<bool()>& stops);

/// What an interrupted run measured to the end, for ChartPlan::kept: all scenes but the one that it was at.
/// @param earlier  see loadResults(). @param plan  of the run that goes on with it.
/// @throws std::invalid_argument, one sentence, if it was made with other settings, another build or on another machine:
/// its times could not stand beside new ones.
nlohmann::ordered_json keptOf(const nlohmann::ordered_json& earlier, const ChartPlan& plan);

} // namespace gnomon::examples
