// Declared structs (declaration.h) as words: for the page's types, the manual and the fuzzer.
#pragma once

#include "studio/protocol/declaration.h"

#include <algorithm>
#include <utility>

namespace espalier::studio {

/// A field, with its type as TypeScript writes it.
struct FieldText {
    std::string name, type, help;
    bool is_optional = false;
    Allowed allowed;
};

struct TypeDescription {
    std::string name, help;
    std::vector<FieldText> fields;
};

/// Those that were described, each once, in the order in which they were first used.
using TypeDescriptions = std::vector<TypeDescription>;

/// "a" | "b" of the words "a b".
std::string union_of_words(std::string_view words);

template <class Value>
std::string type_text(TypeDescriptions& all, Allowed allowed);

class FieldDescriber {
public:
    FieldDescriber(TypeDescriptions& all, std::vector<FieldText>& fields) : all_(all), fields_(fields) {}

    template <class Value>
    void operator()(const char* name, const Value&, const char* help, Allowed allowed = {}) const {
        if constexpr (is_optional<Value>) {
            fields_.push_back({name, type_text<typename Value::value_type>(all_, allowed), help, true, allowed});
        } else {
            fields_.push_back({name, type_text<Value>(all_, allowed), help, false, allowed});
        }
    }

private:
    TypeDescriptions& all_;
    std::vector<FieldText>& fields_;
};

/// Describes a struct and all that it holds. Returns its name.
template <Declared Type>
std::string describe(TypeDescriptions& all) {
    const std::string name(Type::type.name);
    const auto is_known = [&](const TypeDescription& known) { return known.name == name; };
    if (std::any_of(all.begin(), all.end(), is_known)) return name;
    const std::size_t at = all.size();
    all.push_back({name, std::string(Type::type.help), {}});
    std::vector<FieldText> fields;
    const Type value{};
    Type::declare(value, FieldDescriber(all, fields));
    all[at].fields = std::move(fields);
    return name;
}

template <class Value>
std::string type_text(TypeDescriptions& all, Allowed allowed) {
    if constexpr (Declared<Value>) {
        return describe<Value>(all);
    } else if constexpr (is_nullable<Value>) {
        return type_text<typename Value::value_type>(all, allowed) + " | null";
    } else if constexpr (is_list<Value>) {
        const std::string type = type_text<typename Value::value_type>(all, allowed);
        const bool is_union = type.find(" | ") != std::string::npos && !type.ends_with('>');
        return is_union ? "(" + type + ")[]" : type + "[]";
    } else if constexpr (is_map<Value>) {
        return "Record<string, " + type_text<typename Value::mapped_type>(all, allowed) + ">";
    } else if constexpr (std::is_same_v<Value, Cell>) {
        return "Cell";
    } else if constexpr (std::is_same_v<Value, std::string>) {
        return allowed.words.empty() ? "string" : union_of_words(allowed.words);
    } else if constexpr (std::is_same_v<Value, bool>) {
        return "boolean";
    } else if constexpr (std::is_arithmetic_v<Value>) {
        return "number";
    } else {
        static_assert(std::is_same_v<Value, std::array<double, 3>>);
        return "[number, number, number]";
    }
}

}  // namespace espalier::studio
