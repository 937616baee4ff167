// Strings of modules as bytes, for checkpoints.
#pragma once

#include "espalier/lsystem/alphabet.h"
#include "espalier/lsystem/module_string.h"

#include <iosfwd>

namespace espalier::simulation {

void save_string(const ModuleString& string, std::ostream& out);

/// Throws RunError if the string would take more than `memory` bytes, or ends too early.
void restore_string(ModuleString& string, std::size_t memory, std::istream& in);

/// Throws RunError for a restored string that no derivation of a model with these letters could have left: a checkpoint
/// may come from elsewhere.
void require_modules_of(const lsystem::Alphabet& alphabet, const ModuleString& string);

}  // namespace espalier::simulation
