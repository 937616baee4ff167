// Whether a model asks anything of the turtle or of a process.
#pragma once

#include "espalier/lsystem/alphabet.h"

namespace espalier::turtle {

/// True if the alphabet has a query: a symbol that begins with `?`, or its older name s.
bool has_queries(const Alphabet& alphabet);

}  // namespace espalier::turtle
