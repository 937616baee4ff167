// Pictures of landscapes by rays, and of their plants for cards.
#pragma once

#include "espalier/picture/chart_page.h"

#include "archive/landscape/landscape.h"
#include "picture/landscape/placed_meshes.h"

#include <functional>

namespace espalier::picture {

/// A plant's picture over a transparent ground, and what it covers.
struct CardPicture {
    std::shared_ptr<const OpacityPicture> picture;
    CardFrame frame;
};

/// A plant in parallel projection from the direction `towards_eye`, turned about the vertical by each of the angles of
/// cards. `pixels` along the longer side.
std::vector<CardPicture> card_pictures(const LandscapeSpecies& species, const glm::dvec3& towards_eye,
                                       const RayLight& light, std::size_t pixels, const TextureOf& texture_of);

/// The plant as it stands, from one direction.
CardPicture card_picture(const LandscapeSpecies& species, const glm::dvec3& towards_eye, const RayLight& light,
                         std::size_t pixels, const TextureOf& texture_of);

struct LandscapeView {
    glm::dvec3 eye, target;
    double angle = 40;  ///< degrees, from the lower edge to the upper
};

struct LandscapeLook {
    PictureSize size{1200, 675};
    int samples = 3;           ///< along both sides of a pixel
    double visibility = 3000;  ///< metres after which haze leaves 1/e of the colour
    GroundColour ground;
    std::size_t memory = 0;  ///< bytes that meshes may take; 0: any
    TextureOf texture_of;
};

/// Cards of each species by turn; those of `landscape` that are cards look at the eye. Calls `progress` after each band
/// of the picture, which may throw. The same with any number of threads. Throws RunError beyond the memory.
OpacityPicture landscape_picture(const PlantedLandscape& landscape, const std::vector<std::vector<CardPicture>>& cards,
                                 const LandscapeView& view, const RayLight& light, const LandscapeLook& look,
                                 const std::function<void(double share)>& progress);

}  // namespace espalier::picture
