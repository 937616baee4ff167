#include "app/program_data.h"

namespace espalier::app {

std::filesystem::path program_folder() {
    return {};
}

/// Where the page's worker unpacks the library.
std::filesystem::path program_data() {
    return "/library";
}

std::filesystem::path here_or_with_program(const std::filesystem::path& file) {
    return std::filesystem::exists(file) ? file : program_data() / file;
}

}  // namespace espalier::app
