// SPDX-License-Identifier: MIT
#include "JsonFile.h"

#include "InputFile.h"
#include "JsonFields.h"

#include <stdexcept>

namespace gnomon::examples {

using nlohmann::json;

std::string resultsText(const nlohmann::ordered_json& results) {
    return results.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

void readResultsFile(const std::string& file, const std::string& name, const std::string& program,
                     const std::function<void(const json&)>& read) {
    const std::optional<std::string> bytes = fileBytes(file);
    if (!bytes)
        throw std::runtime_error("there is no file " + quoted(file) + ". Give the " + name + " of a run of " + program +
                                 ".");
    const json parsed = json::parse(*bytes, nullptr, false);
    const std::string begin = quoted(file) + " cannot be read as results of " + program;
    if (parsed.is_discarded()) throw std::runtime_error(begin + ": it is not a complete JSON file.");
    readInside(begin, [&] { read(parsed); });
}

} // namespace gnomon::examples
