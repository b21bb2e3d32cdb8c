// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

#include <string>
#include <vector>

namespace gnomon::examples {

/// A figure that lies in the report's folder as NAME.svg, NAME.png and NAME.gnuplot.
struct DrawnFigure {
    std::string name;
    std::string scene;   ///< ChartSceneResult::name; empty: all scenes as one.
    std::string caption; ///< what is shown and how, in sentences; plain text.
};

/// Draws the figure over all scenes ("figure"), one a scene ("figure-SCENE"), and likewise the causes of wrong pixels
/// ("causes", "causes-SCENE") and what auto predicts ("predicted", "predicted-SCENE"). What was not measured is left out.
/// @throws std::runtime_error, one sentence, see drawScript().
std::vector<DrawnFigure> drawFigures(const ChartResults& results, const std::string& folder);

} // namespace gnomon::examples
