// Pictures that plants wear, as files that browsers show.
#pragma once

#include "espalier/simulation/scene.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace espalier::studio {

struct WornPicture {
    std::filesystem::path file;     ///< as the view file names it: a picture, or settings of bark
    std::filesystem::path colours;  ///< PNG or JPEG; empty if there is no such picture
    std::filesystem::path normals;  ///< of tangent space, PNG; empty where it is flat
};

/// Reads the settings of bark that plants of a scene wear, so that they count among what was read. Throws UserError for
/// a picture that this thread has no permission to read.
void note_worn_files(const Scene& scene);

class WornPictures {
public:
    /// Writes what browsers do not show into `folder`, as PNG.
    explicit WornPictures(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// From 1 on, the same for the same file. Throws UserError for wrong settings of bark.
    std::uint32_t number(const std::filesystem::path& file);
    const std::vector<WornPicture>& all() const { return pictures_; }

private:
    WornPicture worn(const std::filesystem::path& file) const;

    std::filesystem::path folder_;
    std::vector<WornPicture> pictures_;
};

}  // namespace espalier::studio
