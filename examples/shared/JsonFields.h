// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>

namespace gnomon::examples {

/// A number for a file. JSON has neither NaN nor infinity: those are the texts "NaN", "Infinity" and "-Infinity".
nlohmann::json jsonOf(double value);
/// null if there is none.
nlohmann::json jsonOf(const std::optional<double>& value);

/// The field `name` of an object into `value`.
/// @throws std::runtime_error, `"name" is missing.` or what it ought to be, if it is not there or of another kind.
void readField(const nlohmann::json& object, const char* name, double& value);
void readField(const nlohmann::json& object, const char* name, std::optional<double>& value);
void readField(const nlohmann::json& object, const char* name, std::size_t& value);
void readField(const nlohmann::json& object, const char* name, unsigned& value);
void readField(const nlohmann::json& object, const char* name, bool& value);
void readField(const nlohmann::json& object, const char* name, std::string& value);
/// The same for what is an object or a list itself. null is allowed where `orNull`.
const nlohmann::json& objectField(const nlohmann::json& object, const char* name, bool orNull = false);
const nlohmann::json& listField(const nlohmann::json& object, const char* name);

/// Runs `read`; whatever it throws begins with `place` then: "points[3]: …".
void readInside(const std::string& place, const std::function<void()>& read);

} // namespace gnomon::examples
