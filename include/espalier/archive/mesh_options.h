// How a recorded frame becomes triangles.
#pragma once

#include <cstdint>
#include <optional>

namespace espalier::archive {

struct MeshOptions {
    int sides = 8;        ///< of tubes; 3 at least
    double simplify = 0;  ///< metres that a tube's middle line and radius may stray; 0: every node stays
    std::optional<std::size_t> triangles =
        std::nullopt;                                   ///< of tubes and surfaces together; fewer are left as they are
    char up = 'y';                                      ///< or 'z'
    std::optional<std::uint32_t> plant = std::nullopt;  ///< its number; none: all plants
};

}  // namespace espalier::archive

namespace espalier {

using archive::MeshOptions;

}  // namespace espalier
