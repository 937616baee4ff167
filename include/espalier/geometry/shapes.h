// What a model's view file gives a turtle to draw with: surfaces, contours, textures.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/contour.h"
#include "espalier/geometry/surface.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace espalier::geometry {

/// A picture to be laid over surfaces and cylinders; Espalier passes it on and does not draw it.
struct Texture {
    std::filesystem::path file;
    bool per_surface = false;  ///< one picture over a whole surface instead of one a patch
    double ratio = 1;          ///< stretches it along cylinders
    std::string magnification = "n", minification = "n", mode = "m";
};

struct Shapes {
    std::map<std::uint32_t, Surface> surfaces;  ///< by the code point after ~
    std::map<int, Contour> contours;            ///< by number; 0, the circle, need not be among them
    std::vector<Texture> textures;              ///< texture 1 is textures[0]
};

}  // namespace espalier::geometry
