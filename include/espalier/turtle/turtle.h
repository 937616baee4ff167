// The turtle: a pose that moves and turns, with width, colour and scale.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/generalized_cylinder.h"
#include "espalier/geometry/plant_geometry.h"
#include "espalier/geometry/shapes.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace espalier::turtle {

/// A directional influence on growth: before every segment the heading turns towards `direction`
/// (at `angle` from it), by the elasticity times the sine of what separates them.
struct Tropism {
    glm::dvec3 direction{0, -1, 0};  ///< its length is the intensity
    double angle = 0;                ///< radians
    double elasticity = 0;
    double elasticity_step = 0;
    bool torque = false;  ///< rolls about the heading instead of bending it
};

/// How lines were meant to be drawn. Pixel widths are those of a screen, the others lengths.
enum class LineStyle : std::uint8_t { pixel, polygon, cylinder };

/// Where a turtle starts and what a symbol without parameter means.
struct TurtleSettings {
    Pose pose;
    double angle = 0.78539816339744831;  ///< radians (45 degrees)
    std::optional<double> line_width;    ///< none: not given; lines are thin until a symbol sets a width
    double line_width_increment = 0;
    int colour = 128;
    int colour_increment = 1;
    std::optional<int> back_colour;  ///< none: the front's
    int back_colour_increment = 1;
    double scale = 1;
    double scale_multiplier = 1;
    bool past_cut = true;  ///< draw what follows `%`
    std::vector<Tropism> tropisms;
    // cpfg's older scheme: one tropism that acts after every step, its elasticity changed by `_`.
    glm::dvec3 tropism_direction{0, 1, 0};  ///< any length but 0
    double initial_elasticity = 0;
    double elasticity_increment = 0;
    LineStyle line_style = LineStyle::cylinder;  ///< pixel lines have radius 0. A view file begins with pixel
    int contour_sides = 8;                       ///< polygons around cylinders and spheres, at least 3
    bool tapered_lines = true;                   ///< a segment's end may be thinner than its start
    bool twist_of_cylinders = false;       ///< generalized cylinders follow the turtle's roll instead of twisting least
    std::shared_ptr<const Shapes> shapes;  ///< surfaces, contours, textures; null if there are none
};

/// How generalized cylinders and spheres are drawn from here on.
struct Brush {
    int contour = 0;                     ///< number of the cross-section; 0: the circle
    std::shared_ptr<const Contour> cut;  ///< that magnets make, instead of it; null if there are none
    int sides = 8;
    double tangent_before = 1.2, tangent_after = 1.2;
    std::optional<RadiusTangents> radius;
    bool follows_roll = false;
};

/// What `[` saves and `]` restores, but for the elasticities, which the walk keeps on a stack of their own.
struct TurtleState {
    Pose pose;
    double width = 1;  ///< 1 where none is given
    double scale = 1;
    int colour = 128;
    int back_colour = -1;  ///< -1: the front's
    std::uint32_t axis = 0;
    std::uint16_t order = 0;     ///< depth of branching, at most 65535
    bool on_axis = false;        ///< the axis has an internode that ends here
    bool branches_off = false;   ///< the open cylinder is that of the axis this one branches off
    bool has_width = false;      ///< a width is given
    std::uint16_t texture = 0;   ///< 0: none
    std::uint32_t brush = 0;     ///< which of the walk's brushes
    std::uint32_t systems = 0;   ///< sub-L-systems entered
    std::int32_t cylinder = -1;  ///< which of the walk's generalized cylinders is open; -1: none
    double node_radius = 0;      ///< at the end of that internode
    double elasticity = 0;       ///< elasticity of the older tropism
};

/// The cosine and sine of an angle in radians. Quarter turns are exact, so that right angles stay right.
struct Rotation {
    double cosine = 1, sine = 0;

    Rotation() = default;
    Rotation(double angle);
    Rotation inverse() const {
        Rotation result = *this;
        result.sine = -sine;
        return result;
    }
};

Rotation rotation_of_degrees(double degrees);

/// Turns `first` towards `second`, both unit and perpendicular.
template <class Vector>
void rotate_pair(Vector& first, Vector& second, Rotation by) {
    const Vector turned = first * by.cosine + second * by.sine;
    second = second * by.cosine - first * by.sine;
    first = turned;
}

// Rotations in cpfg's senses.
inline void turn_left(Pose& pose, Rotation rotation) {  ///< + : H towards L
    rotate_pair(pose.heading, pose.left, rotation);
}
inline void pitch_down(Pose& pose, Rotation rotation) {  ///< & : H towards U
    rotate_pair(pose.heading, pose.up, rotation);
}
inline void roll_left(Pose& pose, Rotation rotation) {  ///< / : L towards U
    rotate_pair(pose.left, pose.up, rotation);
}
void level(Pose& pose);  ///< @v: left horizontal
/// Turns the heading to `heading` with the least twist; a zero vector means straight up.
void head_towards(Pose& pose, const glm::dvec3& heading);
/// Bends and rolls as before every segment; one elasticity per tropism.
void apply_tropisms(Pose& pose, std::span<const Tropism> tropisms, std::span<const double> elasticities);
/// The first half of it: false if the heading stays.
bool bend_by_tropisms(Pose& pose, std::span<const Tropism> tropisms, std::span<const double> elasticities);
/// The second.
void roll_by_torques(Pose& pose, std::span<const Tropism> tropisms, std::span<const double> elasticities);
/// Bends after a step, by the older scheme; `direction` is a unit vector.
void apply_older_tropism(Pose& pose, const glm::dvec3& direction, double elasticity);

}  // namespace espalier::turtle
