#include "timeline/organ_mesh.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace espalier {
namespace {

constexpr std::uint32_t sides = 16;
constexpr std::uint32_t meridians = 8;
constexpr std::uint32_t bands = 6;

std::vector<glm::dvec3> ring(const Pose& pose, double radius) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        points.push_back(pose.position + radius * (std::cos(angle) * pose.heading + std::sin(angle) * pose.left));
    }
    return points;
}

std::vector<std::uint32_t> counted(std::uint32_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

OrganMesh disc(const Organ& organ) {
    return {ring(organ.pose, organ.size.x / 2), {counted(sides)}, {}};
}

OrganMesh circle(const Organ& organ) {
    std::vector<std::uint32_t> closed = counted(sides);
    closed.push_back(0);
    return {ring(organ.pose, organ.size.x / 2), {}, {closed}};
}

// A quadrilateral; across its first or last edge a triangle where that edge is a pole.
void add_band(OrganMesh& mesh, std::uint32_t band) {
    const auto index = [](std::uint32_t ring_number, std::uint32_t meridian) {
        if (ring_number == 0) return 0u;
        if (ring_number == bands) return (bands - 1) * meridians + 1;
        return 1 + (ring_number - 1) * meridians + meridian % meridians;
    };
    for (std::uint32_t i = 0; i < meridians; ++i) {
        std::vector<std::uint32_t> face{index(band, i), index(band + 1, i)};
        if (band + 1 < bands) face.push_back(index(band + 1, i + 1));
        if (band > 0) face.push_back(index(band, i + 1));
        mesh.faces.push_back(std::move(face));
    }
}

OrganMesh sphere(const Organ& organ) {
    const double radius = organ.size.x / 2;
    const Pose& pose = organ.pose;
    OrganMesh mesh;
    mesh.points.push_back(pose.position + radius * pose.heading);
    for (std::uint32_t band = 1; band < bands; ++band) {
        const double polar = std::numbers::pi * band / bands;
        for (std::uint32_t i = 0; i < meridians; ++i) {
            const double around = 2 * std::numbers::pi * i / meridians;
            mesh.points.push_back(pose.position + radius * (std::cos(polar) * pose.heading +
                                                            std::sin(polar) * (std::cos(around) * pose.left +
                                                                               std::sin(around) * pose.up)));
        }
    }
    mesh.points.push_back(pose.position - radius * pose.heading);
    for (std::uint32_t band = 0; band < bands; ++band) add_band(mesh, band);
    return mesh;
}

OrganMesh rhombus(const Organ& organ) {
    const Pose& pose = organ.pose;
    const glm::dvec3 middle = pose.position + 0.5 * organ.size.y * pose.heading;
    const glm::dvec3 half_width = 0.25 * organ.size.x * pose.left;
    return {{pose.position, middle - half_width, pose.position + organ.size.y * pose.heading, middle + half_width},
            {counted(4)},
            {}};
}

}  // namespace

OrganMesh mesh_of(const Organ& organ) {
    switch (organ.shape) {
        case Organ::Shape::disc:
            return disc(organ);
        case Organ::Shape::circle:
            return circle(organ);
        case Organ::Shape::sphere:
            return sphere(organ);
        case Organ::Shape::surface:
            return rhombus(organ);
    }
    return {};
}

}  // namespace espalier
