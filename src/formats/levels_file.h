// A plant in several levels of detail, as one glTF file.
#pragma once

#include "espalier/formats/exporter.h"

#include "archive/landscape/landscape.h"

#include <glm/gtc/quaternion.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace espalier::formats {

/// A picture of the plant from one direction, to which its card turns.
struct LevelCard {
    std::string png;
    CardFrame frame;
    glm::quat turn;
};

struct LevelsFile {
    const RecordedRun& run;         ///< says what materials emit
    std::string name;               ///< of the plant
    std::vector<FrameMesh> meshes;  ///< the finest first
    std::vector<LevelCard> cards;   ///< the last level: cards that cross

    /// Of each level.
    std::vector<std::size_t> triangles() const;
};

/// Meshes and, last, the cards: a node each, of which the first has the others as its coarser levels (MSFT_lod). Counts
/// the vertices and triangles of all, and as elements the levels. Throws RunError if it cannot be written.
ExportedFile write_levels(const LevelsFile& file, const std::filesystem::path& path);

}  // namespace espalier::formats
