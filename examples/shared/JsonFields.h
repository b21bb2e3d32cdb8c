// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

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
void readField(const nlohmann::json& object, const char* name, std::vector<std::string>& value);
/// Finite ones.
void readField(const nlohmann::json& object, const char* name, std::vector<double>& value);
/// A list of pairs, [["name", "value"], …], which keeps their order.
void readField(const nlohmann::json& object, const char* name, std::vector<std::pair<std::string, std::string>>& value);
/// The same for what is an object or a list itself. null is allowed where `orNull`.
const nlohmann::json& objectField(const nlohmann::json& object, const char* name, bool orNull = false);
const nlohmann::json& listField(const nlohmann::json& object, const char* name);

/// Runs `read`; whatever it throws begins with `place` then: "points[3]: …".
void readInside(const std::string& place, const std::function<void()>& read);

/// A struct's fields are listed once, for the way into a file and for the way back:
///     template <class Way> static void fields(Way& way, PartOf<Way, Point> point) { way.field("x", point.x); … }
/// FieldWriter and FieldReader are the ways. They find the lists of a struct's parts by themselves, by argument-dependent
/// lookup: the lists stand in this namespace, not in an unnamed one.
template <class Way, class Part>
using PartOf = typename Way::template PartOf<Part>;

/// Writes into one object, in the order of the list where Json keeps one.
template <class Json>
class FieldWriter {
public:
    template <class Part>
    using PartOf = const Part&;

    explicit FieldWriter(Json& object) : _object(object) { object = Json::object(); }

    /// Anything that readField() reads.
    template <class Value>
    void field(const char* name, const Value& value) {
        constexpr bool real = std::is_same_v<Value, double> || std::is_same_v<Value, std::optional<double>>;
        if constexpr (real)
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

    /// The same for a part that has its own `write` to JSON, and `read`.
    template <class Part, class Write, class Read>
    void object(const char* name, const std::optional<Part>& part, Write write, Read) {
        _object[name] = part ? Json(write(*part)) : Json(nullptr);
    }

    /// A list of parts.
    template <class Part>
    void list(const char* name, const std::vector<Part>& parts) {
        Json& array = _object[name] = Json::array();
        for (const Part& part : parts) {
            FieldWriter inner(array.emplace_back());
            fields(inner, part);
        }
    }

private:
    Json& _object;
};

/// Reads from one object. What it throws says in which part: "points[3]: cost: …".
class FieldReader {
public:
    template <class Part>
    using PartOf = Part&;

    explicit FieldReader(const nlohmann::json& object) : _object(object) {}

    template <class Value>
    void field(const char* name, Value& value) {
        readField(_object, name, value);
    }

    template <class Value>
    void derived(const char*, const Value&) {}

    template <class List>
    void group(const char* name, List list) {
        FieldReader inner(objectField(_object, name));
        readInside(name, [&] { list(inner); });
    }

    template <class Part>
    void object(const char* name, Part& part) {
        readPart(name, objectField(_object, name), part);
    }

    template <class Part>
    void object(const char* name, std::optional<Part>& part) {
        const nlohmann::json& from = objectField(_object, name, true);
        part.reset();
        if (!from.is_null()) readPart(name, from, part.emplace());
    }

    template <class Part, class Write, class Read>
    void object(const char* name, std::optional<Part>& part, Write, Read read) {
        const nlohmann::json& from = objectField(_object, name, true);
        part.reset();
        if (!from.is_null()) readInside(name, [&] { part = read(from); });
    }

    template <class Part>
    void list(const char* name, std::vector<Part>& parts) {
        parts.clear();
        for (const nlohmann::json& from : listField(_object, name)) {
            const std::string place = std::string(name) + "[" + std::to_string(parts.size()) + "]";
            readPart(place, from, parts.emplace_back());
        }
    }

private:
    template <class Part>
    static void readPart(const std::string& place, const nlohmann::json& from, Part& part) {
        FieldReader inner(from);
        readInside(place, [&] { fields(inner, part); });
    }

    const nlohmann::json& _object;
};

} // namespace gnomon::examples
