// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"
#include "PagePictures.h"

namespace gnomon::examples {

/// What the page's script (page/chart.js) works on: numbers with their names, scenes, points, pictures.
nlohmann::ordered_json pageData(const ChartResults& results, PagePictures& pictures);

/// JSON fit to stand in a <script> element: no "<" is left in it.
std::string scriptJson(const nlohmann::ordered_json& data);

} // namespace gnomon::examples
