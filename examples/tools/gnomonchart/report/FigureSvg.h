// SPDX-License-Identifier: MIT
#pragma once
#include "Figure.h"

namespace gnomon::examples {

/// Text as it stands in HTML, SVG and their attributes: no markup left in it.
std::string escaped(const std::string& text);

/// gnuplot's SVG, fit to stand inside a page with others: ids begin with `name`, markers have words that show under the
/// mouse and attributes that scripts can read, and the letters have a fallback.
std::string figureSvg(const std::string& svg, const std::string& name, const std::vector<FigureMarker>& markers);

} // namespace gnomon::examples
