// What the processes of a growth know of organs, as columns that pages colour modules by.
#pragma once

#include "espalier/simulation/scene.h"
#include "espalier/timeline/frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace espalier::studio {

/// A column of what processes know of organs, with its unit.
struct OrganColumn {
    std::string name, unit;
};

/// The numbers that are kept of each step: what the scene records of organs, and the first that each process
/// knows, such as "light.absorbed".
std::vector<OrganColumn> organ_columns(const Scene& scene, const Environment& environment);

/// The message `ESC1` of docs/developer/studio-protocol.md, as if of step 0: a value for each module of the frame.
std::string organ_column(const Frame& frame, std::uint32_t growth, const std::string& name);

}  // namespace espalier::studio
