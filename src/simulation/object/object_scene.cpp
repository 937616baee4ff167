// An object as a scene: what a scene file would say of it.
#include "espalier/simulation/object.h"

#include "base/toml_text.h"

#include <fmt/format.h>

#include <utility>

namespace espalier::simulation {
namespace {

std::string entry(const std::string& key, const std::filesystem::path& path) {
    return path.empty() ? "" : fmt::format("{} = {}\n", key, toml_text(path.string()));
}

std::string sets(const std::string& key, const std::map<int, std::filesystem::path>& files) {
    std::string text;
    for (const auto& [set, file] : files) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", set, toml_text(file.string()));
    }
    return text.empty() ? "" : fmt::format("{} = {{ {} }}\n", key, text);
}

std::string defines(const Defines& values) {
    std::string text;
    for (const auto& [name, value] : values) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", toml_text(name), toml_text(value));
    }
    return text.empty() ? "" : fmt::format("define = {{ {} }}\n", text);
}

std::string insertions(const std::vector<std::string>& texts) {
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + toml_text(text);
    return list.empty() ? "" : fmt::format("insert = [{}]\n", list);
}

std::string scene_text(const ObjectFiles& object) {
    std::string text = "[[plant]]\n" + entry("model", object.model) + entry("view", object.view) +
                       sets("colour_map", object.colour_maps) + sets("materials", object.materials) +
                       entry("folder", object.folder) + defines(object.defines) + insertions(object.insertions);
    if (object.arithmetic == Arithmetic::cpfg) text += "arithmetic = \"cpfg\"\n";
    std::string environment = entry("file", object.environment);
    if (!environment.empty()) environment += entry("folder", object.folder);
    if (object.keeps_unanswered) environment += "unanswered = \"keep\"\n";
    if (!environment.empty()) text += "\n[environment]\n" + environment;
    if (!object.animation.empty()) text += "\n[timeline]\n" + entry("animation", object.animation);
    return text;
}

// By their index: the next colour, ; alone, is that of any map.
bool chooses_colours(const Model& model) {
    return model.alphabet.find(";", 1) || model.alphabet.find(",", 1);
}

}  // namespace

Scene scene_of_object(const ObjectFiles& object, const SceneOptions& options) {
    const std::string name = object.name.empty() ? object.model.stem().string() : object.name;
    for (const std::filesystem::path& path : {object.model, object.view, object.animation, object.environment}) {
        if (!path.empty() && !std::filesystem::is_regular_file(path)) {
            throw UserError(fmt::format("cannot read {}: {}", path.string(),
                                        std::filesystem::exists(path) ? "not a file" : "No such file or directory"));
        }
    }
    Scene scene = read_scene_text(scene_text(object), name, {}, options);
    scene.name = name;
    scene.notes.diagnostics.insert(scene.notes.diagnostics.begin(), object.diagnostics.begin(),
                                   object.diagnostics.end());
    const Model& model = source_of(*scene.plants.front().model);
    if (!object.colours_of_library.empty() && !scene.plants.front().palette && chooses_colours(model)) {
        ObjectFiles coloured = object;
        coloured.colour_maps[1] = std::exchange(coloured.colours_of_library, {});
        return scene_of_object(coloured, options);
    }
    if (object.warns_of_unanswered && scene.environment.processes.empty() && needs_processes(model)) {
        Diagnostic warning;
        warning.severity = Diagnostic::Severity::warning;
        warning.place.file = model.path.string();
        warning.message =
            "the model queries its environment, but no process answers: its queries keep their parameters. "
            "--environment names "
            "an environment file; a scene describes an environment";
        scene.notes.diagnostics.push_back(warning);
    }
    return scene;
}

}  // namespace espalier::simulation
