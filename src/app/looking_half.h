// The commands that look at runs lie in a module beside the program, so that a run that grows need not load VTK.
#pragma once

namespace espalier::app {

/// Opens the module, whose commands and export formats then register themselves; does nothing the second time. False if
/// this installation has none. Throws RunError if it is there and cannot be opened.
bool open_looking_half();

}  // namespace espalier::app
