#include "base/reason.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <system_error>

namespace espalier {

std::string reason_of(const std::exception& error) {
    if (const auto* const of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
        if (of_file->path1().empty()) return "the name of a file or folder is empty";
        return fmt::format("{}: {}", of_file->path1().string(), of_file->code().message());
    }
    if (const auto* const of_system = dynamic_cast<const std::system_error*>(&error)) {
        return of_system->code().message();
    }
    if (dynamic_cast<const std::bad_alloc*>(&error)) return "the machine has no memory left";
    return error.what();
}

}  // namespace espalier
