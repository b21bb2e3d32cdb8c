// SPDX-License-Identifier: MIT
#pragma once
#include "ChartRun.h"

namespace gnomon::examples {

/// What an interrupted run measured to the end, for ChartPlan::kept: all scenes but the one that it was at.
/// @param plan  of the run that goes on with it.
/// @throws std::invalid_argument, one sentence, if it was made with other settings, another build or on another machine:
/// its times could not stand beside new ones.
ChartResults keptOf(const ChartResults& earlier, const ChartPlan& plan);

} // namespace gnomon::examples
