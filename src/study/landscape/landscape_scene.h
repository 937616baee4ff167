// A landscape's file (.toml): stand, terrain, species, camera, light and levels of detail.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/base/settings.h"

#include "archive/landscape/landscape.h"
#include "picture/landscape/landscape_picture.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace espalier::study {

/// What the file says of a landscape, and the landscape that follows from it.
struct LandscapeScene {
    PlantedLandscape landscape;
    LandscapeView view;
    RayLight light;
    LandscapeLook look;
    std::size_t card_pixels;    ///< along the longer side of a card's picture
    RecordedRun first_species;  ///< says what materials emit
};

/// Replaces values before the file is read, as --set does: pairs of a dotted key and a value.
using LandscapeOverrides = std::vector<std::pair<std::string, std::string>>;

/// Throws UserError, naming file, line and column for what the file says wrongly.
LandscapeScene read_landscape(const std::filesystem::path& file, const LandscapeOverrides& overrides);

}  // namespace espalier::study
