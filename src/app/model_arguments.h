// A model and its side files as the command line gives them, and what is said of them before anything grows.
#pragma once

#include "espalier/simulation/object.h"

#include "commands.h"

namespace espalier {

/// True for a scene file (.toml); anything else is a model or the folder of an object.
bool is_scene(const std::filesystem::path& path);

/// The files that the arguments name; those of a folder, where the arguments name none. Throws UserError.
ObjectFiles object_of(const ModelArguments& arguments);

/// Throws UserError if side files are given beside a scene, which names its own.
void reject_side_files(const ModelArguments& arguments);

/// "model plant.l, view plant.v, ..." of an object.
std::string taken_files(const ObjectFiles& object);

/// Prints on standard error, each once, what was noticed in the scene's files; as warnings, because the run goes on.
void print_warnings(const std::vector<Diagnostic>& diagnostics);

}  // namespace espalier
