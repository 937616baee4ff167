// Numbers and expressions of skeleton descriptions.
#pragma once

#include "language/sdl/skeleton.h"
#include "language/sdl/token_reader.h"

#include <span>
#include <string>
#include <string_view>

namespace espalier::language::sdl {

/// A sum of products of numbers, functions and the given names; `what` it is for stands in messages. Throws
/// SyntaxError.
Formula parse_formula(TokenReader& in, std::span<const std::string> names, std::string_view what);

/// `base` plus the formula, without a sum that changes nothing.
std::string sum(const std::string& base, const Formula& formula);

/// True for what begins with a minus, which needs parentheses behind another sign.
bool begins_with_minus(const Formula& formula);

/// The formula as a factor.
std::string factor(const Formula& formula);

/// The text with a name replaced wherever it is a whole word.
std::string with_value(const std::string& text, std::string_view name, const std::string& value);

}  // namespace espalier::language::sdl
