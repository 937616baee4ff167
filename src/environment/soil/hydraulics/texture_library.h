// Soils by the names of their textures.
#pragma once

#include "environment/soil/hydraulics/soil_kind.h"

#include <span>
#include <string_view>

namespace espalier::environment {

struct NamedSoil {
    std::string_view name;
    SoilKind soil;
};

/// Means of the texture classes of the USDA (Carsel & Parrish 1988, tables 6 and 7); "rosetta sand" and the like: of
/// the same classes (Schaap, Leij & van Genuchten 2001, with Ks and l = 0.5); "hypres topsoil coarse" and the like: the
/// classes of European soils (Woesten et al. 1999, table 4).
std::span<const NamedSoil> texture_library();

/// The class of the USDA, as "sandy loam", from percentages of mass.
std::string_view texture_class(double sand, double clay);

}  // namespace espalier::environment
