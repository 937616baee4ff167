#include "environment/light/optics/soil_map.h"

#include <cmath>

namespace espalier::environment {

SoilMap::SoilMap(const Settings& table) {
    if (table.keys().empty()) return;
    picture_ = read_picture(table.path("picture"));
    const std::vector<double> corner = table.numbers_or("corner", {0, 0}), size = table.numbers_or("size", {1, 1});
    if (corner.size() != 2) throw UserError(table.place("corner"), "'corner' must be [x, z]");
    if (size.size() != 2 || !(size[0] > 0 && size[1] > 0)) {
        throw UserError(table.place("size"), "'size' must be [x, z], both above 0");
    }
    x_ = corner[0];
    z_ = corner[1];
    width_ = size[0];
    depth_ = size[1];
}

double SoilMap::brightness(const glm::dvec3& place) const {
    if (picture_.empty()) return 0;
    const double u = (place.x - x_) / width_, v = (place.z - z_) / depth_;
    const Picture::Colour& pixel = picture_.at(u - std::floor(u), v - std::floor(v));
    return (0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2]) / 255;
}

}  // namespace espalier::environment
