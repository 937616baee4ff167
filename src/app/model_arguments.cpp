#include "model_arguments.h"

#include "espalier/language/notation.h"

#include "base/number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <optional>
#include <set>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

// FILE is set 1, N=FILE set N.
void add_sets(const std::vector<std::string>& files, const char* option, std::map<int, fs::path>& sets) {
    for (const std::string& text : files) {
        const std::size_t equals = text.find('=');
        const std::optional<int> number = whole_text_as<int>(text.substr(0, equals));
        const bool numbered = equals != std::string::npos && number && *number >= 0 && *number <= 999;
        const fs::path file = numbered ? text.substr(equals + 1) : text;
        if (!fs::is_regular_file(file)) {
            throw UserError(fmt::format("{} {}: the file {} does not exist", option, text, file.string()));
        }
        sets[numbered ? *number : 1] = file;
    }
}

// Objects are more than their models: plant.v beside plant.l is meant for it, but a model alone has its own meaning.
void warn_of_files_beside(const ModelArguments& arguments, ObjectFiles& object) {
    struct SideFile {
        const char *extension, *option;
        bool is_given;
    };
    for (const SideFile& file :
         {SideFile{".v", "--view", !arguments.view.empty()}, SideFile{".a", "--animate", !arguments.animation.empty()},
          SideFile{".e", "--environment", !arguments.environment.empty() || arguments.without_environment}}) {
        const fs::path beside = fs::path(arguments.file).replace_extension(file.extension);
        if (file.is_given || !fs::is_regular_file(beside)) continue;
        Diagnostic warning;
        warning.severity = Diagnostic::Severity::warning;
        warning.place.file = beside.string();
        warning.message = fmt::format("this file lies beside the model but is not read: {} {} reads it", file.option,
                                      beside.string());
        object.diagnostics.push_back(warning);
    }
}

// The models of a library share one, in the folder of the model or in the folder above. Colours change nothing that
// grows.
fs::path colour_map_of_library(const fs::path& model) {
    const fs::path folder = model.has_parent_path() ? model.parent_path() : ".";
    for (const fs::path& place : {folder, folder / ".."}) {
        const fs::path file = (place / "plants.map").lexically_normal();
        if (fs::is_regular_file(file)) return file;
    }
    return {};
}

}  // namespace

bool is_scene(const fs::path& path) {
    return path.extension() == ".toml";
}

ObjectFiles object_of(const ModelArguments& arguments) {
    ObjectFiles object;
    if (fs::is_directory(arguments.file)) {
        object = read_object_folder(arguments.file);
    } else {
        object.model = arguments.file;
        warn_of_files_beside(arguments, object);
        object.colours_of_library = colour_map_of_library(arguments.file);
    }
    if (!arguments.view.empty()) object.view = arguments.view;
    if (!arguments.animation.empty()) object.animation = arguments.animation;
    if (!arguments.environment.empty()) object.environment = arguments.environment;
    if (!arguments.colour_maps.empty() || !arguments.materials.empty()) {
        object.colour_maps.clear();
        object.materials.clear();
    }
    add_sets(arguments.colour_maps, "--colour-map", object.colour_maps);
    add_sets(arguments.materials, "--materials", object.materials);
    if (arguments.without_environment) object.environment.clear();
    object.warns_of_unanswered = !arguments.without_environment;
    object.insertions = arguments.insertions;
    object.defines = Defines(arguments.defines.begin(), arguments.defines.end());
    const bool has_side_files =
        !arguments.view.empty() || !arguments.animation.empty() || !arguments.environment.empty();
    if (has_side_files && !notation_of(object.model)) object.arithmetic = Arithmetic::cpfg;
    object.arithmetic = arguments.arithmetic.value_or(object.arithmetic);
    return object;
}

void reject_side_files(const ModelArguments& arguments) {
    const std::vector<std::pair<bool, const char*>> given{{!arguments.view.empty(), "--view"},
                                                          {!arguments.animation.empty(), "--animate"},
                                                          {!arguments.environment.empty(), "--environment"},
                                                          {!arguments.colour_maps.empty(), "--colour-map"},
                                                          {!arguments.materials.empty(), "--materials"},
                                                          {arguments.without_environment, "--without-environment"},
                                                          {!arguments.defines.empty(), "--define"},
                                                          {!arguments.insertions.empty(), "--insert"},
                                                          {arguments.arithmetic.has_value(), "--arithmetic"}};
    for (const auto& [is_given, option] : given) {
        if (is_given) {
            throw UserError(fmt::format(
                "{} applies to a model; in a scene, the scene file names the files (espalier list scene)", option));
        }
    }
}

std::string taken_files(const ObjectFiles& object) {
    std::vector<std::string> taken{"model " + object.model.filename().string()};
    const auto add = [&](const char* what, const fs::path& path) {
        if (!path.empty()) taken.push_back(fmt::format("{} {}", what, path.filename().string()));
    };
    add("view", object.view);
    add("animation", object.animation);
    add("environment", object.environment);
    for (const auto& [set, file] : object.colour_maps) add(fmt::format("colours {}", set).c_str(), file);
    for (const auto& [set, file] : object.materials) add(fmt::format("materials {}", set).c_str(), file);
    return fmt::format("{}", fmt::join(taken, ", "));
}

void print_warnings(const std::vector<Diagnostic>& diagnostics, bool quiet) {
    std::set<std::string> said;
    for (Diagnostic diagnostic : diagnostics) {
        if (quiet && !diagnostic.insistent) continue;
        diagnostic.severity = Diagnostic::Severity::warning;
        const std::string text = to_string(diagnostic);
        // There is no output left to tell of messages that cannot be written.
        if (said.insert(text).second) std::fputs((text + "\n").c_str(), stderr);
    }
}

}  // namespace espalier::app
