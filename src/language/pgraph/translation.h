// From a graph to the text of a model whose string is the tree of instances.
#pragma once

#include "language/pgraph/graph.h"

#include <string>

namespace espalier::language::pgraph {

/// A component `stem` becomes the modules `stem`, which one step replaces, and `Stem`, which stays and is drawn. Throws
/// UserError with every mistake at its place.
std::string translate(const Graph& graph);

}  // namespace espalier::language::pgraph
