#include "temporary_folder.h"

#include "espalier/base/error.h"

#include "base/folder.h"
#include "base/platform.h"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

namespace espalier::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* inside = "files";

// Its program has ended without removing it. A program makes what is inside after it has locked the folder.
bool is_abandoned(const fs::path& folder) {
    std::error_code error;
    return fs::is_directory(fs::symlink_status(folder / inside, error)) && fs::exists(folder / ".lock", error) &&
           !is_locked(folder);
}

void remove_abandoned(const fs::path& where, const std::string& prefix) {
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(where, error)) {
        const std::string name = entry.path().filename().string();
        std::error_code ignored;
        if (name.starts_with(prefix) && is_abandoned(entry.path())) fs::remove_all(entry.path(), ignored);
    }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
    const std::string prefix = fmt::format("espalier-{}-", purpose);
    std::error_code error;
    const fs::path where = fs::temp_directory_path(error);
    if (!error) {
        remove_abandoned(where, prefix);
        home_ = fs::absolute(where) / (prefix + "XXXXXX");
        error = platform::make_unique_folder(home_);
    }
    if (error) {
        const char* wanted = std::getenv("TMPDIR");
        throw RunError(
            fmt::format("cannot make a temporary folder in {}: {}", wanted ? wanted : "/tmp", error.message()));
    }
    lock_.emplace(home_);
    path_ = home_ / inside;
    make_folder(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(home_, ignored);
}

}  // namespace espalier::app
