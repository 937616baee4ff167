// Lines of tables as views into their text.
#pragma once

#include <string_view>
#include <vector>

namespace espalier::language::measured {

/// The cells of a line, without the blanks and quotes around each, and without empty ones at its end. A blank as
/// separator stands for any number of blanks and tabs.
void split_cells(std::string_view line, char separator, std::vector<std::string_view>& cells);

/// The line that begins at `begin`, which then is where the next one begins.
std::string_view next_line(std::string_view text, std::size_t& begin);

}  // namespace espalier::language::measured
