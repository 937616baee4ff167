// Measured axes as a model.
#pragma once

#include "language/rsml/document.h"

namespace espalier::language::rsml {

/// A model whose axiom has these axes. Nodes with a time appear on their day; each root ends with a module
/// Tip(order), for which productions of one's own may be written.
std::string model_of(const Document& document, const std::string& name);

}  // namespace espalier::language::rsml
