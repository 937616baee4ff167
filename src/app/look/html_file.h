// Pages that commands write.
#pragma once

#include <filesystem>
#include <string>

namespace espalier::app {

/// Makes the folder of the file where it is missing. Throws UserError for the name of another kind of file.
void write_html(const std::filesystem::path& output, const std::string& page);

}  // namespace espalier::app
