// Areas of what a frame shows flat.
#pragma once

#include "espalier/archive/recorded_run.h"

#include "geometry/opacity.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

namespace espalier::archive {

/// The areas of a frame's polygons, m2, one side: of those that wear a picture with holes, what it leaves opaque.
class FacetAreas {
public:
    /// `run` is the folder of the run, whence textures are found; "" for one in memory.
    FacetAreas(const FrameGeometry& geometry, const std::filesystem::path& run);

    double of(std::size_t polygon) const;

private:
    const FrameGeometry& geometry_;
    std::vector<std::shared_ptr<const Opacity>> opacities_;  ///< by texture; null: opaque
};

}  // namespace espalier::archive
