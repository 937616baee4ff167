// A landscape as a glTF file: each species and level one mesh in many places (EXT_mesh_gpu_instancing).
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/landscape/landscape.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::formats {

/// A card of a species, as the bytes of a PNG file.
struct CardImage {
    std::string png;
    CardFrame frame;
};

struct LandscapeFile {
    const PlantedLandscape& landscape;
    const std::vector<std::vector<CardImage>>& cards;  ///< of each species by turn
    glm::dvec3 eye;                                    ///< to which cards turn
    Rgb ground;
    const RecordedRun& run;  ///< says what materials emit
};

/// A node of the terrain, and one for each species, level and turn of cards that is there. Counts the triangles of the
/// file, and as elements the plants. Throws RunError if it cannot be written.
ExportedFile write_landscape(const LandscapeFile& file, const std::filesystem::path& path);

}  // namespace espalier::formats

namespace espalier {

using formats::CardImage;
using formats::LandscapeFile;
using formats::write_landscape;

}  // namespace espalier
