#include "espalier/picture/author_view.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

double azimuth_of(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, direction.z));
}

double elevation_of(const glm::dvec3& direction) {
    return glm::degrees(std::asin(std::clamp(glm::normalize(direction).y, -1.0, 1.0)));
}

}  // namespace

CameraPlace camera_of(const RecordedView& view) {
    CameraPlace place;
    place.azimuth = azimuth_of(view.towards_eye);
    place.elevation = elevation_of(view.towards_eye);
    place.twist = view.twist;
    place.is_parallel = !view.perspective;
    if (view.perspective) place.view_angle = std::clamp(view.angle, 1.0, 120.0);
    place.front_if_flat = false;
    return place;
}

void light_as(const RecordedView& view, PictureStyle& style) {
    constexpr double least = 5;  // shadows of a lower sun would be endless
    if (!view.towards_light) return;
    style.sun_azimuth = azimuth_of(*view.towards_light);
    style.sun_elevation = std::max(elevation_of(*view.towards_light), least);
}

}  // namespace espalier::picture
