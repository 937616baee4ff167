#include "base/link_mark.h"

namespace espalier {

std::optional<std::filesystem::path> folder_of_link(const std::filesystem::path& path) {
    std::error_code ignored;
    for (std::filesystem::path folder = path; folder.has_relative_path(); folder = folder.parent_path()) {
        if (std::filesystem::exists(folder / link_mark, ignored)) return folder;
    }
    return std::nullopt;
}

}  // namespace espalier
