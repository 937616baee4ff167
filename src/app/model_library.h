// The models that come with Espalier: where they are, and what each says of itself.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::app {

/// A line or more of `espalier list`.
struct PartDescription {
    std::string name, summary, help;
};

/// The folder given, or else the first there is of: `models` here or in a folder above, and the one that comes with the
/// program. Throws UserError if there is none.
std::filesystem::path model_library(const std::filesystem::path& given);

/// Every model below a folder: its path, the first line of its leading comment without a number in front, and the rest
/// of that comment. Sorted folder by folder.
std::vector<PartDescription> models_of(const std::filesystem::path& folder);

/// True for a model in the language of models or in another notation.
bool describes_model(const std::filesystem::path& file);

/// True for a file that describes a scene, false for one that describes a mesh or anything else.
bool describes_scene(const std::filesystem::path& file);

/// The same of one file, whatever its kind.
PartDescription describe_file(const std::filesystem::path& file);

void print_part(const PartDescription& part);
/// Names and summaries in two columns.
void print_parts(const std::vector<PartDescription>& parts);
nlohmann::ordered_json json_of(const std::vector<PartDescription>& parts);
void print_json(const nlohmann::ordered_json& list);

}  // namespace espalier::app
