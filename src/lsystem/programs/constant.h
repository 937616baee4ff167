// Expressions whose value is known before anything grows.
#pragma once

#include "espalier/lsystem/arithmetic.h"
#include "espalier/lsystem/expression.h"

#include <optional>
#include <span>

namespace espalier::lsystem {

/// Nothing if it reads a variable, draws a random number, does something, divides by zero or has not as many
/// arguments as its function takes. What stands behind a decided `&&`, `||` or `?:` may be anything.
/// Formal parameters have the values given for them.
std::optional<double> constant_value(const Expression& expression, Arithmetic arithmetic,
                                     std::span<const double> formals = {});

}  // namespace espalier::lsystem
