#include "base/folder.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {
namespace {

namespace fs = std::filesystem;

// weakly_canonical leaves a relative path relative if it does not exist.
fs::path resolved(const fs::path& path, std::error_code& error) {
    const fs::path whole = fs::absolute(path, error);
    return error ? whole : fs::weakly_canonical(whole, error);
}

}  // namespace

void make_folder(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error) throw RunError(fmt::format("cannot make the folder {}: {}", path.string(), error.message()));
}

fs::path resolved_below(const fs::path& path, const fs::path& folder, std::error_code& error) {
    const fs::path root = resolved(folder, error);
    if (error) return {};
    const fs::path whole = resolved(path, error);
    const bool is_below = std::mismatch(root.begin(), root.end(), whole.begin(), whole.end()).first == root.end();
    return !error && is_below ? whole : fs::path();
}

}  // namespace espalier
