// honda81: a branch ends where another of at least its vigour stands too near.
// Honda, Tomlinson & Fisher 1981, Computer simulation of branch interaction and regulation by unequal flow rates in
// botanical trees.
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/neighbours/point_grid.h"
#include "environment/neighbours/reach.h"
#include "environment/parameter_file.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace espalier::environment {
namespace {

class Honda81 final : public EnvironmentProcess {
public:
    Honda81(Settings& settings, const EnvironmentContext& context, Fields&) : statistics_(context.plants) {
        ParameterFile file(settings, context, {"radius", "3d case"});
        radius_ = file.number("radius", 0, Range::not_negative());
        flat_ = !file.flag("3d case", false);
    }

    void answer(const WorldView&, std::span<const Query> queries, std::span<Answer> answers, Fields&) override {
        points_.clear();
        std::map<double, std::vector<std::uint32_t>> groups;
        for (std::uint32_t i = 0; i < queries.size(); ++i) {
            const glm::dvec3& place = queries[i].pose.position;
            points_.emplace_back(place.x, flat_ ? 0 : place.y, place.z);
            groups[queries[i].parameters.size() > 1 ? queries[i].parameters[1] : 0].push_back(i);
        }
        for (const auto& group : groups) answer_group(queries, group.second, answers);
        statistics_.sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return statistics_.counts(plant, "free", "dominated");
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::reach; }
    Box reach(const Query& query) const override {
        const double wide = beyond_rounding * radius_;
        return box_around(query.pose.position, {wide, flat_ ? everywhere : wide, wide});
    }

private:
    // Within a cell the most vigorous come first. Who is near one of them is dominated; the others keep a radius
    // between each other, so that they are few, and only they look around. The time is linear however the points crowd.
    void answer_group(std::span<const Query> queries, std::span<const std::uint32_t> group, std::span<Answer> answers) {
        PointGrid grid(points_, group, 2 * radius_);
        grid.sort_cells([&](std::uint32_t a, std::uint32_t b) { return vigour(queries[a]) > vigour(queries[b]); });
        for_in_parallel(tbb::blocked_range<std::size_t>(0, grid.size(), 256), [&](const auto& cells) {
            std::vector<std::uint32_t> apart;
            for (std::size_t cell = cells.begin(); cell < cells.end(); ++cell) {
                apart.clear();
                for (const std::uint32_t i : grid.members(cell)) {
                    answers[i][0] = 0;
                    if (std::none_of(apart.begin(), apart.end(), [&](auto other) { return is_near(i, other); })) {
                        apart.push_back(i);
                    }
                }
                for (const std::uint32_t i : apart) answers[i][0] = is_free(grid, queries, i) ? 1 : 0;
            }
        });
    }

    bool is_free(const PointGrid& grid, std::span<const Query> queries, std::uint32_t i) const {
        return grid.visit_around(points_[i], radius_, [&](std::uint32_t other) {
            return other == i || vigour(queries[other]) < vigour(queries[i]) || !is_near(i, other);
        });
    }

    bool is_near(std::uint32_t a, std::uint32_t b) const { return glm::distance(points_[a], points_[b]) <= radius_; }

    static double vigour(const Query& query) { return query.parameters[0]; }

    double radius_;
    bool flat_;
    std::vector<glm::dvec3> points_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"honda81", "branches end near others with the same or more vigour (Honda, Tomlinson & Fisher 1981)",
     R"(?name(vigour)        -> 0 if another query of the group with at least this vigour is within `radius`, else 1
?name(vigour, group) -> the same among the queries of this group only; without a group it is 0
Further parameters (at most 20 in all) keep their values.

radius      0 m, >= 0; greatest distance of a query that dominates. 0: only exactly the same position counts
3d_case     false; heights are ignored, positions are compared by x and z; true: in space
parameters  none; a file with `radius: r` and `3d case: on`, as cpfg's program honda81 reads it
verbose     accepted and ignored: the messages of cpfg's program

Two of equal vigour within the radius both get 0. Answers do not depend on the order of the queries.
Statistics of a plant: free and dominated, the number of answers 1 and 0.
)",
     construct<Honda81>}};

}  // namespace
}  // namespace espalier::environment
