// Strings of modules as bytes, for checkpoints.
#pragma once

#include "espalier/lsystem/module_string.h"

#include <iosfwd>

namespace espalier::simulation {

void save_string(const ModuleString& string, std::ostream& out);

/// Throws RunError if the string would take more than `memory` bytes, or ends too early.
void restore_string(ModuleString& string, std::size_t memory, std::istream& in);

}  // namespace espalier::simulation
