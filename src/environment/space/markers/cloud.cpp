#include "environment/space/markers/cloud.h"

#include "espalier/base/math.h"
#include "espalier/environment/shape.h"

#include "base/parallel.h"
#include "environment/space/markers/point_file.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

namespace espalier::environment {
namespace {

constexpr std::uint32_t most_tries = 20000;

/// How many points, from `number` or `density`, and where their random numbers come from.
class Filling {
public:
    Filling(const Settings& table, const EnvironmentContext& context, std::size_t which, std::size_t most)
        : table_(table), most_(most) {
        const auto seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, Range::not_negative()));
        key_ = RandomKey(mix(context.seed, seed), static_cast<std::uint32_t>(which), Stream::process, 0x6d61726bU);
        if (table.has("number") && table.has("density")) {
            throw UserError(table.place("number"), "give either 'number' or 'density' of the points, not both");
        }
    }

    std::size_t count(double volume) const {
        if (table_.has("number")) {
            const auto count = table_.integer("number", Range::positive());
            return checked(static_cast<double>(count), "number");
        }
        return checked(std::round(table_.number_or("density", 20, Range::positive()) * volume), "density");
    }

    RandomSamples samples(std::size_t point) const { return {key_, point, 0}; }
    RandomKey key() const { return key_; }

private:
    std::size_t checked(double count, const char* key) const {
        if (count < 1) {
            throw UserError(table_.place(key), fmt::format("the cloud has no points: raise '{}' or enlarge it", key));
        }
        if (count > static_cast<double>(most_)) {
            throw UserError(table_.place(key),
                            fmt::format("{:.0f} points are more than the memory of the process holds ({}): lower "
                                        "'{}', or raise --memory",
                                        count, most_, key));
        }
        return static_cast<std::size_t>(count);
    }

    Settings table_;
    std::size_t most_;
    RandomKey key_;
};

/// `count` points of a box, each the first of its samples that `accepts`. Throws if one finds no place.
template <class Accepts>
std::vector<glm::dvec3> fill(const Box& box, std::size_t count, const Filling& filling, const Accepts& accepts,
                             const Place& place) {
    std::vector<glm::dvec3> points(count);
    std::atomic<bool> failed = false;
    for_in_parallel(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end() && !failed; ++i) {
            RandomSamples samples = filling.samples(i);
            std::uint32_t tries = 0;
            do {
                const double x = samples.uniform(), y = samples.uniform(), z = samples.uniform();
                points[i] = box.lower + glm::dvec3(x, y, z) * (box.upper - box.lower);
            } while (!accepts(points[i]) && ++tries < most_tries);
            if (tries == most_tries) failed = true;
        }
    });
    if (failed) throw UserError(place, "the shape encloses next to nothing of its box: no point finds a place in it");
    return points;
}

/// Noise of 0 to 1 on the unit sphere: random values at the corners of a lattice, smoothly blended.
class RimNoise {
public:
    explicit RimNoise(RandomKey key) : key_(key) {}

    double at(const glm::dvec3& direction) const {
        constexpr double cells_by_radius = 3;
        const glm::dvec3 place = cells_by_radius * (direction + 2.0), cell = glm::floor(place);
        const glm::dvec3 in = place - cell, share = in * in * (3.0 - 2.0 * in);
        double sum = 0;
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const glm::uvec3 to(corner & 1U, corner >> 1U & 1U, corner >> 2U);
            const glm::uvec3 node = glm::uvec3(cell) + to;
            const glm::dvec3 weight = glm::mix(1.0 - share, share, glm::dvec3(to));
            const std::uint64_t number = node.x + 64ULL * node.y + 4096ULL * node.z;
            sum += weight.x * weight.y * weight.z * RandomSamples(key_, number, 1).uniform();
        }
        return sum;
    }

private:
    RandomKey key_;
};

/// A layer of the unit ball behind whose rim some is taken away, by up to `rough` of the radius. The rim that is left
/// is stretched towards each of the six sides until it reaches the ball's, so that a crown is as wide as it should be.
class RaggedBall {
public:
    RaggedBall(double rough, double lower, double upper, RandomKey key) : rough_(rough), noise_(key) {
        const auto [low, high] = sides(-1, 1, {1, 1, 1});
        below_.y = -low.y;
        above_.y = high.y;
        const double middle = std::clamp(0.0, lower, upper), widest = std::sqrt(1 - middle * middle);
        const auto [narrow, wide] = sides(unstretched(lower, 1), unstretched(upper, 1), {1, 0, 1});
        for (const int axis : {0, 2}) {
            below_[axis] = std::max(-narrow[axis] / widest, 1 - rough);
            above_[axis] = std::max(wide[axis] / widest, 1 - rough);
        }
    }

    bool encloses(const glm::dvec3& point) const {
        const glm::dvec3 place(unstretched(point.x, 0), unstretched(point.y, 1), unstretched(point.z, 2));
        const double distance = glm::length(place);
        return distance <= 1 - rough_ || distance <= rim(place / distance);
    }

private:
    double rim(const glm::dvec3& direction) const { return 1 - rough_ * noise_.at(direction); }
    double unstretched(double at, int axis) const { return at * (at < 0 ? below_ : above_)[axis]; }

    /// The farthest places of the layer between two heights, of those axes that count.
    std::pair<glm::dvec3, glm::dvec3> sides(double lower, double upper, const glm::dvec3& counts) const {
        constexpr int directions = 8192;                    // some fifty for each place where the noise can change
        constexpr double golden_angle = 2.399963229728653;  // pi (3 - sqrt 5)
        glm::dvec3 low(0), high(0);
        for (int i = 0; i < directions; ++i) {
            const double y = 1 - (2 * i + 1.0) / directions, across = std::sqrt(1 - y * y);
            const auto [sine, cosine] = math::sine_and_cosine(golden_angle * i);
            const glm::dvec3 direction(across * cosine, y, across * sine);
            const double reach = std::min(rim(direction), (y > 0 ? upper : lower) / y);
            if (reach * y < lower - 1e-12 || reach < 0) continue;
            low = glm::min(low, counts * reach * direction);
            high = glm::max(high, counts * reach * direction);
        }
        return {low, high};
    }

    double rough_;
    RimNoise noise_;
    glm::dvec3 below_{1}, above_{1};  ///< how far it would reach on the lower and the upper side of each axis
};

/// A layer of the unit ball times the radii (Brzoska 2019, section 5.2.1).
std::vector<glm::dvec3> ellipsoid(const Settings& table, const Filling& filling) {
    const glm::dvec3 radii = table.vector("radii");
    for (int k = 0; k < 3; ++k) {
        if (!(radii[k] > 0)) {
            throw UserError(table.place("radii"), "'radii' must be three lengths above 0 (m): across, up, across");
        }
    }
    const double below = table.number_or("below", 0, Range::between(0, 1));
    const double above = table.number_or("above", 0, Range::between(0, 1));
    const double lower = -1 + 2 * below, upper = 1 - 2 * above;
    if (!(lower < upper)) {
        throw UserError(table.place("below"), "'below' and 'above' cut off the whole cloud; their sum must be below 1");
    }
    const glm::dvec3 base = table.vector_or("base", {0, 0, 0});
    const std::size_t count = filling.count(radii.x * radii.y * radii.z * ball_layer_volume(lower, upper));
    const auto in_ball = [](const glm::dvec3& point) {
        return point.x * point.x + point.y * point.y + point.z * point.z <= 1;
    };
    std::vector<glm::dvec3> points =
        fill({{-1, lower, -1}, {1, upper, 1}}, count, filling, in_ball, table.place("radii"));
    if (const double rough = table.number_or("rough", 0, Range::between(0, 0.9)); rough > 0) {
        const RaggedBall ragged(rough, lower, upper, filling.key());
        std::erase_if(points, [&](const glm::dvec3& point) { return !ragged.encloses(point); });
    }
    for (glm::dvec3& point : points) point = base + radii * (point - glm::dvec3(0, lower, 0));
    return points;
}

Box bounds_of(const Shape& shape, const Settings& table, const EnvironmentContext& context) {
    const std::optional<Box> box = shape.bounds() ? shape.bounds() : context.domain;
    if (!box) throw UserError(table.place("shape"), "this shape has no end: give the scene a domain");
    return *box;
}

/// The share of the box that the shape fills, by a million points.
double filled_share(const Shape& shape, const Box& box, const Filling& filling, const Place& place) {
    constexpr std::size_t tries = 1000000;
    std::atomic<std::size_t> hits = 0;
    for_in_parallel(tbb::blocked_range<std::size_t>(0, tries, 10000), [&](const auto& range) {
        std::size_t here = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            RandomSamples samples = filling.samples(i);
            const double x = samples.uniform(), y = samples.uniform(), z = samples.uniform();
            here += shape.inside(box.lower + glm::dvec3(x, y, z) * (box.upper - box.lower));
        }
        hits += here;
    });
    if (hits == 0) throw UserError(place, "the shape encloses nothing");
    return static_cast<double>(hits) / tries;
}

std::vector<glm::dvec3> in_shape(Settings table, const Filling& filling, const EnvironmentContext& context) {
    Settings description = table.table("shape");
    const std::shared_ptr<const Shape> shape = read_shape(description);
    description.reject_unread();
    const Box box = bounds_of(*shape, table, context);
    const glm::dvec3 edges = box.upper - box.lower;
    const double share = filled_share(*shape, box, filling, table.place("shape"));
    const std::size_t count = filling.count(edges.x * edges.y * edges.z * share);
    const auto inside = [&](const glm::dvec3& point) { return shape->inside(point); };
    return fill(box, count, filling, inside, table.place("shape"));
}

std::vector<glm::dvec3> listed(const Settings& table) {
    std::vector<glm::dvec3> points = table.vectors("points");
    if (points.empty()) throw UserError(table.place("points"), "'points' is empty: the cloud has no points");
    return points;
}

std::vector<glm::dvec3> read_cloud(const Settings& table, const EnvironmentContext& context, std::size_t which,
                                   std::size_t most) {
    const int kinds = table.has("radii") + table.has("shape") + table.has("points") + table.has("file");
    if (kinds != 1) {
        throw UserError(table.place(), "a cloud needs one of 'radii' (an ellipsoid), 'shape', 'points' and 'file'");
    }
    if (table.has("file")) return read_point_file(table, most, context.warnings);
    if (table.has("points")) return listed(table);
    const Filling filling(table, context, which, most);
    return table.has("radii") ? ellipsoid(table, filling) : in_shape(table, filling, context);
}

}  // namespace

double ball_layer_volume(double lower, double upper) {
    const auto below = [](double z) { return std::numbers::pi * (z - z * z * z / 3); };
    return below(upper) - below(lower);
}

std::vector<glm::dvec3> read_clouds(const Settings& table, const EnvironmentContext& context, std::size_t most) {
    const bool is_one = table.is_table("cloud");
    const std::vector<Settings> clouds = is_one ? std::vector{table.table("cloud")} : table.tables("cloud");
    if (clouds.empty()) {
        throw UserError(table.place("cloud"), "there is no cloud: cloud = { radii = [2, 3, 2], base = [0, 1, 0] }");
    }
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        const std::vector<glm::dvec3> more = read_cloud(clouds[i], context, i, most - points.size());
        clouds[i].reject_unread();
        points.insert(points.end(), more.begin(), more.end());
    }
    return points;
}

const char* const cloud_help =
    R"(cloud      required; attraction points, or several clouds of them as [[environment.<name>.cloud]]. One of radii, shape,
           points and file says where
    radii    none, m; [across, up, across]: points in an ellipsoid
    base     [0, 0, 0] m; the middle of the lower end of the ellipsoid
    below    0, 0 to 1; share of the ellipsoid's height that is cut off at the lower end
    above    0, 0 to 1; the same at the upper end
    rough    0, 0 to 0.9; by what share of the radii its rim retreats in places; what is left is stretched to the six sides, so that a
             crown is as wide, deep and high as without
    shape    none; { shape = "...", ... }: points in a solid of `espalier list shapes`
    points   none, m; [[x, y, z], ...]: these points
    file     none; a file of points, as of a scanned crown (.xyz, .txt, .csv, .asc or .pts: rows of x, y, z), or a mesh,
             whose corners they are (.ply, .obj)
    unit     "m"; of the file's lengths: "m", "dm", "cm", "mm", "um" or "inch"
    up       z of rows, y of meshes; the file's axis that points upwards: "x", "y", "z", "-x", "-y" or "-z"
    density  20 points/m3, > 0; how many points an ellipsoid or a solid has
    number   none, > 0; how many points in all, in place of the density
    seed     0, >= 0; another cloud of the same kind
)";

}  // namespace espalier::environment
