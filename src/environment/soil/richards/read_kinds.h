// Soils of a scene: by a name of the library or of the scene, or as a table of parameters.
#pragma once

#include "environment/soil/richards/parameters.h"

namespace espalier::environment {

/// Reads the key, a name or a table, and adds the soil to `parameters.kinds` unless it is there; returns its number.
/// Throws UserError.
std::size_t read_soil_kind(const Settings& settings, const std::string& key, const Settings& named_soils,
                           SoilParameters& parameters);

/// The soil of this name. `place` stands in messages.
std::size_t find_soil_kind(const std::string& name, const Place& place, const Settings& named_soils,
                           SoilParameters& parameters);

}  // namespace espalier::environment
