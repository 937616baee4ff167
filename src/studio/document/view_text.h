// Settings of view files as the form of the studio's page changes them: the text stays what its author wrote, but for
// the values that an edit is about.
#pragma once

#include "studio/protocol/view_entry.h"

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::studio {

/// Every place of a view file that says a setting of `view_settings()`: setting after setting, each in the order of
/// the text. Comments and lines of the preprocessor are passed over.
std::vector<ViewEntry> read_view_entries(const std::filesystem::path& file, const std::string& text);

/// The text after an edit. A new place stands on a line of its own at the end; a place that is taken out takes its line
/// with it if nothing else stands there. Throws UserError if there is no such setting or place.
std::string with_view_edit(const std::string& text, const ViewEdit& edit);

}  // namespace espalier::studio
