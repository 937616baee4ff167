// Where a camera must stand so that everything is in the picture, and no more.
#pragma once

#include "espalier/picture/picture_style.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <span>
#include <vector>

namespace espalier::picture {

/// The points that lie furthest in each of many directions: what frames them frames (nearly) everything.
class Outline {
public:
    void add(const glm::dvec3& point, double radius);
    void add(const Outline& other);

    bool empty() const { return furthest_.empty(); }
    std::vector<glm::dvec3> points() const;

private:
    struct Furthest {
        double distance;
        glm::dvec3 point;
    };
    std::vector<Furthest> furthest_;  ///< by direction
};

/// Parts of the picture at its edges that stay free, as shares of its width and height.
struct Margins {
    double left = 0.04, right = 0.04, bottom = 0.05, top = 0.05;
};

struct CameraView {
    glm::dvec3 focus{0}, position{0, 0, 1}, up{0, 1, 0};
    double distance = 1;
    double view_angle = 24;  ///< degrees, vertically
    bool is_parallel = false;
    double half_height = 1;  ///< half height of a parallel projection, metres
    glm::dvec2 shift{0};     ///< from the picture's middle to that of what is framed, in half widths and heights
};

/// `aspect`: width by height. `turns`: it fits whatever the azimuth.
CameraView fitted(std::span<const glm::dvec3> points, const CameraPlace& place, bool turns, bool is_parallel,
                  double aspect, const Margins& margins);

}  // namespace espalier::picture
