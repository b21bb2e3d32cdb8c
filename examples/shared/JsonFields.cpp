// SPDX-License-Identifier: MIT
#include "JsonFields.h"

#include "InputFile.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::examples {

using nlohmann::json;

json jsonOf(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return value;
}

json jsonOf(const std::optional<double>& value) { return value ? jsonOf(*value) : json(nullptr); }

void readNumber(const json& from, double& value) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (from == "NaN")
        value = std::numeric_limits<double>::quiet_NaN();
    else if (from == "Infinity" || from == "-Infinity")
        value = from == "Infinity" ? infinity : -infinity;
    else if (from.is_number())
        value = from.get<double>();
    else
        throw std::invalid_argument("no number");
}

void readNumber(const json& from, std::optional<double>& value) {
    value.reset();
    if (!from.is_null()) readNumber(from, value.emplace());
}

const json& fieldOf(const json& object, const std::string& name) {
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (found == object.end()) throw std::runtime_error("\"" + name + "\" is missing.");
    return *found;
}

void readInside(const std::string& place, const std::function<void()>& read) {
    try {
        read();
    } catch (const std::exception& error) {
        throw std::runtime_error(place + ": " + error.what());
    }
}

void readKind(const std::string& name, const std::function<void()>& read) {
    try {
        read();
    } catch (const std::exception&) {
        throw std::runtime_error("\"" + name + "\" is of another kind.");
    }
}

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
