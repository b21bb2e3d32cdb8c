// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace gnomon::examples {

/// A number for a file. JSON has neither NaN nor infinity: those are the texts "NaN", "Infinity" and "-Infinity".
nlohmann::json jsonOf(double value);
/// null if there is none.
nlohmann::json jsonOf(const std::optional<double>& value);

/// What jsonOf() made. @throws std::invalid_argument if it is something else.
void readNumber(const nlohmann::json& from, double& value);
void readNumber(const nlohmann::json& from, std::optional<double>& value);

/// The field `name` of an object. @throws std::runtime_error, a sentence, if there is none.
const nlohmann::json& fieldOf(const nlohmann::json& object, const std::string& name);

/// Runs `read`; whatever it throws begins with `place` then: "points[3]: …".
void readInside(const std::string& place, const std::function<void()>& read);
/// Runs `read`. @throws std::runtime_error, "name" is of another kind, if it throws.
void readKind(const std::string& name, const std::function<void()>& read);

/// Results as a file holds them, a value a line. Text from drivers and file names need not be UTF-8: what is not becomes U+FFFD.
std::string resultsText(const nlohmann::ordered_json& results);

/// Reads the results that a program wrote, by `read`.
/// @param name     that the program gives such files.
/// @param program  with its option.
/// @throws std::runtime_error, one sentence that begins with the file, if it is missing, no JSON, or `read` throws.
void readResultsFile(const std::string& file, const std::string& name, const std::string& program,
                     const std::function<void(const nlohmann::json&)>& read);

/// A struct's fields are listed once, for the way into a file and for the way back:
///     template <class Way> static void fields(Way& way, PartOf<Way, Point> point) { way.field("x", point.x); … }
/// FieldWriter and FieldReader are the ways. They find the lists of a struct's parts by themselves, by argument-dependent
/// lookup: the lists stand in this namespace, not in an unnamed one.
template <class Way, class Part>
using PartOf = typename Way::template PartOf<Part>;

template <class Value>
inline constexpr bool isReal = std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>;

/// Writes into one object, in the order of the list.
class FieldWriter {
public:
    template <class Part>
    using PartOf = const Part&;

    explicit FieldWriter(nlohmann::ordered_json& object) : _object(object) {
        object = nlohmann::ordered_json::object();
    }

    /// Anything that nlohmann's library writes and reads.
    template <class Value>
    void field(const char* name, const Value& value) {
        if constexpr (isReal<Value>)
            _object[name] = jsonOf(value);
        else
            _object[name] = value;
    }

    /// What follows from other fields: nothing reads it back.
    template <class Value>
    void derived(const char* name, const Value& value) {
        field(name, value);
    }

    /// An object whose fields `list` lists, given the way into it.
    template <class List>
    void group(const char* name, List list) {
        FieldWriter inner(_object[name]);
        list(inner);
    }

    /// A part with fields of its own.
    template <class Part>
    void object(const char* name, const Part& part) {
        group(name, [&](FieldWriter& inner) { fields(inner, part); });
    }

    /// null if there is none.
    template <class Part>
    void object(const char* name, const std::optional<Part>& part) {
        _object[name] = nullptr;
        if (part) object(name, *part);
    }

    /// A list of parts.
    template <class Part>
    void list(const char* name, const std::vector<Part>& parts) {
        nlohmann::ordered_json& array = _object[name] = nlohmann::ordered_json::array();
        for (const Part& part : parts) {
            FieldWriter inner(array.emplace_back());
            fields(inner, part);
        }
    }

private:
    nlohmann::ordered_json& _object;
};

/// Reads from one object. What it throws says in which part: "points[3]: cost: …".
class FieldReader {
public:
    template <class Part>
    using PartOf = Part&;

    explicit FieldReader(const nlohmann::json& object) : _object(object) {}

    template <class Value>
    void field(const char* name, Value& value) {
        const nlohmann::json& from = fieldOf(_object, name);
        readKind(name, [&] {
            if constexpr (isReal<Value>)
                readNumber(from, value);
            else if constexpr (std::is_unsigned_v<Value> && !std::is_same_v<Value, bool>)
                value = from.is_number_unsigned() ? from.get<Value>() : throw std::invalid_argument("");
            else
                from.get_to(value);
        });
    }

    template <class Value>
    void derived(const char*, const Value&) {}

    template <class List>
    void group(const char* name, List list) {
        FieldReader inner(fieldOf(_object, name));
        readInside(name, [&] { list(inner); });
    }

    template <class Part>
    void object(const char* name, Part& part) {
        group(name, [&](FieldReader& inner) { fields(inner, part); });
    }

    template <class Part>
    void object(const char* name, std::optional<Part>& part) {
        part.reset();
        if (!fieldOf(_object, name).is_null()) object(name, part.emplace());
    }

    template <class Part>
    void list(const char* name, std::vector<Part>& parts) {
        parts.clear();
        const nlohmann::json& array = fieldOf(_object, name);
        readKind(name, [&] { (void)array.get_ref<const nlohmann::json::array_t&>(); });
        for (const nlohmann::json& from : array) {
            FieldReader inner(from);
            readInside(name + ("[" + std::to_string(parts.size()) + "]"), [&] { fields(inner, parts.emplace_back()); });
        }
    }

private:
    const nlohmann::json& _object;
};

} // namespace gnomon::examples
