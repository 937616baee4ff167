// A landscape as a file of another program: each species and level once, in many places.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/landscape/landscape.h"

#include <glm/vec3.hpp>

#include <compare>
#include <filesystem>
#include <map>
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
    const std::vector<std::vector<CardImage>>& cards;  ///< cards of each species by turn
    glm::dvec3 eye;                                    ///< to which cards turn
    GroundColour ground;
    const RecordedRun& run;  ///< says what materials emit
};

/// A shape that stands in many places: a level of a species, or a card that shows a side of it.
struct LandscapeShape {
    std::uint16_t species, level, turn;  ///< level: PlantedPlant::card_level for a card, which has a turn

    bool is_card() const { return level == PlantedPlant::card_level; }
    auto operator<=>(const LandscapeShape&) const = default;
};

struct ShapePlaces {
    std::vector<glm::vec3> translations;
    std::vector<glm::quat> rotations;
    std::vector<float> scales;
};

/// "oak_level_2", "oak_card_0"
std::string name_of(const LandscapeFile& file, const LandscapeShape& shape);
/// Returns the texture that a card wears.
std::string texture_name_of(const LandscapeFile& file, const LandscapeShape& card);
FrameMesh mesh_of(const LandscapeFile& file, const LandscapeShape& shape);
std::map<LandscapeShape, ShapePlaces> places_by_shape(const LandscapeFile& file);

/// Whether files of this name can be written: .glb, .usda.
bool is_landscape_file(const std::filesystem::path& path);
/// Counts the triangles of the file, and as elements the plants. Throws RunError if it cannot be written.
ExportedFile write_landscape(const LandscapeFile& file, const std::filesystem::path& path);

/// glTF: a node of the terrain, and one for each shape (EXT_mesh_gpu_instancing).
ExportedFile write_landscape_glb(const LandscapeFile& file, const std::filesystem::path& path);
/// USD: a mesh of the terrain, and a point instancer of all plants. The pictures of cards lie beside the file.
ExportedFile write_landscape_usd(const LandscapeFile& file, const std::filesystem::path& path);

}  // namespace espalier::formats
