#include "program_data.h"

#include "base/platform.h"

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

bool is_data(const fs::path& folder) {
    return fs::is_directory(folder / "models") && fs::is_directory(folder / "environments");
}

}  // namespace

fs::path program_folder() {
    return platform::program_file().parent_path();
}

fs::path program_data() {
    const fs::path folder = program_folder();
    const fs::path installed = folder / ESPALIER_DATA;  // as seen from where programs are installed
    if (is_data(installed)) return installed.lexically_normal();
    for (fs::path here = folder; here.has_relative_path(); here = here.parent_path()) {
        if (is_data(here)) return here;
    }
    return {};
}

fs::path here_or_with_program(const fs::path& file) {
    if (file.is_absolute() || fs::exists(file)) return file;
    const fs::path data = program_data();
    return !data.empty() && fs::exists(data / file) ? data / file : file;
}

}  // namespace espalier::app
