// SPDX-License-Identifier: MIT
#include "ResultsFile.h"

#include "JsonFile.h"
#include "OutputFile.h"
#include "ResultsCsv.h"
#include "ResultsJson.h"

#include <filesystem>

namespace gnomon::examples {

namespace fs = std::filesystem;

void saveResults(const ChartResults& results, const std::string& folder) {
    OutputFile((fs::path(folder) / "results.json").string()).write(resultsText(jsonOf(results)));
    OutputFile((fs::path(folder) / "results.csv").string()).write(csvOf(results));
}

ChartResults loadResults(const std::string& file) {
    ChartResults results;
    readResultsFile(file, "results.json", "gnomonchart", [&](const auto& json) { results = chartResultsOf(json); });
    return results;
}

} // namespace gnomon::examples
