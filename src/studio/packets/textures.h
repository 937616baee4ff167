// Pictures that plants wear, as files that browsers show.
#pragma once

#include "espalier/simulation/scene.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace espalier::studio {

struct BrowserTexture {
    std::filesystem::path file;     ///< as the view file names it: a picture, or settings of bark
    std::filesystem::path colours;  ///< PNG or JPEG; empty if there is no such picture
    std::filesystem::path normals;  ///< in tangent space, PNG; empty where it is flat
};

/// Reads the settings of bark that plants of a scene wear, so that they count among what was read. Throws UserError for
/// a picture that this thread has no permission to read.
void note_texture_files(const Scene& scene);

class BrowserTextures {
public:
    /// Writes what browsers do not show into `folder`, as PNG.
    explicit BrowserTextures(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// From 1 on, the same for the same file. Throws UserError for wrong settings of bark.
    std::uint32_t number(const std::filesystem::path& file);
    const std::vector<BrowserTexture>& all() const { return pictures_; }

private:
    BrowserTexture texture_of(const std::filesystem::path& file) const;

    std::filesystem::path folder_;
    std::vector<BrowserTexture> pictures_;
};

}  // namespace espalier::studio
