// density3d: sums everything that was ever added to each voxel of a box.
// After Greene 1989, Voxel space automata: modeling with stochastic growth processes in voxel space.
#include "espalier/base/stop.h"
#include "espalier/environment/environment_process.h"

#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/parameter_file.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <istream>
#include <map>
#include <optional>
#include <ostream>

namespace espalier::environment {
namespace {

class Density3d final : public EnvironmentProcess {
public:
    Density3d(Settings& settings, const EnvironmentContext& context, Fields&)
        : memory_(context.memory), statistics_(context.plants) {
        ParameterFile file(settings, context, {"range", "position", "grid size", "octree level"});
        whole_ = file.has_numbers_of_cpfg();
        const std::vector<double> range = file.numbers("range", {1, 1, 1}, Range::positive());
        const std::vector<double> lower = file.numbers("position", {0, 0, 0}, Range::between(-1e100, 1e100));
        const auto level = static_cast<int>(file.whole("octree level", 0, Range::between(0, 20)));
        const double cells = std::ldexp(1.0, level);
        const std::vector<double> size = file.numbers("grid size", {cells, cells, cells}, Range::between(1, 1 << 20));
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            lower_[axis] = lower[i];
            range_[axis] = range[i];
            size_[axis] = std::floor(size[i]);
        }
    }

    // One after the other, in string order: each finds what those before it left.
    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        StopCheck<4096> check_stop;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            check_stop();
            const std::optional<std::uint64_t> voxel = voxel_of(queries[i].pose.position);
            answers[i][0] = voxel ? add(*voxel, queries[i].parameters[0]) : 0;
        }
        total_ = 0;
        for (const auto& voxel : amounts_) total_ += voxel.second;
        if (amounts_.size() > memory_ / bytes_per_voxel)
            throw RunError("so many voxels are occupied that memory would run out");
        statistics_.sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        std::vector<Quantity> all = statistics_.quantities(plant);
        all.push_back({"total", total_});
        return all;
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

    ProcessMemory memory() const override { return {amounts_.size() * bytes_per_voxel, true}; }
    void limit_memory(std::size_t bytes) override { memory_ = bytes; }

    void save(std::ostream& out) const override {
        for (const auto& [voxel, amount] : amounts_) {
            out.write(reinterpret_cast<const char*>(&voxel), sizeof voxel);
            out.write(reinterpret_cast<const char*>(&amount), sizeof amount);
        }
    }

    void restore(std::istream& in) override {
        amounts_.clear();
        total_ = 0;
        std::uint64_t voxel = 0;
        double amount = 0;
        while (in.read(reinterpret_cast<char*>(&voxel), sizeof voxel)) {
            if (!in.read(reinterpret_cast<char*>(&amount), sizeof amount)) throw UserError("the checkpoint is damaged");
            amounts_[voxel] = amount;
            total_ += amount;
        }
    }

private:
    static constexpr std::size_t bytes_per_voxel = 64;

    double add(std::uint64_t voxel, double value) {
        double& amount = amounts_[voxel];
        amount += value;
        if (whole_) amount = std::trunc(amount);
        return amount;
    }

    std::optional<std::uint64_t> voxel_of(const glm::dvec3& place) const {
        std::uint64_t number = 0;
        for (int axis = 2; axis >= 0; --axis) {
            const double part = (place[axis] - lower_[axis]) / range_[axis];
            if (!(part >= 0 && part < 1)) return std::nullopt;
            const double index = std::min(std::floor(part * size_[axis]), size_[axis] - 1);
            number = number * static_cast<std::uint64_t>(size_[axis]) + static_cast<std::uint64_t>(index);
        }
        return number;
    }

    glm::dvec3 lower_{0}, range_{1}, size_{1};
    bool whole_;  ///< sums have no fractions
    std::size_t memory_;
    std::map<std::uint64_t, double> amounts_;  ///< amounts in the voxels that were ever asked
    double total_ = 0;                         ///< sum of all amounts
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"density3d", "sums everything that was ever added to each voxel of a box (after Greene 1989)",
     R"(?name(v) -> v is added to the voxel, and the answer is the sum of all that was added; 0 outside the box
Further parameters (at most 20 in all) keep their values.

Queries are answered one after the other in string order, and each sees the effect of those before it.
Sums are kept from step to step.

range         [1, 1, 1] m, > 0; size of the box
position      [0, 0, 0] m; lower corner of the box
grid_size     [1, 1, 1], >= 1; voxels along each side
octree_level  0, 0 to 20; 2^level voxels along each side, where no grid_size is given
parameters    none; a file with these keys in words, as cpfg's program density3d reads it
verbose       accepted and ignored: the messages of cpfg's program
numbers       "exact", or "cpfg"; cpfg (the default with `parameters` and in .e files): after each query, the fraction
              of the voxel's sum is cut off

Statistics of a plant: mean, min, max of the answers, queries; total, the sum over the box.
)",
     construct<Density3d>, true}};

}  // namespace
}  // namespace espalier::environment
