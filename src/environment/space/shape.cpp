// shape: a solid that plants query: a wall, a pot, the outline a hedge is clipped to.
//
//   [environment.hedge]
//   process = "shape"
//   shape   = "ellipsoid"
//   center  = [0, 2, 0]
//   radii   = [1, 2, 1]
//   motion  = { times = [40, 60], growth = [0, -0.5] }   # clipped closer from step 40 to step 60
//
// ?hedge(inside, distance, nx, ny, nz, x, y, z) with one to eight parameters: 1 if the turtle stands inside or on the
// surface and 0 if not, the signed distance (m, negative inside), the outward unit normal, the nearest point of the
// surface. Groups that the query has no room for are left out.
// Field <name>.distance: the signed distance (m) as a level set.
#include "espalier/environment/shape.h"

#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/covering.h"
#include "environment/space/shapes/field.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// Growth and movement of a shape by piecewise linear functions of the step, constant before the first and after the
/// last of `times`.
class Motion {
public:
    explicit Motion(const Settings& table) {
        if (!table.has("motion")) return;
        const Settings motion = table.table("motion");
        times_ = motion.numbers("times");
        if (times_.empty()) throw UserError(motion.place("times"), "'times' must hold one step or more");
        if (!std::is_sorted(times_.begin(), times_.end(), std::less_equal<>())) {
            throw UserError(motion.place("times"), "'times' must rise from each to the next");
        }
        growth_ = motion.numbers_or("growth", std::vector<double>(times_.size(), 0.0));
        movement_.assign(times_.size(), glm::dvec3(0));
        if (motion.has("movement")) movement_ = motion.vectors("movement");
        require_as_many(motion, "growth", growth_.size());
        require_as_many(motion, "movement", movement_.size());
    }

    bool moves() const { return times_.size() > 1; }
    double growth(double step) const { return at(growth_, step); }
    glm::dvec3 movement(double step) const { return at(movement_, step); }
    /// What `shape` goes through: between these it changes linearly.
    std::vector<std::shared_ptr<const Shape>> stages(const std::shared_ptr<const Shape>& shape) const {
        std::vector<std::shared_ptr<const Shape>> stages;
        for (std::size_t i = 0; i < times_.size(); ++i) {
            stages.push_back(grown_and_moved(shape, growth_[i], movement_[i]));
        }
        return stages;
    }

private:
    void require_as_many(const Settings& motion, const char* key, std::size_t count) const {
        if (count == times_.size()) return;
        throw UserError(motion.place(key), fmt::format("'{}' must have one value for each of the {} times, not {}", key,
                                                       times_.size(), count));
    }

    template <class Value>
    Value at(const std::vector<Value>& values, double step) const {
        const std::size_t next = std::upper_bound(times_.begin(), times_.end(), step) - times_.begin();
        if (next == 0) return values.front();
        if (next == times_.size()) return values.back();
        return glm::mix(values[next - 1], values[next], (step - times_[next - 1]) / (times_[next] - times_[next - 1]));
    }

    std::vector<double> times_{0};
    std::vector<double> growth_{0};
    std::vector<glm::dvec3> movement_{glm::dvec3(0)};
};

class ShapeProcess final : public EnvironmentProcess {
public:
    ShapeProcess(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          at_rest_(read_shape(settings)),
          motion_(settings),
          domain_(context.domain),
          memory_(context.memory),
          place_(settings.place(settings.has("voxel") ? "voxel" : "")),
          inside_(context.plants),
          outside_(context.plants),
          box_(box_of_field()) {
        const glm::dvec3 side = box_.upper - box_.lower;
        const double longest = box_.empty() ? 128 : std::max({side.x, side.y, side.z});
        voxel_ = read_voxel(settings, longest / 128);
        if (at_rest_->bounds()) box_ = {box_.lower - 4 * voxel_, box_.upper + 4 * voxel_};  // room for the band
        put_at(0, fields);
    }

    void advance(const WorldView& world, Queries, Fields& fields) override {
        if (motion_.moves()) put_at(world.step, fields);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for_in_parallel(std::size_t{0}, queries.size(),
                        [&](std::size_t i) { answer_one(queries[i].pose.position, answers[i]); });
        std::fill(inside_.begin(), inside_.end(), 0);
        std::fill(outside_.begin(), outside_.end(), 0);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            ++(answers[i][0] > 0 ? inside_ : outside_)[queries[i].plant];
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return {{"inside", static_cast<double>(inside_[plant])}, {"outside", static_cast<double>(outside_[plant])}};
    }

    std::pair<int, int> query_arity() const override { return {1, 8}; }
    Spreading spreading() const override { return Spreading::reach; }

    ProcessMemory memory() const override { return {held_, motion_.moves()}; }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    void answer_one(const glm::dvec3& position, Answer answer) const {
        if (answer.size() == 1) {
            answer[0] = shape_->inside(position);
            return;
        }
        const bool whole = answer.size() >= 5;
        const Shape::Sample sample = whole ? shape_->sample(position) : Shape::Sample{shape_->distance(position)};
        answer[0] = sample.distance <= 0;
        answer[1] = sample.distance;
        for (int i = 0; whole && i < 3; ++i) answer[2 + i] = sample.normal[i];
        for (int i = 0; answer.size() >= 8 && i < 3; ++i) answer[5 + i] = sample.nearest[i];
    }

    void put_at(double step, Fields& fields) {
        const double growth = motion_.growth(step);
        const glm::dvec3 movement = motion_.movement(step);
        if (shape_ && growth == growth_ && movement == movement_) return;
        growth_ = growth;
        movement_ = movement;
        shape_ = grown_and_moved(at_rest_, growth, movement);
        provide_field(fields);
    }

    /// The shape's own box over its whole motion; the domain for a shape without bounds; empty if there is neither.
    Box box_of_field() const {
        Box box;
        for (const auto& stage : motion_.stages(at_rest_)) {
            const std::optional<Box> bounds = stage->bounds();
            if (!bounds) return domain_.value_or(Box{});
            box.add(*bounds);
        }
        return box;
    }

    void provide_field(Fields& fields) {
        if (box_.empty()) return;
        const std::shared_ptr<const FieldGrid> grid = sample_level_set(*shape_, box_, voxel_, memory_, place_);
        held_ = bytes_held(*grid);
        fields.provide(
            {name_ + ".distance", "m", "signed distance to the surface, negative inside", grid, motion_.moves()});
    }

    std::string name_;
    std::shared_ptr<const Shape> at_rest_, shape_;
    Motion motion_;
    std::optional<Box> domain_;
    std::size_t memory_, held_ = 0;  ///< bytes, of the field
    Place place_;
    double voxel_ = 0;
    double growth_ = 0;
    glm::dvec3 movement_{0};
    std::vector<std::uint64_t> inside_, outside_;  ///< queries of each plant in this step
    Box box_;                                      ///< box of the field
};

std::string help() {
    return std::string(R"(A solid that plants grow in, along or around. Distances are in metres, and negative inside.

?name(i)             -> i: 1 inside the solid, else 0
?name(i, d)          -> d: distance to the surface
?name(i, d, x, y, z) -> x, y, z: outward normal of the nearest point of the surface
?name(i, d, x, y, z, a, b, c) -> a, b, c: nearest point of the surface

voxel     longest side / 128, m, >= 1.5e-5; edge of the voxels of the field <name>.distance and of a mesh's level set
motion    none; changes size and position, linearly between the times
    times     required; steps at which it has these values
    growth    none, m; by how much the solid is expanded at each time; none: nowhere
    movement  none, m; [[x, y, z], ...]: how far it has moved at each time; none: nowhere

Field: name.distance. Statistics of a plant: inside and outside, numbers of queries.
The keys of the solid stand in the same table:

)") + shape_help();
}

const Registered<ProcessType> entry{
    {"shape", "signed distance to bounding shapes and meshes", help(), construct<ShapeProcess>}};

}  // namespace
}  // namespace espalier::environment
