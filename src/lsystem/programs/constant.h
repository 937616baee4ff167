// Expressions whose value is known before anything grows.
#pragma once

#include "espalier/lsystem/arithmetic.h"
#include "espalier/lsystem/expression.h"

#include <optional>

namespace espalier::lsystem {

/// Nothing if it reads a variable, draws a random number, does something, divides by zero or has not as many
/// arguments as its function takes. What stands behind a decided `&&`, `||` or `?:` may be anything.
std::optional<double> constant_value(const Expression& expression, Arithmetic arithmetic);

}  // namespace espalier::lsystem

namespace espalier {

using lsystem::constant_value;

}  // namespace espalier
