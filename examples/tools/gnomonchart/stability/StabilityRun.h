// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityScene.h"

#include <functional>

namespace gnomon::examples {

/// Measures the table. Each scene has a child process, which draws all that is drawn: what crashes or hangs there costs
/// its own cell, and another child goes on after it. This process touches neither OpenGL nor rays nor threads, and must
/// not have done so before.
///
/// @param progress  called after each cell and at least once a second, with cells done and what was done last;
///                  false ends the run.
/// @return all that was measured.
/// @throws std::runtime_error, one sentence, if no process can be started.
StabilityResults runStability(const StabilityPlan& plan,
                              const std::function<bool(std::size_t done, const std::string&)>& progress);

} // namespace gnomon::examples
