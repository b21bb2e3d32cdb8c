// SPDX-License-Identifier: MIT
#pragma once
#include "Figure.h"
#include "LogAxis.h"

namespace gnomon::examples {

/// The axes of one chart, placed on the page.
struct PanelAxes {
    LogAxis time, error;
};

/// Commands that write each curve's name beside it, and as many of the settings at its ends as have room.
std::string panelLabels(const FigurePanel& panel, const CurveStyles& styles, const PanelAxes& axes, std::size_t scenes);

} // namespace gnomon::examples
