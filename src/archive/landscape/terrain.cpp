#include "archive/landscape/terrain.h"

#include "espalier/base/error.h"

#include "base/picture_file.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::archive {
namespace {

constexpr int shades = 24;

/// A place among `count` values side by side: the value before it, and how far it lies towards the next.
struct Between {
    Between(double place, std::size_t count) {
        const double inside = std::clamp(place, 0.0, static_cast<double>(count - 1));
        first = std::min(static_cast<std::size_t>(inside), count < 2 ? 0 : count - 2);
        share = inside - static_cast<double>(first);
        second = std::min(first + 1, count - 1);
    }

    std::size_t first, second;
    double share;
};

template <class Value>
double straight_between(const Between& across, const Between& along, const Value& value) {
    const double here = std::lerp(value(across.first, along.first), value(across.second, along.first), across.share);
    const double next = std::lerp(value(across.first, along.second), value(across.second, along.second), across.share);
    return std::lerp(here, next, along.share);
}

}  // namespace

Terrain::Terrain(const glm::dvec2& lower, const glm::dvec2& upper, const Grid& grid,
                 const std::function<double(double x, double z)>& height)
    : lower_(lower), upper_(upper), grid_(grid) {
    if (grid.columns < 2 || grid.rows < 2 || grid.columns > most_places / grid.rows) {
        throw UserError(
            fmt::format("a terrain has 2 x 2 to {} places, not {} x {}", most_places, grid.columns, grid.rows));
    }
    heights_.resize(grid.columns * grid.rows);
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const glm::dvec2 here = place(column, row);
            at(column, row) = height(here.x, here.y);
            if (std::isfinite(at(column, row))) continue;
            throw UserError(fmt::format("the terrain has no height at x = {:.6g}, z = {:.6g}", here.x, here.y));
        }
    }
}

glm::dvec2 Terrain::place(std::size_t column, std::size_t row) const {
    const glm::dvec2 share(double(column) / double(grid_.columns - 1), double(row) / double(grid_.rows - 1));
    return lower_ + share * (upper_ - lower_);
}

bool Terrain::holds(double x, double z) const {
    return x >= lower_.x && x <= upper_.x && z >= lower_.y && z <= upper_.y;
}

double Terrain::height(double x, double z) const {
    const glm::dvec2 share = (glm::dvec2(x, z) - lower_) / (upper_ - lower_);
    return straight_between(Between(share.x * double(grid_.columns - 1), grid_.columns),
                            Between(share.y * double(grid_.rows - 1), grid_.rows),
                            [&](std::size_t column, std::size_t row) { return at(column, row); });
}

FrameMesh Terrain::mesh(const GroundColour& ground) const {
    FrameMesh mesh;
    const glm::dvec2 step = (upper_ - lower_) / glm::dvec2(double(grid_.columns - 1), double(grid_.rows - 1));
    for (std::size_t row = 0; row < grid_.rows; ++row) {
        for (std::size_t column = 0; column < grid_.columns; ++column) {
            const glm::dvec2 here = place(column, row);
            const double along_x = height(here.x + step.x, here.y) - height(here.x - step.x, here.y);
            const double along_z = height(here.x, here.y + step.y) - height(here.x, here.y - step.y);
            mesh.points.emplace_back(here.x, at(column, row), here.y);
            mesh.normals.emplace_back(glm::normalize(glm::dvec3(-along_x / (2 * step.x), 1, -along_z / (2 * step.y))));
            mesh.uvs.emplace_back((here - lower_) / (upper_ - lower_));
        }
    }
    const auto columns = static_cast<std::uint32_t>(grid_.columns);
    for (std::uint32_t row = 0; row + 1 < grid_.rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = row * columns + column, b = a + 1, c = a + columns, d = c + 1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, d});
        }
    }
    add_shades(mesh, ground);
    return mesh;
}

void Terrain::add_shades(FrameMesh& mesh, const GroundColour& ground) const {
    const int steps = ground.share ? shades - 1 : 0;
    for (int shade = 0; shade <= steps; ++shade) {
        Rgb rgb = ground.colour;
        for (std::size_t k = 0; k < 3 && steps > 0; ++k) {
            const double mixed = std::lerp(double(ground.colour[k]), double(ground.second[k]), double(shade) / steps);
            rgb[k] = static_cast<std::uint8_t>(std::lround(mixed));
        }
        mesh.materials.push_back({rgb, ""});
    }
    const auto shade_at = [&](double x, double z) {
        const double share = ground.share ? ground.share(x, z) : 0;
        if (!std::isfinite(share)) {
            throw UserError(fmt::format("the ground has no colour at x = {:.6g}, z = {:.6g}", x, z));
        }
        return static_cast<std::uint32_t>(std::lround(steps * std::clamp(share, 0.0, 1.0)));
    };
    for (const glm::vec3& point : mesh.points) mesh.rgb.push_back(mesh.materials[shade_at(point.x, point.z)].rgb);
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::vec3 middle = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0F;
        mesh.material_of.push_back(shade_at(middle.x, middle.z));
    }
}

std::function<double(double x, double z)> heights_of_picture(const std::filesystem::path& file, const glm::dvec2& lower,
                                                             const glm::dvec2& upper, double low, double high) {
    auto picture = std::make_shared<const Picture>(read_picture(file));
    if (picture->empty()) throw UserError(fmt::format("{}: the picture has no pixels", file.string()));
    return [=](double x, double z) {
        const double u = (x - lower.x) / (upper.x - lower.x), v = (upper.y - z) / (upper.y - lower.y);
        const auto brightness = [&](std::size_t column, std::size_t row) {
            const auto [red, green, blue] = picture->pixels[row * picture->width + column];
            return (double(red) + green + blue) / (3 * 255);
        };
        const double share = straight_between(Between(u * double(picture->width) - 0.5, picture->width),
                                              Between(v * double(picture->height) - 0.5, picture->height), brightness);
        return std::lerp(low, high, share);
    };
}

}  // namespace espalier::archive
