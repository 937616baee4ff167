#include "espalier/environment/shape.h"

#include "base/text.h"
#include "environment/space/shapes/kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

struct Kind {
    const char* name;
    ShapePointer (*read)(Settings&);
    bool scales_itself = false;  ///< what is read has its `scale` already
};

constexpr Kind kinds[] = {
    {"box", read_box},
    {"sphere", read_sphere},
    {"ellipsoid", read_ellipsoid},
    {"cylinder", read_cylinder},
    {"cone", read_cone},
    {"tube", read_tube},
    {"half-space", read_half_space},
    {"height-field", read_height_field},
    {"mesh", read_mesh, /*scales_itself=*/true},
    {"union", read_union},
    {"intersection", read_intersection},
    {"difference", read_difference},
};

const Kind& kind_of(const Settings& table) {
    const std::string name = table.text("shape");
    std::vector<std::string> names;
    for (const Kind& kind : kinds) {
        if (name == kind.name) return kind;
        names.push_back(kind.name);
    }
    throw UserError(table.place("shape"), fmt::format("'{}' is no kind of shape{}; there are {}", name,
                                                      did_you_mean(name, names), fmt::join(names, ", ")));
}

}  // namespace

std::shared_ptr<const Shape> read_shape(Settings& table) {
    const Kind& kind = kind_of(table);
    return place(kind.read(table), table, kind.scales_itself);
}

Shape::Sample sample_of(const glm::dvec3& point, const glm::dvec3& nearest, bool inside,
                        const glm::dvec3& surface_normal) {
    const glm::dvec3 away = point - nearest;
    const double distance = glm::length(away);
    const double sign = inside ? -1 : 1;
    // Closer than rounding, the direction between the two points is noise.
    const bool coincide = distance <= 1e-14 * (1 + glm::length(point));
    return {sign * distance, coincide ? surface_normal : away * (sign / distance), nearest};
}

glm::dvec3 perpendicular(const glm::dvec3& unit) {
    const glm::dvec3 other = std::abs(unit.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
    return glm::normalize(glm::cross(unit, other));
}

void require_apart(const Settings& table, const char* key, const glm::dvec3& first, const glm::dvec3& second) {
    if (!(glm::length(second - first) > 0)) {
        throw UserError(table.place(key), fmt::format("'{}' must differ from the other end", key));
    }
}

}  // namespace espalier::environment
