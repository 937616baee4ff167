// Shapes with flat faces and rounded poly-lines: box, half-space, tube.
#include "environment/space/shapes/kinds.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

class BoxShape final : public Shape {
public:
    explicit BoxShape(const Box& box) : box_(box) {}

    double distance(const glm::dvec3& point) const override {
        const glm::dvec3 beyond = glm::max(box_.lower - point, point - box_.upper);
        return glm::length(glm::max(beyond, 0.0)) + std::min(0.0, std::max({beyond.x, beyond.y, beyond.z}));
    }

    Sample sample(const glm::dvec3& point) const override {
        const glm::dvec3 beyond = glm::max(box_.lower - point, point - box_.upper);
        const int axis = nearest_axis(beyond);
        const bool below = box_.lower[axis] - point[axis] >= point[axis] - box_.upper[axis];
        glm::dvec3 normal(0);
        normal[axis] = below ? -1 : 1;
        const bool within = beyond[axis] <= 0;
        glm::dvec3 nearest = glm::clamp(point, box_.lower, box_.upper);
        if (within) nearest[axis] = below ? box_.lower[axis] : box_.upper[axis];
        return sample_of(point, nearest, within, normal);
    }

    std::optional<Box> bounds() const override {
        if (!std::isfinite(box_.upper.z)) return std::nullopt;
        return box_;
    }

private:
    static int nearest_axis(const glm::dvec3& beyond) {
        if (beyond.x >= beyond.y && beyond.x >= beyond.z) return 0;
        return beyond.y >= beyond.z ? 1 : 2;
    }

    Box box_;
};

class HalfSpace final : public Shape {
public:
    HalfSpace(const glm::dvec3& point, const glm::dvec3& normal) : point_(point), normal_(normal) {}

    double distance(const glm::dvec3& point) const override { return glm::dot(point - point_, normal_); }

    Sample sample(const glm::dvec3& point) const override {
        const double height = distance(point);
        return {height, normal_, point - height * normal_};
    }

    std::optional<Box> bounds() const override { return std::nullopt; }

private:
    glm::dvec3 point_, normal_;
};

/// All points within a radius of a poly-line.
class Tube final : public Shape {
public:
    Tube(std::vector<glm::dvec3> points, double radius) : points_(std::move(points)), radius_(radius) {}

    double distance(const glm::dvec3& point) const override {
        return glm::length(point - nearest_on_line(point).foot) - radius_;
    }

    Sample sample(const glm::dvec3& point) const override {
        const auto [foot, direction] = nearest_on_line(point);
        const double away = glm::length(point - foot);
        const glm::dvec3 normal = away > 0 ? (point - foot) / away : perpendicular(direction);
        return {away - radius_, normal, foot + radius_ * normal};
    }

    std::optional<Box> bounds() const override {
        Box box;
        for (const glm::dvec3& point : points_) {
            box.add(point - radius_);
            box.add(point + radius_);
        }
        return box;
    }

private:
    struct Foot {
        glm::dvec3 foot, direction;
    };

    Foot nearest_on_line(const glm::dvec3& point) const {
        Foot best{};
        double best_square = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const glm::dvec3 along = points_[i + 1] - points_[i];
            const double t = std::clamp(glm::dot(point - points_[i], along) / glm::dot(along, along), 0.0, 1.0);
            const glm::dvec3 foot = points_[i] + t * along;
            const double square = glm::dot(point - foot, point - foot);
            if (square < best_square) {
                best_square = square;
                best = {foot, glm::normalize(along)};
            }
        }
        return best;
    }

    std::vector<glm::dvec3> points_;
    double radius_;
};

/// Three numbers, or two and nothing: then `z` stands for the third.
glm::dvec3 flat_or_solid(const Settings& table, const char* key, double z, bool& flat) {
    const std::vector<double> values = table.numbers(key);
    if (values.size() != 2 && values.size() != 3) {
        throw UserError(table.place(key),
                        fmt::format("'{}' must be [x, y, z], or [x, y] for a box without an end along z", key));
    }
    flat = values.size() == 2;
    return {values[0], values[1], flat ? z : values[2]};
}

}  // namespace

ShapePointer read_box(Settings& table) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool by_size = table.has("size") || table.has("center");
    const char* const second_key = by_size ? "size" : "upper";
    bool first_flat = false, second_flat = false;
    Box box;
    if (by_size) {
        const glm::dvec3 center = flat_or_solid(table, "center", 0, first_flat);
        const glm::dvec3 size = flat_or_solid(table, "size", infinity, second_flat);
        box = {center - 0.5 * size, center + 0.5 * size};
    } else {
        box = {flat_or_solid(table, "lower", -infinity, first_flat),
               flat_or_solid(table, "upper", infinity, second_flat)};
    }
    if (first_flat != second_flat) {
        throw UserError(table.place(second_key), fmt::format("'{}' and '{}' must have as many numbers as each other",
                                                             by_size ? "center" : "lower", second_key));
    }
    if (!glm::all(glm::lessThan(box.lower, box.upper))) {
        throw UserError(table.place(second_key), by_size ? "'size' must be greater than 0 along every axis"
                                                         : "'upper' must be greater than 'lower' along every axis");
    }
    return std::make_shared<BoxShape>(box);
}

ShapePointer read_half_space(Settings& table) {
    const glm::dvec3 point = table.vector_or("point", {0, 0, 0});
    const glm::dvec3 normal = table.vector("normal");
    const double length = glm::length(normal);
    if (!(length > 0)) throw UserError(table.place("normal"), "'normal' must not be [0, 0, 0]");
    return std::make_shared<HalfSpace>(point, normal / length);
}

ShapePointer read_tube(Settings& table) {
    std::vector<glm::dvec3> points = table.vectors("points");
    const double radius = table.number("radius", Range::positive());
    if (points.size() < 2) throw UserError(table.place("points"), "'points' must hold two points or more");
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (points[i] == points[i + 1]) {
            throw UserError(table.place("points"),
                            fmt::format("points {} and {} of the tube are the same", i + 1, i + 2));
        }
    }
    return std::make_shared<Tube>(std::move(points), radius);
}

}  // namespace espalier::environment
