// How `markers` tells that growth has ended. Commands that have options of their own give another remedy.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace espalier::environment {

inline constexpr std::string_view growth_has_ended = ": growth has ended: ", remedy_begins = ": choose ";

/// `remedy` may be empty.
inline std::string end_of_growth(int step, const std::string& what, const std::string& remedy) {
    return fmt::format("step {}{}{}{}{}", step, growth_has_ended, what, remedy.empty() ? "" : remedy_begins, remedy);
}

/// The message without its remedy; empty if it does not tell the end of growth.
inline std::string told_end_of_growth(const std::string& message) {
    if (message.find(growth_has_ended) == std::string::npos) return "";
    return message.substr(0, message.find(remedy_begins));
}

}  // namespace espalier::environment
