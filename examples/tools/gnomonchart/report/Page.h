// SPDX-License-Identifier: MIT
#pragma once
#include "ReportFigures.h"

namespace gnomon::examples {

/// index.html as one text: figures, findings in words, a table that sorts and filters, every point's pictures, what the
/// metrics mean. It needs no other file and no network. No text of the results is ever markup in it.
/// @param folder  where the figures and the pictures that the results name are.
std::string pageOf(const ChartResults& results, const std::vector<DrawnFigure>& figures, const std::string& folder);

} // namespace gnomon::examples
