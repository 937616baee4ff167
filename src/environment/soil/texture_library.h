// Soils by the names of their textures.
#pragma once

#include "environment/soil/soil_kind.h"

#include <span>
#include <string_view>

namespace espalier::environment {

struct NamedSoil {
    std::string_view name;
    SoilKind soil;
};

/// Means of the texture classes of the USDA (Carsel & Parrish 1988, tables 6 and 7), and "hypres topsoil coarse" and
/// the like: the classes of European soils (Woesten et al. 1999, table 4).
std::span<const NamedSoil> texture_library();

}  // namespace espalier::environment
