// Graphs of components as the studio's page shows and edits them: the text stays what its author wrote, comments and
// all, but for the lines that an edit is about.
#pragma once

#include "studio/protocol/graph.h"

#include <filesystem>
#include <string>

namespace espalier::studio {

/// The graph of a text; none if the text has mistakes.
std::optional<ComponentGraph> read_graph(const std::filesystem::path& file, const std::string& text);
/// The types of components with every key, its unit, range and default.
std::vector<ComponentForm> component_forms();

/// The text after an edit. Throws UserError if a part of the edit is missing, if there is no such component, key or
/// link, or if the graph cannot be read.
std::string edited_graph(const std::filesystem::path& file, const std::string& text, const GraphEdit& edit);

}  // namespace espalier::studio
