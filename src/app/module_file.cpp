#include "module_file.h"

#include "program_data.h"

#include <system_error>

namespace espalier::app {

std::filesystem::path module_file(const std::string& name) {
    std::error_code ignored;
    const std::filesystem::path folder = program_folder();
    for (const std::filesystem::path& place : {folder, folder / ESPALIER_MODULES}) {
        const std::filesystem::path file = place / name;
        if (std::filesystem::exists(file, ignored)) return file;
    }
    return {};
}

}  // namespace espalier::app
