// Meshes and images of heights from files, with every fault as a UserError naming the file.
#pragma once

#include "espalier/base/error.h"

#include "environment/space/shapes/triangles.h"

#include <filesystem>

namespace espalier::environment {

/// A closed triangle mesh of OBJ, STL or PLY, so many times as large as in the file, with its triangles facing outward.
/// `place` is where the file was asked for.
/// Throws UserError: missing, not a mesh, empty, points that are NaN, open edges, no volume.
TriangleMesh read_mesh_file(const std::filesystem::path& file, double scale, const Place& place);

struct HeightImage {
    std::size_t columns = 0;
    std::vector<double> brightness;  ///< 0 black to 1 white, row after row from the top of the picture
};

/// A PNG of 8 or 16 bits a channel, or an SGI (.rgb) or Targa (.tga) picture. Throws UserError if the file is none.
HeightImage read_height_image(const std::filesystem::path& file, const Place& place);

}  // namespace espalier::environment
