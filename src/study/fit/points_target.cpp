// A cloud of points that a scanner measured on a plant: how far points and plant are from each other.
#include "espalier/base/error.h"
#include "espalier/base/random.h"
#include "espalier/base/read_log.h"

#include "archive/meshes/surface_mesh.h"
#include "base/csv_rows.h"
#include "environment/space/markers/point_file.h"
#include "environment/space/neighbours/point_grid.h"
#include "study/fit/target.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_points = 50'000'000, samples_of_plant = 20'000, asked = 1500, layers = 8;
constexpr double bound_of_size = 0.05, voxels_of_bound = 16, scale_of_extent = 0.05;

/// Points that know their neighbours.
class Cloud {
public:
    Cloud(std::vector<glm::dvec3> points, double bound)
        : points_(std::move(points)), bound_(bound), grid_(points_, all_of(points_.size()), bound / 4) {}

    const std::vector<glm::dvec3>& points() const { return points_; }
    /// The nearest point, if one is within the bound.
    std::optional<std::size_t> nearest(const glm::dvec3& place) const {
        for (const double share : {0.125, 0.25, 0.5, 1.0}) {
            std::optional<std::size_t> found;
            double least = share * bound_;
            grid_.visit_around(place, least, [&](std::uint32_t point) {
                const double distance = glm::distance(points_[point], place);
                if (distance <= least) least = distance, found = point;
                return true;
            });
            if (found) return found;
        }
        return std::nullopt;
    }

private:
    static std::vector<std::uint32_t> all_of(std::size_t count) {
        std::vector<std::uint32_t> numbers(count);
        std::iota(numbers.begin(), numbers.end(), 0);
        return numbers;
    }

    std::vector<glm::dvec3> points_;
    double bound_;
    environment::PointGrid grid_;
};

/// One point of each cubic voxel, the first: as dense near the scanner as far from it.
std::vector<glm::dvec3> thinned(const std::vector<glm::dvec3>& points, double voxel) {
    std::set<std::array<std::int64_t, 3>> taken;
    std::vector<glm::dvec3> kept;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 place = glm::floor(point / voxel);
        const auto cell = [](double x) { return static_cast<std::int64_t>(x); };
        if (taken.insert({cell(place.x), cell(place.y), cell(place.z)}).second) kept.push_back(point);
    }
    return kept;
}

using Triangle = std::array<glm::dvec3, 3>;

/// The distance of a point to a triangle: to its plane inside, else to the nearest edge.
double distance_to(const Triangle& triangle, const glm::dvec3& point) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    bool is_inside = glm::length(normal) > 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 &from = triangle[k], along = triangle[(k + 1) % 3] - from;
        const double length = glm::dot(along, along);
        const double share = length > 0 ? std::clamp(glm::dot(point - from, along) / length, 0.0, 1.0) : 0;
        least = std::min(least, glm::distance(point, from + share * along));
        is_inside = is_inside && glm::dot(glm::cross(along, point - from), normal) >= 0;
    }
    return is_inside ? std::abs(glm::dot(normal, point - a)) / glm::length(normal) : least;
}

/// Points on the surface of grown plants, evenly by area, and the triangle of each.
struct SampledPlants {
    std::vector<glm::dvec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> triangle_of;
};

/// The same random numbers always, so that samples move with the plant when a parameter changes.
SampledPlants sampled(std::span<const Grown> worlds) {
    SampledPlants plants;
    std::vector<double> areas;
    double area = 0;
    for (const Grown& world : worlds) {
        const FrameMesh mesh = archive::mesh_of(*world.geometry, {});
        for (const MeshPart& part : mesh.parts) {
            if (std::find(world.plants.begin(), world.plants.end(), part.plant) == world.plants.end()) continue;
            for (std::size_t i = part.first_triangle; i < part.first_triangle + part.triangles; ++i) {
                const auto& [a, b, c] = mesh.triangles[i];
                plants.triangles.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
                const Triangle& triangle = plants.triangles.back();
                area += glm::length(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
                areas.push_back(area);
            }
        }
    }
    if (!(area > 0)) return plants;
    const RandomKey key(0, 0, Stream::process, digest("points on plants"));
    for (std::size_t i = 0; i < samples_of_plant; ++i) {
        RandomSamples random(key, i, 0);
        const double at = (static_cast<double>(i) + random.uniform()) * area / samples_of_plant;
        const auto found = std::min(std::upper_bound(areas.begin(), areas.end(), at), areas.end() - 1);
        const auto number = static_cast<std::uint32_t>(found - areas.begin());
        const double root = std::sqrt(random.uniform()), share = random.uniform();
        const auto& [a, b, c] = plants.triangles[number];
        plants.points.push_back((1 - root) * a + root * (1 - share) * b + root * share * c);
        plants.triangle_of.push_back(number);
    }
    return plants;
}

/// Where points are: their mean height, and the root of their mean squared distance from a vertical line.
struct Extent {
    double height = 0, radius = 0;
};
Extent extent_of(const std::vector<glm::dvec3>& points, const glm::dvec3& line) {
    Extent extent;
    for (const glm::dvec3& point : points) {
        const double x = point.x - line.x, z = point.z - line.z;
        extent.height += point.y / static_cast<double>(points.size());
        extent.radius += (x * x + z * z) / static_cast<double>(points.size());
    }
    return {extent.height, std::sqrt(extent.radius)};
}

/// Chamfer distances in both directions, each at most `bound`, root mean square by layers of height.
class Points final : public Target {
public:
    Points(std::vector<glm::dvec3> points, std::optional<double> bound) {
        glm::dvec3 low = points.front(), high = low;
        for (const glm::dvec3& point : points) low = glm::min(low, point), high = glm::max(high, point);
        bound_ = bound.value_or(bound_of_size * std::max(glm::distance(low, high), 1e-9));
        lowest_ = low.y;
        layer_ = std::max((high.y - low.y) / layers, 1e-12);
        cloud_.emplace(thinned(points, bound_ / voxels_of_bound), bound_);
        for (const glm::dvec3& point : cloud_->points()) {
            middle_ += point / static_cast<double>(cloud_->points().size());
        }
        const std::size_t every = std::max<std::size_t>(1, cloud_->points().size() / asked);
        for (std::size_t i = 0; i < cloud_->points().size(); i += every) asked_.push_back(cloud_->points()[i]);
        for (const glm::dvec3& point : asked_) has_points_[layer_of(point)] = true;
        for (const char* name : {"points_to_plant", "plant_to_points"}) {
            for (std::size_t layer = 0; layer < layers; ++layer) {
                if (has_points_[layer]) statistics_.push_back({fmt::format("{}.{}", name, layer), 0, bound_ / 4});
            }
        }
        const Extent extent = extent_of(cloud_->points(), middle_);
        const double size = std::max(high.y - low.y, extent.radius);
        statistics_.push_back({"points.height", extent.height, scale_of_extent * size});
        statistics_.push_back({"points.radius", extent.radius, scale_of_extent * size});
    }

    const std::vector<Statistic>& statistics() const override { return statistics_; }
    Needs needs() const override { return {true, false}; }

    std::vector<double> of(std::span<const Grown> worlds) const override {
        std::vector<double> sums(statistics_.size(), 0);
        for (const Grown& world : worlds) {
            const std::vector<double> values = of_one(world);
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += values[i] / static_cast<double>(worlds.size());
        }
        return sums;
    }

    MeasuredPlaces places() const override { return {cloud_->points(), {}}; }
    /// What was measured, and beside it the plant, from the front.
    std::string overlay(const Grown& world) const override {
        const SampledPlants plant = sampled({&world, 1});
        glm::dvec3 low = cloud_->points().front(), high = low;
        for (const auto* points : {&cloud_->points(), &plant.points}) {
            for (const glm::dvec3& point : *points) low = glm::min(low, point), high = glm::max(high, point);
        }
        const double width = high.x - low.x, height = high.y - low.y, edge = 0.03 * std::max(width, height);
        std::string svg =
            fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1000\" viewBox=\"0 0 {:.4g} {:.4g}\">\n",
                        2 * width + 3 * edge, height + 2 * edge);
        const auto draw = [&](const std::vector<glm::dvec3>& points, double left, const char* colour) {
            svg += fmt::format("<g fill=\"{}\">\n", colour);
            const std::size_t every = std::max<std::size_t>(1, points.size() / asked);
            for (std::size_t i = 0; i < points.size(); i += every) {
                svg += fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.2g}\"/>\n", left + points[i].x - low.x,
                                   edge + high.y - points[i].y, edge / 12);
            }
            svg += "</g>\n";
        };
        draw(cloud_->points(), edge, "#d43b3b");
        draw(plant.points, 2 * edge + width, "#3b6fd4");
        return svg + "</svg>\n";
    }

private:
    std::size_t layer_of(const glm::dvec3& point) const {
        return static_cast<std::size_t>(std::clamp((point.y - lowest_) / layer_, 0.0, layers - 0.5));
    }

    std::vector<double> of_one(const Grown& world) const {
        const SampledPlants plant = sampled({&world, 1});
        std::array<double, layers> to_plant{}, to_points{}, asked_of_points{}, asked_of_plant{};
        const Cloud samples(plant.points, bound_);
        for (const glm::dvec3& point : asked_) {
            const auto near = samples.nearest(point);
            const double distance =
                near ? std::min(bound_, distance_to(plant.triangles[plant.triangle_of[*near]], point)) : bound_;
            to_plant[layer_of(point)] += distance * distance;
            ++asked_of_points[layer_of(point)];
        }
        for (std::size_t i = 0; i < plant.points.size(); i += samples_of_plant / asked) {
            const auto near = cloud_->nearest(plant.points[i]);
            const double distance = near ? glm::distance(cloud_->points()[*near], plant.points[i]) : bound_;
            to_points[layer_of(plant.points[i])] += distance * distance;
            ++asked_of_plant[layer_of(plant.points[i])];
        }
        std::vector<double> values;
        const auto add = [&](const auto& squares, const auto& counts) {
            for (std::size_t layer = 0; layer < layers; ++layer) {
                if (!has_points_[layer]) continue;
                values.push_back(counts[layer] > 0 ? std::sqrt(squares[layer] / counts[layer]) : bound_);
            }
        };
        add(to_plant, asked_of_points);
        add(to_points, asked_of_plant);
        const Extent extent = extent_of(thinned(plant.points, bound_ / voxels_of_bound), middle_);
        values.push_back(extent.height);
        values.push_back(extent.radius);
        return values;
    }

    double bound_ = 1, lowest_ = 0, layer_ = 1;
    glm::dvec3 middle_{0};
    std::optional<Cloud> cloud_;
    std::vector<glm::dvec3> asked_;  ///< some of the cloud
    std::array<bool, layers> has_points_{};
    std::vector<Statistic> statistics_;
};

bool has_columns_of_points(const fs::path& file) {
    const CsvRows table(file);
    if (table.rows().empty()) return false;
    const std::vector<std::string>& header = table.rows().front().cells;
    const auto has = [&](const char* name) { return std::find(header.begin(), header.end(), name) != header.end(); };
    return has("x") && has("y") && has("z");
}

/// A table that names the file, or the file itself.
std::optional<Settings> table_of(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".toml") return Settings::read_toml(file);
    const bool is_cloud = extension == ".ply" || extension == ".xyz" || extension == ".pts" || extension == ".asc" ||
                          (extension == ".csv" && has_columns_of_points(file));
    if (!is_cloud) return std::nullopt;
    return Settings{{"file", fs::absolute(file)}, {"up", "y"}};
}

std::shared_ptr<Target> read_points(const fs::path& file) {
    const std::optional<Settings> table = table_of(file);
    if (!table) return nullptr;
    std::vector<Diagnostic> warnings;
    std::vector<glm::dvec3> points = environment::read_point_file(*table, most_points, &warnings);
    const glm::dvec3 foot = table->vector_or("foot", glm::dvec3(0));
    const double above = table->number_or("above", -std::numeric_limits<double>::infinity());
    std::optional<double> bound;
    if (table->has("bound")) bound = table->number("bound", Range::positive());
    table->reject_unread();
    for (glm::dvec3& point : points) point -= foot;
    const std::size_t all = points.size();
    std::erase_if(points, [&](const glm::dvec3& point) { return point.y < above; });
    constexpr std::size_t fewest = 100;
    if (points.size() < fewest) {
        throw UserError(fmt::format("{}: {} of {} points are compared; {} at least tell the form of a plant",
                                    file.string(), points.size(), all, fewest));
    }
    auto target = std::make_shared<Points>(std::move(points), bound);
    for (const Diagnostic& warning : warnings) target->notes.push_back(warning.message);
    return target;
}

const Registered<TargetType> points_entry{
    {"points",
     "points of a scanner (.ply, .xyz, .pts, .asc, .csv with x, y and z; metres, y upwards), or a table (.toml) with "
     "their file, unit and up",
     read_points}};

}  // namespace
}  // namespace espalier::study
