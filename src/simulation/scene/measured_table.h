// The keys of a [[plant]] whose model is a file of measured plants.
#pragma once

#include "espalier/base/settings.h"
#include "espalier/language/measured_plants.h"

#include <glm/vec3.hpp>

namespace espalier::simulation {

/// How the file is read: `unit`, `up`, `pixel` and `plants`.
MeasuredOptions read_measured_options(const Settings& plant);

/// What is taken from the places in the file, m: none, or with `begin = "position"` where its first plant begins.
glm::dvec3 read_measured_shift(const Settings& plant, const MeasuredPlants& plants);

}  // namespace espalier::simulation
