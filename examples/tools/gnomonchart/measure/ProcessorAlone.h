// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"
#include "Contender.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Tells Mesa to draw nothing in this process, where pixels cost nothing from then on, as on a graphics card. Call it before the
/// first OpenGL context of the process.
/// @throws std::runtime_error, one sentence, if OpenGL is not a Mesa that draws nothing.
void drawNothing();

/// What a contender adds to a frame in a process that draws nothing, wall time.
struct AloneTimes {
    double frame = 0.0;       ///< ms, median of a steady frame without shadows.
    AddedTime steady, moving; ///< as ChartCost has them.
};

/// Who is timed: frames of each motion, of a scene by its name.
struct AlonePlan {
    std::vector<std::string> command; ///< words that start a program that answers by answerAlone().
    std::string scene;
    int frames = 12;
};

/// Times contenders in a process that draws nothing, one after the other, each against the scene without shadows: Mesa draws in
/// the calling process, so that this takes another one. If that ends before its work, one more goes on with the next contender.
///
/// Cost    the scene is made once; a contender then takes about a tenth of a second, and its frames.
/// @param goesOn  asked after each; false ends it.
/// @return the contenders' times, none of traced, and of those whose process ended or that failed. Fewer if it was ended.
/// @throws std::runtime_error, one sentence, if nothing can be measured so.
std::vector<std::optional<AloneTimes>> timesAlone(const AlonePlan& plan, const std::vector<Contender>& contenders,
                                                  const std::function<bool()>& goesOn);

/// The other side: measures what it is asked for, and prints a line for each contender.
/// @param request  the last word of the command that timesAlone() runs.
/// @param scene    makes a scene by its name.
/// @throws std::runtime_error as drawNothing() does.
void answerAlone(const std::string& request, const std::function<ChartScene(const std::string& name)>& scene,
                 const std::function<bool()>& stops);

} // namespace gnomon::examples
