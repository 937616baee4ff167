// shadowpyramid: organs cast pyramids of shadow that multiply, their own among them.
// Palubicki, Horel, Longay, Runions, Lane, Mech & Prusinkiewicz 2009, Self-organizing tree models, section 3, as the
// environment program of that name does it; voxel-shade is this project's process.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/parameter_file.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <tuple>
#include <vector>

namespace espalier::environment {
namespace {

class ShadowPyramid final : public EnvironmentProcess {
public:
    ShadowPyramid(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name), memory_(context.memory), statistics_(context.plants) {
        ParameterFile file(settings, context,
                           {"grid size", "grid span", "shadow spread", "shadow depth", "shadow weight",
                            "shadow dissipation", "light randomness", "light vertical bias", "sample radius"});
        as_cpfg_ = file.has_numbers_of_cpfg();
        const double size = std::floor(file.number("grid size", 201, Range::between(2, 1e6)));
        const double span = file.number("grid span", 200, Range::positive());
        voxel_ = 2 * span / (size - 1);
        farthest_ = static_cast<int>((size - 1) / 2);
        lowest_ = as_cpfg_ ? 0 : -farthest_;
        highest_ = as_cpfg_ ? static_cast<int>(size) - 1 : farthest_;
        spread_ = file.number("shadow spread", 1, Range::between(0, 100));
        depth_ = static_cast<int>(file.whole("shadow depth", 6, Range::between(0, 1000)));
        weight_ = file.number("shadow weight", 0.58, Range::not_negative());
        dissipation_ = file.number("shadow dissipation", 6.9, Range::positive());
        randomness_ = file.number("light randomness", 0, Range::between(0, 1e6));
        bias_ = file.number("light vertical bias", 0, Range::between(-1e6, 1e6));
        radius_ = file.number("sample radius", 1.6, Range::positive());
        samples_ = RandomKey(context.seed, 0, Stream::process, 0x7368616479);
        cast({}, fields);
    }

    void advance(const WorldView&, Queries queries, Fields& fields) override {
        std::vector<glm::ivec3> casters;
        for (const Query& query : queries) {
            if (!(query.parameters[0] > 0)) continue;
            const glm::dvec3 index = query.pose.position / voxel_;
            glm::dvec3 place = glm::round(index);
            if (as_cpfg_) place.y = std::trunc(index.y);
            if (std::max(std::abs(place.x), std::abs(place.z)) > farthest_) continue;
            if (place.y < lowest_ || place.y > highest_) continue;
            casters.emplace_back(place);
        }
        // The product of many shadows is the same in any order of queries.
        std::sort(casters.begin(), casters.end(), [](const glm::ivec3& a, const glm::ivec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        cast(casters, fields);
    }

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        for_in_parallel(tbb::blocked_range<std::size_t>(0, queries.size(), 256), [&](const auto& some) {
            const VoxelReader light(light_);
            for (std::size_t i = some.begin(); i < some.end(); ++i) {
                answer_one(light, queries[i], static_cast<std::uint32_t>(world.step), answers[i]);
            }
        });
        statistics_.sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::reach; }
    Box reach(const Query& query) const override {
        if (!(query.parameters[0] > 0)) return {};
        // Its voxel is up to one away, light is sampled between voxels, and the gradient's samples lie aside.
        const double aside = radius_ + 3 * voxel_;
        const double wide = reach(std::max(depth_ - 1, 0)) * voxel_ + aside;
        const glm::dvec3& at = query.pose.position;
        return {at - glm::dvec3(wide, depth_ * voxel_ + aside, wide), at + glm::dvec3(wide, aside, wide)};
    }

    ProcessMemory memory() const override { return {2 * bytes_held(*light_), true}; }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

private:
    void cast(const std::vector<glm::ivec3>& casters, Fields& fields) {
        const double widest = 2 * std::floor(spread_ * std::max(depth_ - 1, 0)) + 1;
        const double side = 2.0 * farthest_ + 1;
        const double voxels =
            std::min(static_cast<double>(casters.size()) * widest * widest * depth_, side * side * side);
        if (voxels * sizeof(float) * 2 > static_cast<double>(memory_)) {
            throw RunError(fmt::format("{} shadows of {} layers need up to {:.3g} voxels, more than memory allows",
                                       casters.size(), depth_, voxels));
        }
        VoxelValues light(voxel_, glm::dvec3(-0.5 * voxel_), 1);
        if (pyramid_.empty() && !casters.empty()) pyramid_ = pyramid();
        for (const glm::ivec3& caster : casters) {
            const float* left = pyramid_.data();
            for (int layer = 0; layer < depth_ && caster.y - layer >= lowest_; ++layer) {
                cast_layer(light, caster, layer, left);
                left += std::size_t(reach(layer) + 1) * std::size_t(reach(layer) + 1);
            }
        }
        light_ = light.grid();
        fields.provide({name_, "1", "part of the light that the shadows leave", light_, true});
    }

    /// What each voxel of a pyramid leaves, layer after layer; of every layer the quarter with x and z of 0 or more,
    /// and no more than can lie in the grid.
    std::vector<float> pyramid() const {
        std::vector<float> left;
        for (int layer = 0; layer < std::min(depth_, 2 * farthest_ + 1); ++layer) {
            for (int x = 0; x <= reach(layer); ++x) {
                for (int z = 0; z <= reach(layer); ++z) {
                    const double away = std::sqrt(double(x) * x + double(layer) * layer + double(z) * z);
                    left.push_back(static_cast<float>(1 - std::min(1.0, weight_ * math::pow(dissipation_, -away))));
                }
            }
        }
        return left;
    }

    int reach(int layer) const { return std::min(static_cast<int>(spread_ * layer), 2 * farthest_); }

    // Row by row. `left` stands at the layer's quarter.
    void cast_layer(VoxelValues& light, const glm::ivec3& caster, int layer, const float* left) const {
        const int half = reach(layer), y = caster.y - layer;
        const int last = std::min(caster.z + half, farthest_);
        for (int x = std::max(caster.x - half, -farthest_); x <= std::min(caster.x + half, farthest_); ++x) {
            const float* row = left + std::size_t(std::abs(x - caster.x)) * std::size_t(half + 1);
            for (int z = std::max(caster.z - half, -farthest_); z <= last;) {
                for (float& value : light.row({x, y, z}, last - z + 1)) value *= row[std::abs(z++ - caster.z)];
            }
        }
    }

    double light_at(const VoxelReader& light, const glm::dvec3& place) const {
        const glm::dvec3 index = place / voxel_;
        if (std::max(std::abs(index.x), std::abs(index.z)) > farthest_ + 1) return 1;
        if (index.y < lowest_ - 1 || index.y > highest_ + 1) return 1;
        return light.between(index);
    }

    void answer_one(const VoxelReader& light, const Query& query, std::uint32_t step, Answer answer) const {
        const glm::dvec3& place = query.pose.position;
        answer[0] = light_at(light, place);
        if (answer.size() < 4) return;
        RandomSamples samples(samples_, mix(query.identity, query.plant), step);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 reach(0);
            reach[axis] = radius_;
            const double rise = light_at(light, place + reach) - light_at(light, place - reach);
            const double chance = randomness_ > 0 ? randomness_ * (2 * samples.uniform() - 1) : 0;
            answer[static_cast<std::size_t>(axis) + 1] =
                (as_cpfg_ ? rise : rise / (2 * radius_)) + chance + (axis == 1 ? bias_ : 0);
        }
    }

    std::string name_;
    std::size_t memory_;
    double voxel_, spread_, weight_, dissipation_, randomness_, bias_, radius_;
    bool as_cpfg_;
    int farthest_, lowest_, highest_;  ///< voxel in x and z from the middle, in y
    int depth_;
    RandomKey samples_;
    std::vector<float> pyramid_;
    std::shared_ptr<const FieldGrid> light_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"shadowpyramid", "light under shadow pyramids that multiply (Palubicki et al. 2009, as in the program of cpfg)",
     R"(Every query with p > 0 casts a pyramid on its own voxel and the layers below: in layer i = 0 ... depth - 1, a square of
half-width floor(spread i) voxels, each multiplied by 1 - min(1, weight * dissipation^-d), d its distance in voxels.

?name(p)          -> light, 1 without shade. A query is also shaded by its own shadow
?name(p, x, y, z) -> light, and its gradient per metre by differences over the sample radius, not normalised
Further parameters (at most 20 in all) keep their values.

grid_size           201, 2 to 1e6; n: voxels along each side; the middle one contains the origin
grid_span           200 m, > 0; X: the grid reaches from -X to X, so that a voxel is 2 X / (n - 1) wide
shadow_spread       1, 0 to 100; increase of a pyramid's half-width in each layer, in voxels
shadow_depth        6, 0 to 1000; layers of a pyramid
shadow_weight       0.58, >= 0; shadow at distance 0
shadow_dissipation  6.9, > 0; a shadow is so many times weaker in each voxel of distance
sample_radius       1.6 m, > 0; distance of the places whose light makes the gradient
light_vertical_bias  0, -1e6 to 1e6; is added to the y of the gradient
light_randomness    0, 0 to 1e6; each component of the gradient is changed at random by up to this
parameters          none; a file with these keys in words, as cpfg's program shadowpyramid reads it
verbose             accepted and ignored: the messages of cpfg's program
numbers             "exact", or "cpfg"; cpfg (the default with `parameters` and in .e files): the grid reaches from 0 to
                    2 X in y, a caster's height in voxels is cut off instead of rounded, and the gradient is the
                    difference of the light over the two sample radii, not per metre. Full light
                    below the grid is assumed: within the sample radius above its lower border, the y of the gradient
                    differs from that of cpfg's program

Outside the grid is full light. Field: name (the light). Statistics of a plant: mean, min, max of the light, queries.
)",
     construct<ShadowPyramid>, true}};

}  // namespace
}  // namespace espalier::environment
