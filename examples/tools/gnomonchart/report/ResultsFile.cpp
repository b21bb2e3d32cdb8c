// SPDX-License-Identifier: MIT
#include "ResultsFile.h"

#include "InputFile.h"
#include "JsonFields.h"
#include "OutputFile.h"
#include "ResultsCsv.h"
#include "ResultsJson.h"

#include <filesystem>
#include <stdexcept>

namespace gnomon::examples {

namespace fs = std::filesystem;
using nlohmann::json;

void saveResults(const ChartResults& results, const std::string& folder) {
    // Text from drivers and file names need not be UTF-8: what is not becomes U+FFFD.
    const std::string text = jsonOf(results).dump(1, ' ', false, json::error_handler_t::replace) + "\n";
    OutputFile((fs::path(folder) / "results.json").string()).write(text);
    OutputFile((fs::path(folder) / "results.csv").string()).write(csvOf(results));
}

ChartResults loadResults(const std::string& file) {
    const std::optional<std::string> bytes = fileBytes(file);
    if (!bytes)
        throw std::runtime_error("there is no file " + quoted(file) +
                                 ". Give the results.json of a run of gnomonchart.");
    const json parsed = json::parse(*bytes, nullptr, false);
    const std::string begin = quoted(file) + " cannot be read as results of gnomonchart";
    if (parsed.is_discarded()) throw std::runtime_error(begin + ": it is not a complete JSON file.");
    ChartResults results;
    readInside(begin, [&] { results = chartResultsOf(parsed); });
    return results;
}

} // namespace gnomon::examples
