#include "looking_half.h"

#include "espalier/base/error.h"

#include "base/platform.h"
#include "program_data.h"

#include <filesystem>
#include <string>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// Beside the program in a build folder, in the folder of libraries once installed; empty if it is in neither.
fs::path module_file() {
    std::error_code ignored;
    const fs::path folder = program_folder();
    for (const fs::path& place : {folder, folder / ESPALIER_MODULES}) {
        const fs::path file = place / "libespalier_look_commands.so";
        if (fs::exists(file, ignored)) return file;
    }
    return {};
}

}  // namespace

bool open_looking_half() {
    static const bool opened = [] {
        const fs::path file = module_file();
        if (file.empty()) return false;
        std::string why;
        if (!platform::open_library(file, /*shared=*/true, why)) throw RunError("cannot open " + why);
        return true;
    }();
    return opened;
}

}  // namespace espalier::app
