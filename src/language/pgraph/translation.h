// From a graph to the text of a model whose string is the tree of instances.
#pragma once

#include "espalier/language/notation.h"

#include "language/pgraph/graph.h"

namespace espalier::language::pgraph {

/// A component `stem` becomes the modules `stem`, which one step replaces, and `Stem`, which stays and is drawn. Throws
/// UserError with every mistake at its place.
TranslatedText translate(const Graph& graph);

}  // namespace espalier::language::pgraph
