// The pieces of axes of a plant in OPF, as measured lines; and scenes of several plants.
#pragma once

#include "espalier/language/measured_plants.h"

#include <filesystem>
#include <string>

namespace espalier::language::opf {

/// One file, .opf. Throws UserError with the place of a mistake.
MeasuredPlants read_plants(std::string text, const std::string& name, const MeasuredOptions& options);
/// A scene, .ops, which names files and where they stand. Throws UserError for a file that is missing, too.
MeasuredPlants read_scene(const std::string& text, const std::filesystem::path& path, const MeasuredOptions& options);

}  // namespace espalier::language::opf
