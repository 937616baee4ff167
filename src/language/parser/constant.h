// The value of an expression that reads no variable.
#pragma once

#include "espalier/lsystem/expression.h"

#include <optional>

namespace espalier::language {

/// Nothing if the expression reads a variable, uses a random number, or has no finite value.
std::optional<double> constant_value(const Expression& expression);

}  // namespace espalier::language
