// SPDX-License-Identifier: MIT
#include "ChartReport.h"

#include "OutputFile.h"
#include "Page.h"

#include <filesystem>

namespace gnomon::examples {

void writeReport(const ChartResults& results, const std::string& folder) {
    const std::vector<DrawnFigure> figures = drawFigures(results, folder);
    OutputFile((std::filesystem::path(folder) / "index.html").string()).write(pageOf(results, figures, folder));
}

} // namespace gnomon::examples
