// The mark of folders that came by a link: their sender is not to be trusted.
#pragma once

#include <filesystem>
#include <optional>

namespace espalier {

/// A file of this name says that its folder came by a link.
inline constexpr const char* link_mark = ".came-by-a-link";

/// The folder with the mark that a file or folder lies in, as its path says; none if it did not come by a link.
std::optional<std::filesystem::path> folder_of_link(const std::filesystem::path& path);

}  // namespace espalier
