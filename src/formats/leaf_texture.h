// A picture of many leaves for one card, over a transparent ground: a twig, or ellipses (after the particles of Reeves
// & Blau 1985).
#pragma once

#include "base/png_file.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace espalier::formats {

struct LeafTexture {
    enum class Form : std::uint8_t { blobs, twig };
    Form form = Form::blobs;
    std::size_t blobs = 60;  ///< how many; of a twig, its leaves
    std::array<std::uint8_t, 3> rgb{74, 122, 42};
    std::size_t size = 512;  ///< pixels along a side
    double coverage = 0.25;  ///< share of the picture that the blobs would cover side by side
    double variation = 0.2;  ///< largest change of a blob's brightness, as a share
    std::uint64_t seed = 0;
};

struct LeafPicture {
    OpacityPicture picture;
    std::size_t overlapping = 0;  ///< blobs for which no free place was found
};

/// A twig stands on the middle of the lower edge and bears pointed leaves with veins, in turn on its two sides; they
/// may lie over each other. Blobs lie apart while there is room, each inside the picture. The colour of transparent
/// pixels is that of leaves, so that filtered edges do not darken. Throws UserError if blobs would be narrower than two
/// pixels.
LeafPicture leaf_picture(const LeafTexture& texture);

}  // namespace espalier::formats
