// Looking through the expressions of an L-system.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include <functional>
#include <optional>
#include <vector>

namespace espalier::studio {

using ExpressionTest = std::function<bool(const Expression&)>;

/// True if the test holds for the expression or for one within it.
bool holds_in(const Expression& expression, const ExpressionTest& test);
bool holds_in(const std::optional<Expression>& expression, const ExpressionTest& test);
/// True if the test holds in the blocks, the axiom, the productions or the decomposition.
bool holds_in_derivation(const LSystem& system, const ExpressionTest& test);
bool holds_in_homomorphism(const LSystem& system, const ExpressionTest& test);

}  // namespace espalier::studio
