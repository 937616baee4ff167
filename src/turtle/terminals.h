// What is left of a string for other programs: the modules that are drawn.
#pragma once

#include "espalier/lsystem/lsystem.h"
#include "espalier/lsystem/module_string.h"

namespace espalier::turtle {

class SymbolTable;

/// The string without its nonterminals: modules that no symbol of the turtle contains and no homomorphism pictures, as
/// apices and counters (Lintermann & Deussen 1997, section 2). Branches stay. The result has no lineage.
ModuleString terminals_of(const Model& model, const SymbolTable& symbols, const ModuleString& string);

}  // namespace espalier::turtle
