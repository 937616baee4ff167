#include "temporary_folder.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace espalier::app {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
    std::error_code error;
    fs::path folder = fs::temp_directory_path(error);
    if (!error) folder = fs::absolute(folder) / fmt::format("espalier-{}-XXXXXX", purpose);
    std::string name = folder.string();
    if (!error && !mkdtemp(name.data())) error = {errno, std::generic_category()};
    if (error) {
        const char* wanted = std::getenv("TMPDIR");
        throw RunError(
            fmt::format("cannot make a temporary folder in {}: {}", wanted ? wanted : "/tmp", error.message()));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace espalier::app
