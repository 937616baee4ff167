// honda81: a branch ends where another of at least its vigour stands too near.
// Honda, Tomlinson & Fisher 1981, Computer simulation of branch interaction and regulation by unequal flow rates in
// botanical trees.
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/parameter_file.h"
#include "environment/space/neighbours/point_grid.h"
#include "environment/space/neighbours/reach.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace espalier::environment {
namespace {

class Honda81 final : public EnvironmentProcess {
public:
    Honda81(Settings& settings, const EnvironmentContext& context, Fields&) : statistics_(context.plants) {
        ParameterFile file(settings, context, {"radius", "3d case"});
        radius_ = file.number("radius", 0, Range::not_negative());
        near_ = greatest_square(radius_);
        flat_ = !file.flag("3d case", false);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        read(queries);
        std::vector<std::uint32_t> tips(queries.size());
        std::iota(tips.begin(), tips.end(), 0U);
        const auto less = [&](std::uint32_t a, std::uint32_t b) { return groups_[a] < groups_[b]; };
        if (!std::is_sorted(tips.begin(), tips.end(), less)) std::stable_sort(tips.begin(), tips.end(), less);
        for (auto begin = tips.begin(); begin != tips.end();) {
            const auto end = std::upper_bound(begin, tips.end(), *begin, less);
            answer_group({&*begin, static_cast<std::size_t>(end - begin)}, answers);
            begin = end;
        }
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
    // The greatest number whose root, rounded, is at most `length`.
    static double greatest_square(double length) {
        constexpr double most = std::numeric_limits<double>::max();
        double square = std::min(length * length, most);
        while (std::sqrt(square) > length) square = std::nextafter(square, 0);
        while (square < most && std::sqrt(std::nextafter(square, most)) <= length) {
            square = std::nextafter(square, most);
        }
        return square;
    }

    // Queries are large, and each is compared with several others.
    void read(Queries queries) {
        points_.resize(queries.size());
        vigours_.resize(queries.size());
        groups_.resize(queries.size());
        for_in_parallel(tbb::blocked_range<std::size_t>(0, queries.size(), 1024), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const Query& query = queries[i];
                const glm::dvec3& place = query.pose.position;
                points_[i] = {place.x, flat_ ? 0 : place.y, place.z};
                vigours_[i] = query.parameters[0];
                groups_[i] = query.parameters.size() > 1 ? query.parameters[1] : 0;
            }
        });
    }

    // Within a cell the most vigorous come first. Who is near one of them is dominated; the others keep a radius
    // between each other, so that they are few, and only they look around. The time is linear however the points crowd.
    void answer_group(std::span<const std::uint32_t> group, std::span<Answer> answers) const {
        PointGrid grid(points_, group, 2 * radius_);
        grid.sort_cells([&](std::uint32_t a, std::uint32_t b) { return vigours_[a] > vigours_[b]; });
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
                for (const std::uint32_t i : apart) answers[i][0] = is_free(grid, cell, i) ? 1 : 0;
            }
        });
    }

    // Most cells around it are empty, which a processor foresees if its own, known already, is not among them.
    bool is_free(const PointGrid& grid, std::size_t cell, std::uint32_t i) const {
        const auto leaves_free = [&](std::uint32_t other) {
            const bool is_far = !is_near(i, other);
            return (other == i) | (vigours_[other] < vigours_[i]) | is_far;
        };
        const std::span<const std::uint32_t> beside = grid.members(cell);
        return std::all_of(beside.begin(), beside.end(), leaves_free) &&
               grid.visit_around_but(cell, points_[i], radius_, leaves_free);
    }

    bool is_near(std::uint32_t a, std::uint32_t b) const {
        const glm::dvec3 between = points_[a] - points_[b];
        return glm::dot(between, between) <= near_;
    }

    double radius_;
    double near_;  ///< square of a distance: what is more is too far
    bool flat_;
    // Of each query:
    std::vector<glm::dvec3> points_;
    std::vector<double> vigours_, groups_;
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
