// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityResults.h"

namespace gnomon::examples {

/// The table as text: a scene, then a line a technique with the value at which it leaves its budget. Without scenes one by
/// one: outcomes counted, a line a technique.
std::string stabilityText(const StabilityResults& results, bool sceneByScene);

} // namespace gnomon::examples
