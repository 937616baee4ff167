#include "base/folder.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

namespace espalier {

void make_folder(const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path.string(), error.message()));
}

}  // namespace espalier
