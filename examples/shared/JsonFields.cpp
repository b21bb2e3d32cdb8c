// SPDX-License-Identifier: MIT
#include "JsonFields.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const char* name, const char* why) {
    throw std::runtime_error("\"" + std::string(name) + "\" " + why + ".");
}

const json& field(const json& object, const char* name) {
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (found == object.end()) refuse(name, "is missing");
    return *found;
}

std::optional<double> numberOf(const json& value) {
    if (value.is_number()) return value.get<double>();
    if (value == "NaN") return std::numeric_limits<double>::quiet_NaN();
    if (value == "Infinity") return std::numeric_limits<double>::infinity();
    if (value == "-Infinity") return -std::numeric_limits<double>::infinity();
    return std::nullopt;
}

template <typename Whole>
void readWhole(const json& object, const char* name, Whole& value) {
    const json& found = field(object, name);
    const bool fits =
        found.is_number_unsigned() && found.get<std::uint64_t>() <= std::uint64_t(std::numeric_limits<Whole>::max());
    if (!fits) refuse(name, "is not a whole number of 0 or more");
    value = found.get<Whole>();
}

std::string textOf(const json& value) {
    if (!value.is_string()) throw std::runtime_error("it is not a string.");
    return value.get<std::string>();
}

} // namespace

json jsonOf(double value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return value;
}

json jsonOf(const std::optional<double>& value) { return value ? jsonOf(*value) : json(nullptr); }

void readField(const json& object, const char* name, double& value) {
    const std::optional<double> number = numberOf(field(object, name));
    if (!number) refuse(name, "is not a number");
    value = *number;
}

void readField(const json& object, const char* name, std::optional<double>& value) {
    const json& found = field(object, name);
    value = numberOf(found);
    if (!value && !found.is_null()) refuse(name, "is neither a number nor null");
}

void readField(const json& object, const char* name, std::size_t& value) { readWhole(object, name, value); }
void readField(const json& object, const char* name, unsigned& value) { readWhole(object, name, value); }

void readField(const json& object, const char* name, bool& value) {
    const json& found = field(object, name);
    if (!found.is_boolean()) refuse(name, "is neither true nor false");
    value = found.get<bool>();
}

void readField(const json& object, const char* name, std::string& value) {
    const json& found = field(object, name);
    if (!found.is_string()) refuse(name, "is not a string");
    value = found.get<std::string>();
}

void readField(const json& object, const char* name, std::vector<std::string>& value) {
    value.clear();
    for (const json& text : listField(object, name)) readInside(name, [&] { value.push_back(textOf(text)); });
}

void readField(const json& object, const char* name, std::vector<double>& value) {
    value.clear();
    for (const json& number : listField(object, name)) {
        if (!number.is_number()) throw std::runtime_error(std::string(name) + ": it does not hold numbers.");
        value.push_back(number.get<double>());
    }
}

void readField(const json& object, const char* name, std::vector<std::pair<std::string, std::string>>& value) {
    value.clear();
    for (const json& pair : listField(object, name)) {
        if (!pair.is_array() || pair.size() != 2)
            throw std::runtime_error(std::string(name) + ": it does not hold pairs.");
        readInside(name, [&] { value.emplace_back(textOf(pair[0]), textOf(pair[1])); });
    }
}

const json& objectField(const json& object, const char* name, bool orNull) {
    const json& found = field(object, name);
    if (!found.is_object() && !(orNull && found.is_null())) refuse(name, "is not an object");
    return found;
}

const json& listField(const json& object, const char* name) {
    const json& found = field(object, name);
    if (!found.is_array()) refuse(name, "is not a list");
    return found;
}

void readInside(const std::string& place, const std::function<void()>& read) {
    try {
        read();
    } catch (const std::exception& error) {
        throw std::runtime_error(place + ": " + error.what());
    }
}

} // namespace gnomon::examples
