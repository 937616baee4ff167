// Global variables that modules use for themselves alone, so that they need no order.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include <optional>
#include <vector>

namespace espalier::lsystem {

/// By global: whether every production and block that reads it has assigned it before, so that each may have one of its
/// own. Nothing if modules must be replaced one after the other all the same: productions assign what others read, or
/// elements of arrays, take random numbers before their condition, or do what has an order.
std::optional<std::vector<bool>> find_locals(const LSystem& system);

/// Whether it matters to an expression that a block of such a production has run before it: the block assigns what the
/// expression reads, or may fail.
bool is_needed(const Block& block, const Expression& expression);

}  // namespace espalier::lsystem
