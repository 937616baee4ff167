// Background scenes: what stands around a plant in pictures, in a text form of OpenGL's commands.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"
#include "espalier/geometry/palette.h"
#include "espalier/geometry/surface.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::turtle {

/// Triangles in the world's coordinates; pieces of one material follow each other.
struct Background {
    struct Piece {
        Material material;
        std::uint32_t first, count;  ///< indices from triangles[first], three a triangle

        bool transparent() const { return material.ambient.a < 1 || material.diffuse.a < 1; }
    };
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> triangles;
    std::vector<Piece> pieces;
};

/// Adds a file's scene to `background`; `material` is that of what stands before the first `material`. Commands that
/// are not understood are left out and explained among `diagnostics`. Throws UserError if the file cannot be read.
void read_background(const std::filesystem::path& path, const Material& material, Background& background,
                     std::vector<Diagnostic>& diagnostics);
void read_background_text(std::string_view text, const std::string& name, const Material& material,
                          Background& background, std::vector<Diagnostic>& diagnostics);

}  // namespace espalier::turtle
