// SPDX-License-Identifier: MIT
#pragma once
#include "Figure.h"

namespace gnomon::examples {

/// What auto's model expects against what was measured: errors, and times. Markers are filled for the scenes that the model
/// was built on, hollow for the others.
/// @param scene  empty: all scenes.
/// @return nullopt if nothing was predicted there.
std::optional<FigureScript> predictionScript(const ChartResults& results, const CurveStyles& styles,
                                             const std::string& name, const std::string& title,
                                             const std::string& scene);

} // namespace gnomon::examples
