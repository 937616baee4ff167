// Help texts as Markdown.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace espalier::app {

/// The same text where Markdown reads no marks in it; code between backticks stays code.
std::string markdown_text(std::string_view text);

/// A table; columns in which no row has anything are left out. Cells are Markdown already.
std::string markdown_table(const std::vector<std::string>& heading, const std::vector<std::vector<std::string>>& rows);

/// Code between backticks, or nothing if the text is empty.
std::string markdown_code(std::string_view text);

/// What `read_help` reads in a help text, block after block.
std::string markdown_help(std::string_view help);

}  // namespace espalier::app
