#include "app/look/studio_documents.h"

#include "espalier/base/file.h"
#include "espalier/simulation/object.h"

#include "app/look/gallery_page.h"
#include "app/model_arguments.h"
#include "app/model_library.h"
#include "base/folder.h"
#include "simulation/object/panels.h"
#include "simulation/run/named_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

// The view file that lies beside a model and has its name; none if there is none.
fs::path view_beside(const fs::path& model) {
    const fs::path view = fs::path(model).replace_extension(".v");
    return !fs::is_directory(model) && fs::is_regular_file(view) ? view : fs::path();
}

// What the file says of itself stands beside the title, unless it is the title with an article.
LibraryEntry on_shelf(const LibraryEntry& entry, const GalleryEntry& shown) {
    constexpr std::size_t article = 3;  // "An "
    const bool says_more = entry.name.size() > shown.title.size() + article;
    const std::string between = says_more && !shown.source.empty() ? ". " : "";
    return {entry.path, shown.title, shown.source + between + (says_more ? entry.name : ""), shown.shelf,
            fs::exists(shown.picture) ? shown.picture : fs::path()};
}

std::vector<fs::path> scenes_below(const fs::path& folder) {
    std::vector<fs::path> scenes;
    if (!fs::is_directory(folder)) return scenes;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && describes_scene(entry.path())) scenes.push_back(entry.path());
    }
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

// A link that is not offered, because it would be refused.
bool leads_out(const fs::path& path, const fs::path& folder) {
    std::error_code unknown;
    return resolved_below(path, folder, unknown).empty();
}

void add_files(const fs::path& folder, std::vector<LibraryEntry>& entries) {
    std::error_code ignored;
    for (const auto& file : fs::directory_iterator(folder, ignored)) {
        if (!file.is_regular_file(ignored) || leads_out(file.path(), folder)) continue;
        if (!describes_scene(file.path()) && !describes_model(file.path())) continue;
        entries.push_back({file.path(),
                           file.path().stem().string(),
                           describe_file(file.path()).summary,
                           folder.filename().string(),
                           {},
                           true});
    }
}

void add_runs(const fs::path& folder, std::vector<LibraryEntry>& entries) {
    std::error_code ignored;
    std::set<fs::path> runs;
    for (const auto& inside : fs::directory_iterator(folder, ignored)) {
        if (leads_out(inside.path(), folder)) continue;
        if (fs::is_regular_file(inside.path() / "run.json", ignored)) runs.insert(inside.path());
    }
    for (const fs::path& run : runs) {
        entries.push_back({run, run.filename().string(), "a recorded run", folder.filename().string(), {}, true});
    }
}

// The files of the opened folder itself, and what came by links, without what lies deeper: that may be anything.
void add_own(const fs::path& opened, const fs::path& data, std::vector<LibraryEntry>& entries) {
    std::error_code ignored;
    for (const fs::path& folder : {opened, opened / "output"}) add_runs(folder, entries);
    if (opened != data) add_files(opened, entries);
    for (const auto& shared : fs::directory_iterator(opened / "shared", ignored)) add_files(shared.path(), entries);
}

}  // namespace

Scene read_opened(const studio::Opened& opened) {
    const SceneOptions options{{}, opened.steps, opened.seed};
    if (is_scene(opened.path)) return read_scene(opened.path, options);
    ModelArguments arguments;
    arguments.file = opened.path;
    arguments.view = view_beside(opened.path);
    Scene scene = scene_of_object(object_of(arguments), options);
    // To read them makes them a text of the document.
    for (Diagnostic& mistake : mistakes_in_panels_of(opened.path))
        scene.notes.diagnostics.push_back(std::move(mistake));
    return scene;
}

void require_no_programs(const Scene& scene) {
    for (const NamedProgram& program : programs_of(scene)) {
        throw UserError(program.place,
                        fmt::format("process '{}' is a program of its own, which the studio starts only with "
                                    "`espalier studio --programs`; `espalier run` starts it, once you agree",
                                    program.process));
    }
}

std::vector<std::pair<std::string, std::string>> processes_without_a_page(const Scene& scene) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const auto& [name, settings] : scene.environment.processes) {
        std::string type = settings.text_or("process", "");
        if (type == "vdb" || type == "ray-light" || type == "external") found.emplace_back(name, std::move(type));
    }
    return found;
}

StudioLibrary::StudioLibrary(fs::path folder) : folder_(std::move(folder)), models_(model_library({})) {}

std::vector<studio::LibraryEntry> StudioLibrary::entries() const {
    const fs::path data = fs::absolute(models_).lexically_normal().parent_path();
    std::map<fs::path, LibraryEntry> shipped;
    const auto add = [&](const fs::path& file) {
        const fs::path path = fs::absolute(file).lexically_normal();
        shipped[path] = {path, describe_file(path).summary, "", path.parent_path().filename().string()};
    };
    for (const PartDescription& model : models_of(data / "models")) add(model.name);
    for (const fs::path& scene : scenes_below(data / "environments")) add(scene);
    std::vector<LibraryEntry> entries;
    for (const GalleryEntry& shown : gallery_of(data)) {
        if (const auto entry = shipped.extract(shown.file)) entries.push_back(on_shelf(entry.mapped(), shown));
    }
    for (const auto& [path, entry] : shipped) entries.push_back(entry);
    add_own(folder_, data, entries);
    return entries;
}

}  // namespace espalier::app
