// Names of files that the studio writes: those of documents and of what their readers know, and nothing that a shell,
// another program or another system takes for more than a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace espalier::studio {

/// Why a file of this name, relative to the folder where it is written, is refused; none if it may be written. Each
/// part is a name in printable UTF-8 that does not begin with a dot, is no device of Windows and holds no character
/// that some file system refuses; the last part has the extension of a document or a side file, or is `specifications`.
std::optional<std::string> refusal_of_name(const std::filesystem::path& name);

/// Throws UserError that names the file and says why it is refused.
void require_plain_name(const std::filesystem::path& name);

}  // namespace espalier::studio
