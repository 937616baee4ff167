// Graphs of components as the studio's page shows and edits them: the text stays what its author wrote, comments and
// all, but for the lines that an edit is about.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace espalier::studio {

/// One of `document.graphs` of docs/studio-protocol.md, without its types; null for a text with mistakes.
nlohmann::ordered_json graph_json(const std::filesystem::path& file, const std::string& text);
/// The types of components with every key, its unit, range and default.
nlohmann::ordered_json component_types_json();

/// The text after the edit that a request `graph` asks for. Throws UserError if there is no such component, key or
/// link, or if the graph cannot be read.
std::string edited_graph(const std::filesystem::path& file, const std::string& text,
                         const nlohmann::ordered_json& edit);

}  // namespace espalier::studio
