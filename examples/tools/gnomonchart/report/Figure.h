// SPDX-License-Identifier: MIT
#pragma once
#include "CurveStyles.h"
#include "Curves.h"

namespace gnomon::examples {

/// One chart of a figure.
struct FigurePanel {
    std::string name; ///< of its data in the script: letters.
    std::string title;
    std::vector<Curve> curves;
    std::optional<double> floor; ///< px, see boundaryFloor().
};

/// Least values that a figure shows: what is below is drawn here.
constexpr double leastShownTime = 0.01;  ///< ms
constexpr double leastShownError = 0.01; ///< px

/// Two charts with the same axes, one above the other.
struct Figure {
    std::string name; ///< of its files: a-z, 0-9 and "-".
    std::string title;
    std::string remark; ///< small, below the title.
    std::vector<FigurePanel> panels;
    std::size_t scenes = 1; ///< that were pooled: curves that miss some of them say so.
};

/// What a marker stands for.
struct FigureMarker {
    std::string kit, technique, setting;
    std::string text; ///< for people: names and numbers.
};

struct FigureScript {
    std::string text;                  ///< for gnuplot: all data and all that draws them.
    std::vector<FigureMarker> markers; ///< by the number that the script gives them.
};

FigureScript figureScript(const Figure& figure, const CurveStyles& styles);

} // namespace gnomon::examples
