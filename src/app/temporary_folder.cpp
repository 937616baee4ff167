#include "temporary_folder.h"

#include "espalier/base/error.h"

#include "base/platform.h"

#include <fmt/format.h>

#include <cstdlib>
#include <system_error>

namespace espalier::app {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
    std::error_code error;
    fs::path folder = fs::temp_directory_path(error);
    if (!error) folder = fs::absolute(folder) / fmt::format("espalier-{}-XXXXXX", purpose);
    if (!error) error = platform::make_unique_folder(folder);
    if (error) {
        const char* wanted = std::getenv("TMPDIR");
        throw RunError(
            fmt::format("cannot make a temporary folder in {}: {}", wanted ? wanted : "/tmp", error.message()));
    }
    path_ = folder;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace espalier::app
