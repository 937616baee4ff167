// The kinds of parts that `espalier list` knows.
#pragma once

#include "model_library.h"

#include <string>
#include <vector>

namespace espalier::app {

struct PartKind {
    std::string name;
    std::string summary;
    std::vector<PartDescription> (*parts)();  ///< null for models, which have folders
};

const std::vector<PartKind>& part_kinds();
/// Null if there is none of this name.
const PartKind* find_part_kind(const std::string& name);

/// The scenes below a folder, sorted; none if there is no such folder.
std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder);

}  // namespace espalier::app
