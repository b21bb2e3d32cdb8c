// SPDX-License-Identifier: MIT
#pragma once
#include "Figure.h"

namespace gnomon::examples {

/// Bars of the causes of wrong pixels, one a technique at the setting at which its boundary is least off, and how many
/// pixels are wrong at all. Pixels of all scenes are added up, or those of one `scene` counted if it is not empty.
/// nullopt if nothing was measured there.
std::optional<FigureScript> causesScript(const ChartResults& results, const CurveStyles& styles,
                                         const std::string& name, const std::string& title, const std::string& scene);

} // namespace gnomon::examples
