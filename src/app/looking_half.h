// The commands that look at runs lie in a module beside the program, so that a run that grows need not load VTK.
#pragma once

#include <string_view>

namespace espalier::app {

/// Opens the module, whose commands and export formats then register themselves; does nothing the second time. False if
/// this installation has none. Throws RunError if it is there and cannot be opened.
bool open_looking_half();

/// Whether a command of this name is one of the module's, which can be said without it.
bool is_of_looking_half(std::string_view command);

}  // namespace espalier::app
