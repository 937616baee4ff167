// A picture of the soil's brightness.
#pragma once

#include "espalier/base/settings.h"

#include "base/picture_file.h"

#include <glm/vec3.hpp>

namespace espalier::environment {

/// Of the table `soil_map`: a picture that is repeated over the ground; without one, the soil is dark everywhere.
class SoilMap {
public:
    SoilMap() = default;
    /// Throws UserError for a picture that cannot be read.
    explicit SoilMap(const Settings& table);

    bool empty() const { return picture_.empty(); }
    /// 0 (black) to 1 (white); 0 without a picture.
    double brightness(const glm::dvec3& place) const;

private:
    Picture picture_;
    double x_ = 0, z_ = 0, width_ = 1, depth_ = 1;  ///< lower corner and size on the ground, m
};

}  // namespace espalier::environment
