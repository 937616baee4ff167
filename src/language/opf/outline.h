// Flat meshes as one polygon, so that a leaf is one thing that is drawn.
#pragma once

#include "espalier/language/measured_plants.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace espalier::language::opf {

/// The border of a mesh, if that is flat and has one without holes.
std::optional<std::vector<std::uint32_t>> outline_of(const MeasuredMesh& mesh);

}  // namespace espalier::language::opf
