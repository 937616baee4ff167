// Side files on their own: what `espalier check plant.v` says.
#pragma once

#include "espalier/base/error.h"
#include "espalier/turtle/view_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::simulation {

struct Findings {
    std::vector<Diagnostic> diagnostics;
    std::vector<std::string> facts;  ///< lines that say what was read
};

/// True if the extension is that of a side file (.v, .a, .e, .map, ...).
bool is_side_file(const std::filesystem::path& path);
/// Reads it as a run would. Throws UserError if it cannot.
void check_side_file(const std::filesystem::path& path, Findings& findings);

/// What a view file gives the turtle.
void review_view(const View& view, Findings& findings);

}  // namespace espalier::simulation
