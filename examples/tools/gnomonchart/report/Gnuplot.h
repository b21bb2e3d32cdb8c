// SPDX-License-Identifier: MIT
#pragma once
#include "Figure.h"

#include <string>

namespace gnomon::examples {

/// Draws a figure into NAME.svg and NAME.png, with the script NAME.gnuplot beside them; each appears whole or not at
/// all. In the SVG every marker is a group of class "point" with a <title> of words, and knows its `data-kit`,
/// `data-technique` and `data-setting`; all ids begin with NAME.
/// Needs   gnuplot 5.4.
/// @throws std::runtime_error, one sentence, if it is missing or fails, or the folder takes no files.
void drawFigure(const Figure& figure, const CurveStyles& styles, const std::string& folder);

/// The same for a script that has no such markers.
void drawScript(const std::string& name, const FigureScript& script, const std::string& folder);

} // namespace gnomon::examples
