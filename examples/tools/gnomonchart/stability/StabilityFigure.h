// SPDX-License-Identifier: MIT
#pragma once
#include "../report/Figure.h"
#include "StabilityResults.h"

namespace gnomon::examples {

/// The heat map: techniques down, scenes across. A cell's colour is how far the sweep gets within the budget; it is hatched
/// for a stated limit, dotted where the technique is right on its receiver, and crossed for a catastrophe.
FigureScript stabilityScript(const StabilityResults& results, const std::string& name);

/// "#rrggbb" of a share of a sweep, 0 … 1: blue for all of it, else from red to pale yellow.
std::string reachColour(double reach);

} // namespace gnomon::examples
