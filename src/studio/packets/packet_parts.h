// The parts of a step's packet, docs/developer/studio-protocol.md, "Binary messages".
#pragma once

#include "espalier/geometry/plant_geometry.h"
#include "espalier/geometry/surface.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace espalier::studio {

using Rgba = std::array<std::uint8_t, 4>;
using Normal = std::array<std::int8_t, 4>;
using Point = std::array<float, 3>;
using OnPicture = std::array<float, 2>;

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();  ///< of an organ that lacks what a column shows

Point point_of(const glm::dvec3& v);

/// The box and the largest radius of all internodes, which their bytes are parts of.
struct Extent {
    Box box;
    double radius = 0;

    void add(const glm::dvec3& base, const glm::dvec3& tip, double base_radius, double tip_radius) {
        box.lower = glm::min(box.lower, glm::min(base, tip));
        box.upper = glm::max(box.upper, glm::max(base, tip));
        radius = std::max({radius, base_radius, tip_radius});
    }
    std::array<std::uint16_t, 3> parts(const glm::dvec3& point) const {
        const auto part_along = [&](int k) {
            const double size = box.upper[k] - box.lower[k];
            return part(size > 0 ? (point[k] - box.lower[k]) / size : 0);
        };
        return {part_along(0), part_along(1), part_along(2)};
    }
    std::uint16_t part_of_radius(double value) const { return part(radius > 0 ? value / radius : 0); }

private:
    static std::uint16_t part(double share) {
        return static_cast<std::uint16_t>(65535 * std::clamp(share, 0.0, 1.0) + 0.5);
    }
};

struct InternodeBytes {
    std::array<std::uint16_t, 3> base, tip;
    std::uint16_t base_radius, tip_radius;
    std::array<std::uint8_t, 3> rgb;
    std::uint8_t order;
    std::uint32_t module;
};
static_assert(sizeof(InternodeBytes) == 24);

struct Triangles {
    std::vector<Point> points;
    std::vector<Normal> normals;
    std::vector<Rgba> colours;
    std::vector<OnPicture> uvs;
    std::vector<std::uint32_t> modules, indices;
    std::vector<std::uint32_t> textures;  ///< textures of the triangles; shorter where the last ones have none

    std::uint32_t add(const SurfaceVertex& vertex, Rgba colour, std::uint32_t module);
    /// What was added since wears this texture.
    void set_texture(std::uint32_t texture) { textures.resize(indices.size() / 3, texture); }
    /// Puts triangles that wear the same texture behind each other.
    void sort();
};

struct ShownLabel {
    Point position;
    Rgba colour;
    std::uint32_t module;
    const std::string* text;
};

/// Organs of one shape.
struct Group {
    std::vector<std::array<float, 12>> places;
    std::vector<Rgba> colours;
    std::vector<std::uint32_t> modules;
};

/// The message `ESC1`: a number for each module, NaN where it has none.
std::string column_message(std::uint32_t growth, int step, const std::string& name, std::span<const float> values);
/// What such a message says of a module; NaN where it ends before.
float number_in(const std::string& column_message, std::size_t module);

struct PacketParts {
    Extent extent;
    std::vector<std::uint32_t> first_modules;  ///< first module of each plant
    std::vector<InternodeBytes> internodes;
    std::vector<std::uint16_t> limb_textures;  ///< textures of the internodes; shorter where the last ones have none
    Triangles triangles;                       ///< sorted
    std::map<std::uint32_t, Group> groups;     ///< by shape
    std::vector<ShownLabel> labels;

    std::string bytes(std::uint32_t growth, int step) const;
    /// The bytes of the same parts, shown at another step.
    static std::string of_step(int step, std::string bytes);
};

}  // namespace espalier::studio
