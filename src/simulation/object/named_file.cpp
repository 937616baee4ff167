#include "simulation/object/named_file.h"

#include <fmt/format.h>

namespace espalier::simulation {

namespace fs = std::filesystem;

fs::path named_file(const std::string& name, const fs::path& beside, const fs::path& folder, const Place& place) {
    std::error_code ignored;
    for (const fs::path& where : {beside, folder}) {
        if (fs::is_regular_file(where / name, ignored)) return where / name;
    }
    const std::string there = beside.empty() ? "here" : "in " + beside.string();
    throw UserError(place, fmt::format("there is no file '{}' {}{}", name, there,
                                       folder.empty() || folder == beside ? "" : " or in " + folder.string()));
}

}  // namespace espalier::simulation
