// Grids as OpenVDB writes them, only faster.
#pragma once

#include "espalier/geometry/openvdb_grid.h"

#include <cstdint>

namespace espalier::geometry {

/// The field's grid with this metadata, for an archive that writes active values only, by Blosc or as they are, as
/// `compression` says. OpenVDB copies and sorts out all 32,768
/// values of every node; where FieldGrid says that they are the background's, that is written at once. The bytes are
/// the same.
openvdb::GridBase::ConstPtr written_grid(const FieldGrid& field, const openvdb::MetaMap& metadata,
                                         std::uint32_t compression);

}  // namespace espalier::geometry
