// Which internode each internode stands on.
#pragma once

#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/module_string.h"

#include <cstdint>
#include <vector>

namespace espalier::geometry {

/// Of an internode that stands on none.
inline constexpr std::uint32_t no_bearer = 0xFFFFFFFF;

/// The last internode drawn before each one on its branch, or on the branches that bear it; the string that was
/// interpreted tells them. A bearer comes before what it bears. Within one module's picture the places tell.
std::vector<std::uint32_t> internode_bearers(const PlantGeometry& geometry, const ModuleString& string);

}  // namespace espalier::geometry

namespace espalier {

using geometry::internode_bearers;

}  // namespace espalier
