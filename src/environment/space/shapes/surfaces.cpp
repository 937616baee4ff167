// Shapes bounded by triangles: mesh files and height fields.
#include "espalier/base/map_origin.h"

#include "environment/exchange/covering.h"
#include "environment/space/shapes/kinds.h"
#include "environment/space/shapes/level_set.h"
#include "environment/space/shapes/mesh_file.h"
#include "environment/space/shapes/triangles.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// Near the surface the level set answers; farther away it knows the sign and the triangles the distance.
class MeshShape final : public Shape {
public:
    MeshShape(TriangleMesh mesh, LevelSet level_set)
        : tree_(std::move(mesh)), level_set_(std::move(level_set)), bounds_(tree_.mesh().bounds()) {}

    double distance(const glm::dvec3& point) const override {
        const LevelSet::Reading reading = level_set_.read(point);
        if (reading.near) return reading.distance;
        const double away = glm::length(point - tree_.nearest(point).point);
        return reading.distance < 0 ? -away : away;
    }

    bool inside(const glm::dvec3& point) const override { return level_set_.read(point).distance <= 0; }

    Sample sample(const glm::dvec3& point) const override {
        const LevelSet::Reading reading = level_set_.read(point);
        const double slope = glm::length(reading.gradient);
        if (reading.near && slope > 0.1) {  // less where a thin wall's two sides meet
            const glm::dvec3 normal = reading.gradient / slope;
            return {reading.distance, normal, point - reading.distance * normal};
        }
        const auto [nearest, triangle] = tree_.nearest(point);
        Sample sample = sample_of(point, nearest, reading.distance <= 0, tree_.mesh().normal(triangle));
        if (reading.near) sample.distance = reading.distance;
        return sample;
    }

    std::optional<Box> bounds() const override { return bounds_; }

private:
    TriangleTree tree_;
    LevelSet level_set_;
    Box bounds_;
};

/// Heights over a rectangle of samples; between them two triangles per cell.
struct Heights {
    std::vector<double> values;  ///< row after row along z
    std::size_t columns = 0, rows = 0;
    glm::dvec3 corner;  ///< below the first value; heights count from its y
    double dx = 1, dz = 1;
    double floor = 0;  ///< absolute

    double value(std::size_t column, std::size_t row) const { return corner.y + values[row * columns + column]; }
    glm::dvec3 top(std::size_t column, std::size_t row) const {
        return {corner.x + static_cast<double>(column) * dx, value(column, row),
                corner.z + static_cast<double>(row) * dz};
    }
};

/// The closed surface of the block between the floor and the heights.
TriangleMesh block(const Heights& heights) {
    TriangleMesh mesh;
    const std::size_t columns = heights.columns, rows = heights.rows;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) mesh.points.push_back(heights.top(column, row));
    }
    const auto index = [&](std::size_t column, std::size_t row) {
        return static_cast<std::uint32_t>(row * columns + column);
    };
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = index(column, row), b = index(column + 1, row);
            const std::uint32_t c = index(column, row + 1), d = index(column + 1, row + 1);
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, d});
        }
    }
    std::vector<std::uint32_t> rim;  // once around, so that the walls face outward
    for (std::size_t row = 0; row + 1 < rows; ++row) rim.push_back(index(0, row));
    for (std::size_t column = 0; column + 1 < columns; ++column) rim.push_back(index(column, rows - 1));
    for (std::size_t row = rows - 1; row > 0; --row) rim.push_back(index(columns - 1, row));
    for (std::size_t column = columns - 1; column > 0; --column) rim.push_back(index(column, 0));
    const auto below = static_cast<std::uint32_t>(mesh.points.size());
    const auto count = static_cast<std::uint32_t>(rim.size());
    for (std::uint32_t top : rim) {
        mesh.points.push_back({mesh.points[top].x, heights.floor, mesh.points[top].z});
    }
    const glm::dvec3 middle = 0.5 * (heights.top(0, 0) + heights.top(columns - 1, rows - 1));
    mesh.points.push_back({middle.x, heights.floor, middle.z});
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.triangles.push_back({rim[i], below + i, below + next});
        mesh.triangles.push_back({rim[i], below + next, rim[next]});
        mesh.triangles.push_back({below + next, below + i, below + count});
    }
    return mesh;
}

class HeightField final : public Shape {
public:
    explicit HeightField(Heights heights)
        : heights_(std::move(heights)), tree_(block(heights_)), bounds_(tree_.mesh().bounds()) {}

    double distance(const glm::dvec3& point) const override {
        const double away = glm::length(point - tree_.nearest(point).point);
        return inside(point) ? -away : away;
    }

    bool inside(const glm::dvec3& point) const override {
        const double x = (point.x - heights_.corner.x) / heights_.dx, z = (point.z - heights_.corner.z) / heights_.dz;
        const auto last_column = static_cast<double>(heights_.columns - 1);
        const auto last_row = static_cast<double>(heights_.rows - 1);
        if (!(x >= 0 && x <= last_column && z >= 0 && z <= last_row) || point.y < heights_.floor) return false;
        const double column = std::min(std::floor(x), last_column - 1), row = std::min(std::floor(z), last_row - 1);
        return point.y <= height(static_cast<std::size_t>(column), static_cast<std::size_t>(row), x - column, z - row);
    }

    Sample sample(const glm::dvec3& point) const override {
        const auto [nearest, triangle] = tree_.nearest(point);
        return sample_of(point, nearest, inside(point), tree_.mesh().normal(triangle));
    }

    std::optional<Box> bounds() const override { return bounds_; }

private:
    /// On the two triangles of a cell, cut from (1, 0) to (0, 1).
    double height(std::size_t column, std::size_t row, double u, double v) const {
        const double a = heights_.value(column, row), b = heights_.value(column + 1, row);
        const double c = heights_.value(column, row + 1), d = heights_.value(column + 1, row + 1);
        if (u + v <= 1) return a + u * (b - a) + v * (c - a);
        return d + (1 - u) * (c - d) + (1 - v) * (b - d);
    }

    Heights heights_;
    TriangleTree tree_;
    Box bounds_;
};

Heights read_heights(Settings& table) {
    Heights heights;
    if (table.has("file")) {
        const HeightImage image = read_height_image(table.path("file"), table.place("file"));
        const double lowest = table.number("lowest"), highest = table.number("highest");
        heights.columns = image.columns;
        for (double brightness : image.brightness) heights.values.push_back(glm::mix(lowest, highest, brightness));
    } else {
        heights.values = table.numbers("heights");
        heights.columns = static_cast<std::size_t>(table.integer("columns", Range::between(2, 1 << 20)));
    }
    heights.rows = heights.values.size() / heights.columns;
    if (heights.rows < 2 || heights.columns < 2 || heights.rows * heights.columns != heights.values.size()) {
        throw UserError(
            table.place(table.has("file") ? "file" : "heights"),
            fmt::format("{} heights do not make 2 or more full rows of {}", heights.values.size(), heights.columns));
    }
    return heights;
}

}  // namespace

ShapePointer read_mesh(Settings& table) {
    const std::filesystem::path file = table.path("file");
    const Place place = table.place("file");
    TriangleMesh mesh = read_mesh_file(file, scale_of(table), place);
    if (MapOrigin* const origin = MapOrigin::current()) {
        const Box map = mesh.bounds();
        const glm::dvec3 subtracted = origin->of(map.lower, map.upper, {file.string(), 1, 1});
        for (glm::dvec3& point : mesh.points) point = MapOrigin::shifted(point, subtracted);
    }
    const glm::dvec3 extent = mesh.bounds().upper - mesh.bounds().lower;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double voxel = read_voxel(table, longest / 128);
    LevelSet level_set(mesh, voxel, file.string(), table.has("voxel") ? table.place("voxel") : place);
    return std::make_shared<MeshShape>(std::move(mesh), std::move(level_set));
}

ShapePointer read_height_field(Settings& table) {
    Heights heights = read_heights(table);
    const std::vector<double> size = table.numbers("size");
    if (size.size() != 2 || !(size[0] > 0) || !(size[1] > 0)) {
        throw UserError(table.place("size"), "'size' must be [x, z], both greater than 0");
    }
    heights.corner = table.vector_or("corner", {0, 0, 0});
    heights.dx = size[0] / static_cast<double>(heights.columns - 1);
    heights.dz = size[1] / static_cast<double>(heights.rows - 1);
    const double lowest = *std::min_element(heights.values.begin(), heights.values.end());
    heights.floor = heights.corner.y + table.number_or("floor", lowest - std::min(size[0], size[1]));
    if (!(heights.floor < heights.corner.y + lowest)) {
        throw UserError(table.place("floor"), fmt::format("'floor' must lie below the lowest height, {}", lowest));
    }
    return std::make_shared<HeightField>(std::move(heights));
}

}  // namespace espalier::environment
