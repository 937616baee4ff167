// A model and its side files as the command line gives them, and what is said of them before anything grows.
#pragma once

#include "espalier/simulation/object.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::app {

using KeyValues = std::vector<std::pair<std::string, std::string>>;

/// A model on its own, or the folder of an object, and the side files given with it.
struct ModelArguments {
    std::filesystem::path file;  ///< may be a scene where a command takes one
    std::filesystem::path view, animation, environment;
    std::vector<std::string> colour_maps, materials;  ///< FILE, or N=FILE for set N
    bool without_environment = false;
    KeyValues defines;
    std::vector<std::string> insertions;
    std::optional<Arithmetic> arithmetic;  ///< none: cpfg's for folders and models with side files
};

/// True for a scene file (.toml); anything else is a model or the folder of an object.
bool is_scene(const std::filesystem::path& path);

/// The files that the arguments name; those of a folder, where the arguments name none. Throws UserError.
ObjectFiles object_of(const ModelArguments& arguments);

/// Throws UserError if side files are given beside a scene, which names its own.
void reject_side_files(const ModelArguments& arguments);

/// "model plant.l, view plant.v, ..." of an object.
std::string taken_files(const ObjectFiles& object);

/// Prints on standard error, each once, what was noticed; as warnings, because the run goes on. `quiet`: only those
/// that insist.
void print_warnings(const std::vector<Diagnostic>& diagnostics, bool quiet);

}  // namespace espalier::app
