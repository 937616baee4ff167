// Declared structs (declaration.h) as JSON, and read from JSON whose sender is not to be trusted.
#pragma once

#include "espalier/base/error.h"

#include "studio/protocol/declaration.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace espalier::studio {

using Json = nlohmann::ordered_json;

/// An object of JSON, nested at most 16 deep, whose `id` is a whole number. Throws UserError saying what it is not.
Json read_request(const std::string& text);

/// True if `word` stands between the blanks of `words`.
bool is_among(std::string_view word, std::string_view words);
/// Throws UserError if the number lies outside the bounds.
void require_within(std::string_view key, double number, Allowed allowed);
/// Throws UserError if the word is none of those that are allowed, if some are.
void require_word(std::string_view key, std::string_view word, Allowed allowed);

// --- writing

template <class Value>
Json json_of(const Value& value);

/// Writes the fields of a struct. A word that was not declared is a fault of this program.
class FieldWriter {
public:
    explicit FieldWriter(Json& object) : object_(object) {}

    template <class Value>
    void operator()(const char* name, const Value& value, const char* /*help*/, Allowed allowed = {}) const {
        if constexpr (is_optional<Value>) {
            if (value) (*this)(name, *value, "", allowed);
        } else {
            if constexpr (std::is_same_v<Value, std::string>) require_declared(name, value, allowed);
            object_[name] = json_of(value);
        }
    }

private:
    static void require_declared(const char* name, const std::string& word, Allowed allowed) {
        if (allowed.words.empty() || is_among(word, allowed.words)) return;
        throw std::logic_error(fmt::format("the protocol does not know '{}' as a value of '{}'", word, name));
    }

    Json& object_;
};

template <class Value>
Json json_of(const Value& value) {
    if constexpr (Declared<Value>) {
        Json object = Json::object();
        Value::declare(value, FieldWriter(object));
        return object;
    } else if constexpr (is_nullable<Value>) {
        return value ? json_of(*value) : Json();
    } else if constexpr (is_list<Value>) {
        Json list = Json::array();
        for (const auto& each : value) list.push_back(json_of(each));
        return list;
    } else if constexpr (is_map<Value>) {
        Json object = Json::object();
        for (const auto& [key, each] : value) object[key] = json_of(each);
        return object;
    } else if constexpr (std::is_same_v<Value, Cell>) {
        return std::visit([](const auto& each) { return Json(each); }, value);
    } else {
        return Json(value);
    }
}

// --- reading

template <class Value>
void read_value(const Json& json, std::string_view key, Value& value, Allowed allowed = {});

/// Reads the fields of a struct from an object. What else the object holds is ignored: links of other versions and
/// messages of pages hold more.
class FieldReader {
public:
    explicit FieldReader(const Json& object) : object_(object) {}

    template <class Value>
    void operator()(const char* name, Value& value, const char* /*help*/, Allowed allowed = {}) const {
        const auto found = object_.find(name);
        if constexpr (is_optional<Value>) {
            if (found != object_.end()) read_value(*found, name, value.emplace(), allowed);
        } else {
            if (found == object_.end()) throw UserError(fmt::format("'{}' is missing", name));
            read_value(*found, name, value, allowed);
        }
    }

private:
    const Json& object_;
};

/// The whole number of a key, within the bounds of its type and those that are allowed.
template <class Int>
Int whole_number(const Json& json, std::string_view key, Allowed allowed) {
    const auto fits = [&](auto number) {
        const auto real = static_cast<double>(number);
        return std::in_range<Int>(number) && real >= allowed.lowest && real <= allowed.highest;
    };
    if (json.is_number_unsigned() && fits(json.get<std::uint64_t>())) return json.get<Int>();
    if (json.is_number_integer() && fits(json.get<std::int64_t>())) return json.get<Int>();
    const std::string lowest = allowed.lowest > static_cast<double>(std::numeric_limits<Int>::min())
                                   ? fmt::format("{:.0f}", allowed.lowest)
                                   : fmt::format("{}", std::numeric_limits<Int>::min());
    const std::string highest = allowed.highest < static_cast<double>(std::numeric_limits<Int>::max())
                                    ? fmt::format("{:.0f}", allowed.highest)
                                    : fmt::format("{}", std::numeric_limits<Int>::max());
    throw UserError(fmt::format("'{}' is no whole number from {} to {}", key, lowest, highest));
}

/// The struct that an object of JSON tells. Throws UserError for keys that are missing, of the wrong type or out of
/// range.
template <Declared Type>
Type from_json(const Json& object) {
    Type value;
    Type::declare(value, FieldReader(object));
    return value;
}

template <class Value>
void read_value(const Json& json, std::string_view key, Value& value, Allowed allowed) {
    const auto require = [&](bool holds, const char* what) {
        if (!holds) throw UserError(fmt::format("'{}' is {}", key, what));
    };
    if constexpr (is_nullable<Value>) {
        if (json.is_null()) return value.reset();
        read_value(json, key, value.emplace(), allowed);
    } else if constexpr (std::is_same_v<Value, bool>) {
        require(json.is_boolean(), "neither true nor false");
        value = json.get<bool>();
    } else if constexpr (std::is_integral_v<Value>) {
        value = whole_number<Value>(json, key, allowed);
    } else if constexpr (std::is_same_v<Value, double>) {
        require(json.is_number() && std::isfinite(json.get<double>()), "no number");
        value = json.get<double>();
        require_within(key, value, allowed);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        require(json.is_string(), "no text");
        value = json.get<std::string>();
        require_word(key, value, allowed);
    } else if constexpr (is_list<Value>) {
        require(json.is_array(), "no list");
        for (const Json& each : json) read_value(each, key, value.emplace_back(), allowed);
    } else if constexpr (is_map<Value>) {
        require(json.is_object(), "no object");
        for (const auto& [name, each] : json.items()) read_value(each, key, value[name], allowed);
    } else if constexpr (Declared<Value>) {
        require(json.is_object(), "no object");
        value = from_json<Value>(json);
    } else {
        require(json.is_array() && json.size() == value.size(), "no list of as many numbers as it has");
        for (std::size_t i = 0; i < value.size(); ++i) read_value(json[i], key, value[i], allowed);
    }
}

}  // namespace espalier::studio
