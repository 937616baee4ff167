// A field as the studio's page draws it.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/geometry/field.h"

#include <cstdint>
#include <string>

namespace espalier::studio {

/// The message `ESF1` of docs/developer/studio-protocol.md: the field over the box that viewers show, in at most 64
/// voxels along each side.
std::string field_bytes(const Field& field, std::uint32_t growth, int step);
std::string field_bytes(const RecordedField& field, std::uint32_t growth, int step);

}  // namespace espalier::studio
