// What the page and the program tell each other, declared once. A struct tells its fields with their names, help and
// ranges; that gives the JSON, the types of the page, the tables of docs/developer/studio-protocol.md and the words of
// the fuzzer:
//
//   struct FrameRequest {
//       static constexpr TypeName type{"FrameRequest", "a step of a growth"};
//       std::uint32_t growth = 0;
//       int step = 0;
//
//       template <class Self, class Fields>
//       static void declare(Self& self, const Fields& field) {
//           field("growth", self.growth, "number of the growth");
//           field("step", self.step, "step from 0 on", at_least(0));
//       }
//   };
//
// A field is a truth value, a number, a text, such a struct, a Nullable of these, a list, or a map by names. What lies
// in a std::optional may be left out.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace espalier::studio {

/// The name that a struct has in the page's TypeScript, and what it is.
struct TypeName {
    std::string_view name, help;
};

/// What a number or a text may be: numbers within bounds, words among some that stand between blanks.
struct Allowed {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::string_view words = {};
};

constexpr Allowed at_least(double lowest) {
    return {.lowest = lowest};
}
constexpr Allowed between(double lowest, double highest) {
    return {.lowest = lowest, .highest = highest};
}
constexpr Allowed one_of(std::string_view words) {
    return {.words = words};
}

/// Null in JSON where it has no value.
template <class Value>
class Nullable : public std::optional<Value> {
public:
    using std::optional<Value>::optional;
    Nullable(const std::optional<Value>& value) : std::optional<Value>(value) {}
};

/// A cell of a table: nothing, a number or a text.
using Cell = std::variant<std::nullptr_t, double, std::string>;

/// What holds no field.
struct Nothing {
    static constexpr TypeName type{"object", "nothing"};

    template <class Self, class Fields>
    static void declare(Self&, const Fields&) {}
};

template <class Type>
concept Declared = requires {
    Type::type.name;
};

template <class Type>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

template <class Type>
inline constexpr bool is_nullable = false;
template <class Value>
inline constexpr bool is_nullable<Nullable<Value>> = true;

template <class Type>
inline constexpr bool is_list = false;
template <class Value>
inline constexpr bool is_list<std::vector<Value>> = true;

template <class Type>
inline constexpr bool is_map = false;
template <class Value>
inline constexpr bool is_map<std::map<std::string, Value>> = true;

}  // namespace espalier::studio
