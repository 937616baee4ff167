// Shapes made of shapes: union, intersection, difference; and shapes put elsewhere or grown.
#include "environment/space/shapes/kinds.h"
#include "geometry/drawn/rigid_motion.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

struct DistanceAndNormal {
    double distance;
    glm::dvec3 normal;
};

/// A shape made of shapes can give its distance and normal without seeking the nearest point.
class Compound : public Shape {
public:
    virtual DistanceAndNormal combined(const glm::dvec3& point) const = 0;

    static DistanceAndNormal of(const Shape& shape, const glm::dvec3& point) {
        if (const auto* compound = dynamic_cast<const Compound*>(&shape)) return compound->combined(point);
        const Sample sample = shape.sample(point);
        return {sample.distance, sample.normal};
    }
};

/// Where the nearest point is not known, it is sought by walking down the distance, which never overshoots because a
/// distance never falls faster than 1 per metre.
class Combination : public Compound {
public:
    Sample sample(const glm::dvec3& point) const final {
        const auto [distance_here, normal] = combined(point);
        glm::dvec3 nearest = point;
        DistanceAndNormal at{distance_here, normal};
        const double close_enough = 1e-12 * (1 + glm::length(point) + std::abs(distance_here));
        for (int i = 0; i < 100 && std::abs(at.distance) > close_enough; ++i) {
            nearest -= at.distance * at.normal;
            at = combined(nearest);
        }
        return {distance_here, normal, nearest};
    }
};

class Union final : public Combination {
public:
    Union(std::vector<ShapePointer> parts, double blend) : parts_(std::move(parts)), blend_(blend) {}

    double distance(const glm::dvec3& point) const override {
        double result = parts_[0]->distance(point);
        for (std::size_t i = 1; i < parts_.size(); ++i) {
            const double other = parts_[i]->distance(point);
            const double melt = melting(result, other);
            result = std::min(result, other) - 0.25 * melt * melt * blend_;
        }
        return result;
    }

    bool inside(const glm::dvec3& point) const override {
        const auto has = [&](const ShapePointer& part) { return part->inside(point); };
        return std::any_of(parts_.begin(), parts_.end(), has) || (blend_ > 0 && distance(point) <= 0);
    }

    std::optional<Box> bounds() const override {
        Box box;
        for (const ShapePointer& part : parts_) {
            const std::optional<Box> bounds = part->bounds();
            if (!bounds) return std::nullopt;
            box.add(*bounds);
        }
        // Each melting lowers the distance by a quarter of `blend` at most, and none below the least part by more
        // than `blend`, where melting ends.
        const double bulge = std::min(0.25 * static_cast<double>(parts_.size() - 1), 1.0) * blend_;
        return Box{box.lower - bulge, box.upper + bulge};
    }

    /// The smooth minimum a, b -> min - h^2 k / 4, h = max(k - |a - b|, 0) / k (Quilez 2013, polynomial form).
    DistanceAndNormal combined(const glm::dvec3& point) const override {
        DistanceAndNormal result = of(*parts_[0], point);
        for (std::size_t i = 1; i < parts_.size(); ++i) {
            DistanceAndNormal other = of(*parts_[i], point);
            const double melt = melting(result.distance, other.distance);
            if (other.distance < result.distance) std::swap(result, other);
            result.distance -= 0.25 * melt * melt * blend_;
            if (melt > 0) result.normal = mixed(result.normal, other.normal, 0.5 * melt);
        }
        return result;
    }

private:
    /// From 0 where the surfaces are farther apart than `blend` to 1 where they meet.
    double melting(double a, double b) const {
        return blend_ > 0 ? std::max(blend_ - std::abs(a - b), 0.0) / blend_ : 0;
    }

    static glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double share_of_b) {
        const glm::dvec3 sum = glm::mix(a, b, share_of_b);
        const double length = glm::length(sum);
        return length > 1e-9 ? sum / length : a;
    }

    std::vector<ShapePointer> parts_;
    double blend_;
};

/// What all parts share. With `complements`, every part but the first stands for its outside: a difference.
class Intersection final : public Combination {
public:
    Intersection(std::vector<ShapePointer> parts, bool complements)
        : parts_(std::move(parts)), complements_(complements) {}

    double distance(const glm::dvec3& point) const override {
        double result = parts_[0]->distance(point);
        for (std::size_t i = 1; i < parts_.size(); ++i) result = std::max(result, sign() * parts_[i]->distance(point));
        return result;
    }

    bool inside(const glm::dvec3& point) const override {
        const auto keeps = [&](const ShapePointer& part) {
            // The surface that a cut leaves behind belongs to what is left.
            return complements_ ? !part->inside(point) || part->distance(point) >= 0 : part->inside(point);
        };
        return parts_[0]->inside(point) && std::all_of(parts_.begin() + 1, parts_.end(), keeps);
    }

    std::optional<Box> bounds() const override {
        std::optional<Box> box = parts_[0]->bounds();
        for (std::size_t i = 1; i < parts_.size() && !complements_; ++i) {
            const std::optional<Box> other = parts_[i]->bounds();
            if (box && other) box = Box{glm::max(box->lower, other->lower), glm::min(box->upper, other->upper)};
            if (!box) box = other;
        }
        return box;
    }

    DistanceAndNormal combined(const glm::dvec3& point) const override {
        DistanceAndNormal result = of(*parts_[0], point);
        for (std::size_t i = 1; i < parts_.size(); ++i) {
            const DistanceAndNormal other = of(*parts_[i], point);
            if (sign() * other.distance > result.distance) result = {sign() * other.distance, sign() * other.normal};
        }
        return result;
    }

private:
    double sign() const { return complements_ ? -1 : 1; }

    std::vector<ShapePointer> parts_;
    bool complements_;
};

/// A shape scaled, turned and moved: x -> translation + scale * rotation(x).
class Placed final : public Compound {
public:
    Placed(ShapePointer shape, double scale, const glm::dquat& rotation, const glm::dvec3& translation)
        : shape_(std::move(shape)), scale_(scale), rotation_(rotation), translation_(translation) {}

    double distance(const glm::dvec3& point) const override { return scale_ * shape_->distance(to_shape(point)); }
    bool inside(const glm::dvec3& point) const override { return shape_->inside(to_shape(point)); }

    Sample sample(const glm::dvec3& point) const override {
        const Sample sample = shape_->sample(to_shape(point));
        return {scale_ * sample.distance, rotation_ * sample.normal, from_shape(sample.nearest)};
    }

    DistanceAndNormal combined(const glm::dvec3& point) const override {
        const DistanceAndNormal inner = of(*shape_, to_shape(point));
        return {scale_ * inner.distance, rotation_ * inner.normal};
    }

    std::optional<Box> bounds() const override {
        const std::optional<Box> inner = shape_->bounds();
        if (!inner || inner->empty()) return inner;
        Box box;
        for (int corner = 0; corner < 8; ++corner) {
            box.add(
                from_shape({(corner & 1 ? inner->upper : inner->lower).x, (corner & 2 ? inner->upper : inner->lower).y,
                            (corner & 4 ? inner->upper : inner->lower).z}));
        }
        return box;
    }

private:
    glm::dvec3 to_shape(const glm::dvec3& point) const {
        return (glm::conjugate(rotation_) * (point - translation_)) / scale_;
    }
    glm::dvec3 from_shape(const glm::dvec3& point) const { return translation_ + scale_ * (rotation_ * point); }

    ShapePointer shape_;
    double scale_;
    glm::dquat rotation_;
    glm::dvec3 translation_;
};

/// A shape grown by `growth` metres on all sides, with rounded edges; shrunk where negative.
class Grown final : public Combination {
public:
    Grown(ShapePointer shape, double growth) : shape_(std::move(shape)), growth_(growth) {}

    double distance(const glm::dvec3& point) const override { return shape_->distance(point) - growth_; }

    std::optional<Box> bounds() const override {
        const std::optional<Box> inner = shape_->bounds();
        if (!inner || inner->empty()) return inner;
        const Box box{inner->lower - growth_, inner->upper + growth_};
        return glm::all(glm::lessThanEqual(box.lower, box.upper)) ? box : Box{};
    }

    DistanceAndNormal combined(const glm::dvec3& point) const override {
        const DistanceAndNormal inner = of(*shape_, point);
        return {inner.distance - growth_, inner.normal};
    }

private:
    ShapePointer shape_;
    double growth_;
};

std::vector<ShapePointer> read_parts(Settings& table) {
    std::vector<ShapePointer> parts;
    for (Settings& part : table.tables("of")) parts.push_back(read_shape(part));
    if (parts.empty()) throw UserError(table.place(), "'of' is missing here: the shapes this one is made of");
    return parts;
}

glm::dquat read_rotation(Settings& table) {
    if (!table.has("rotate")) return {1, 0, 0, 0};
    const Settings rotate = table.table("rotate");
    const glm::dvec3 axis = rotate.vector("axis");
    const double length = glm::length(axis);
    if (!(length > 0)) throw UserError(rotate.place("axis"), "'axis' must not be [0, 0, 0]");
    return geometry::turn_about(axis / length, glm::radians(rotate.number("angle")));
}

}  // namespace

ShapePointer read_union(Settings& table) {
    std::vector<ShapePointer> parts = read_parts(table);
    return std::make_shared<Union>(std::move(parts), table.number_or("blend", 0, Range::not_negative()));
}

ShapePointer read_intersection(Settings& table) {
    return std::make_shared<Intersection>(read_parts(table), false);
}

ShapePointer read_difference(Settings& table) {
    return std::make_shared<Intersection>(read_parts(table), true);
}

double scale_of(const Settings& table) {
    return table.number_or("scale", 1, Range::positive());
}

ShapePointer place(ShapePointer shape, Settings& table, bool is_scaled) {
    const double scale = is_scaled ? 1 : scale_of(table);
    const glm::dquat rotation = read_rotation(table);
    const glm::dvec3 translation = table.vector_or("translate", {0, 0, 0});
    const double growth = table.number_or("offset", 0);
    const bool stays = scale == 1 && rotation == glm::dquat(1, 0, 0, 0) && translation == glm::dvec3(0);
    if (!stays) shape = std::make_shared<Placed>(std::move(shape), scale, rotation, translation);
    if (growth != 0) shape = std::make_shared<Grown>(std::move(shape), growth);
    return shape;
}

std::shared_ptr<const Shape> grown_and_moved(std::shared_ptr<const Shape> shape, double growth,
                                             const glm::dvec3& movement) {
    if (growth != 0) shape = std::make_shared<Grown>(std::move(shape), growth);
    if (movement == glm::dvec3(0)) return shape;
    return std::make_shared<Placed>(std::move(shape), 1, glm::dquat(1, 0, 0, 0), movement);
}

}  // namespace espalier::environment
