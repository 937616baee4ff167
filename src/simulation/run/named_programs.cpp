#include "simulation/run/named_programs.h"

#include "espalier/base/file.h"

#include "base/folder.h"
#include "base/state_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A value of the command line belongs to the scene that it changes.
fs::path folder_of(const Place& place, const Scene& scene) {
    std::error_code error;
    const bool in_file = fs::is_regular_file(place.file, error);
    const fs::path file = in_file ? fs::path(place.file) : scene.path;
    return file.empty() ? resolved(".") : resolved(file).parent_path();
}

fs::path list_of_trusted() {
    const fs::path folder = state_folder();
    return folder.empty() ? folder : folder / "trusted-folders.json";
}

/// Those that are still there: another that comes to its place later has to be agreed to anew.
std::set<std::string> trusted() {
    std::set<std::string> folders;
    const fs::path file = list_of_trusted();
    if (file.empty() || !is_readable(file)) return folders;
    const Json list = Json::parse(read_text(file), nullptr, /*allow_exceptions=*/false);
    std::error_code ignored;
    for (const Json& folder : list) {
        if (folder.is_string() && fs::is_directory(folder.get<std::string>(), ignored)) folders.insert(folder);
    }
    return folders;
}

}  // namespace

std::vector<NamedProgram> programs_of(const Scene& scene) {
    std::vector<NamedProgram> programs;
    for (const auto& [name, table] : scene.environment.processes) {
        if (!table.has("process") || table.text("process") != "external") continue;
        const Place place = table.place("command");
        programs.push_back({name, table.texts_or("command", {}), place, folder_of(place, scene)});
    }
    return programs;
}

fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path found = fs::weakly_canonical(path, error);
    const fs::path whole = error ? fs::absolute(path).lexically_normal() : found;
    return whole.has_filename() ? whole : whole.parent_path();
}

bool is_trusted(const fs::path& folder) {
    return trusted().contains(resolved(folder).string());
}

void remember_trust(const fs::path& folder) {
    const fs::path file = list_of_trusted();
    if (file.empty()) throw RunError("there is no place to remember it: neither HOME nor XDG_STATE_HOME is set");
    std::set<std::string> folders = trusted();
    folders.insert(resolved(folder).string());
    make_folder(file.parent_path());
    write_private_text(file, Json(folders).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace espalier::simulation
