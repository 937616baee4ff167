// Whether the tree of a grid in an OpenVDB file is whole. OpenVDB makes the nodes and reads the blocks that a file
// claims, however many those are, before it notices that they are not there.
#pragma once

#include "geometry/grids/vdb_bytes.h"

#include <cstdint>
#include <string_view>

namespace espalier::geometry {

/// How a tree is stored: nodes of 32^3, 16^3 and 8^3 values.
struct VdbTree {
    std::string_view grid_type;     ///< as the file calls it
    std::uint64_t value = 0;        ///< bytes of a value
    std::uint64_t half = 0;         ///< the same in grids that are stored as 16-bit numbers
    std::uint64_t components = 1;   ///< numbers in a value
    bool is_half = false;           ///< stored so
    std::uint32_t compression = 0;  ///< openvdb::io::COMPRESS_...
    std::uint64_t memory = 0;       ///< most bytes that its nodes may take
};

/// Goes over topology and values, from the position of `file` to their end. Throws VdbError, also for more than the
/// memory.
void require_whole(VdbBytes& file, const VdbTree& tree);

}  // namespace espalier::geometry
