// What a page sends, read as text whose sender is not to be trusted.
#pragma once

#include "espalier/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <utility>

namespace espalier::studio {

/// An object of JSON, nested at most 16 deep, whose `id` is a whole number. Throws UserError saying what it is not.
nlohmann::ordered_json read_request(const std::string& text);

/// The whole number that a request has under a key. Throws UserError if it is none, or lies outside.
template <class Int>
Int whole(const nlohmann::ordered_json& request, const char* key, Int lowest = 0,
          Int highest = std::numeric_limits<Int>::max()) {
    const auto& value = request.at(key);
    const auto fits = [&](auto number) {
        return std::cmp_greater_equal(number, lowest) && std::cmp_less_equal(number, highest);
    };
    if (value.is_number_unsigned() && fits(value.get<std::uint64_t>())) return value.get<Int>();
    if (value.is_number_integer() && fits(value.get<std::int64_t>())) return value.get<Int>();
    throw UserError(fmt::format("'{}' is no whole number from {} to {}", key, lowest, highest));
}

}  // namespace espalier::studio
