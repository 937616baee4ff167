// What each internode, and each thing that is no internode, stands on.
#pragma once

#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/module_string.h"

#include <cstdint>
#include <vector>

namespace espalier::turtle {

/// The bearer of an internode that stands on none.
inline constexpr std::uint32_t no_bearer = 0xFFFFFFFF;

/// The last internode drawn before each one on its branch, or on the branches that bear it; the string that was
/// interpreted tells them. A bearer comes before what it bears. Within one module's picture the places tell.
std::vector<std::uint32_t> internode_bearers(const PlantGeometry& geometry, const ModuleString& string);

/// The internodes that bear organs, polygons, pieces of meshes and labels.
class OrganBearers {
public:
    /// Keeps a reference to the geometry.
    OrganBearers(const PlantGeometry& geometry, const ModuleString& string);

    /// Returns what bears a module's drawing at a place: the last internode before it, or the nearest of the module's
    /// own internodes, if it draws any. `no_bearer`: none.
    std::uint32_t of(std::uint32_t module, const glm::dvec3& place) const;

private:
    const PlantGeometry& geometry_;
    std::vector<std::uint32_t> last_;  ///< last internode of each module, its own included
};

}  // namespace espalier::turtle
