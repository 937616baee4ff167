#include "simulation/run/written_files.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/folder.h"
#include "base/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace espalier::simulation {

namespace fs = std::filesystem;

fs::path files_folder_of(const fs::path& output) {
    return output / "files";
}

std::set<fs::path> files_below(const fs::path& folder) {
    std::set<fs::path> files;
    if (!is_folder_itself(folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder));
    }
    return files;
}

std::optional<std::set<fs::path>> files_before_run(const fs::path& output) {
    std::error_code error;
    if (!fs::is_regular_file(output / "run.json", error)) return std::nullopt;
    const auto run = read_json<nlohmann::ordered_json>(read_text(output / "run.json"));
    if (!run.is_object() || !run.contains("files_before") || !run["files_before"].is_array()) return std::nullopt;
    std::set<fs::path> files;
    for (const auto& name : run["files_before"]) {
        if (name.is_string()) files.insert(name.get<std::string>());
    }
    return files;
}

void remove_written_files(const fs::path& output, const std::set<fs::path>& kept) {
    const fs::path folder = files_folder_of(output);
    try {
        for (const fs::path& name : files_below(folder)) {
            if (kept.contains(name)) continue;
            fs::remove(folder / name);
            std::error_code in_use;  // a folder that still holds something stays
            for (fs::path above = (folder / name).parent_path(); above != output && !in_use;) {
                fs::remove(above, in_use);
                above = above.parent_path();
            }
        }
    } catch (const fs::filesystem_error& error) {
        throw RunError(
            fmt::format("cannot remove what the run before wrote in {}: {}", folder.string(), error.code().message()));
    }
}

}  // namespace espalier::simulation
