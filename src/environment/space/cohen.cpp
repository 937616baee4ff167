// cohen: tips turn away from dense places and branch where there is room; attractors and inhibitors bend them.
// Cohen 1967, Computer simulation of biological pattern generation processes: growth at the tips, its direction from
// the present one, a field of density, the gradient of that and the resistance to turning; branching at random, by the
// distance from the last fork and the density. The paper gives the rules; the functions below are ours.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/changing_settings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <tuple>

namespace espalier::environment {
namespace {

/// What makes its surroundings dense, or less dense if its weight is negative.
struct DensePlace {
    glm::dvec3 place;
    double weight;
};

/// The density at a place and how it rises there, per `reach`.
struct DensityThere {
    double value = 0;
    glm::dvec3 rise{0};
};

std::vector<DensePlace> dense_places(const Settings& settings, const char* key, double weight) {
    std::vector<DensePlace> places;
    if (!settings.has(key)) return places;
    for (const glm::dvec3& place : settings.vectors(key)) places.push_back({place, weight});
    return places;
}

class Cohen final : public EnvironmentProcess {
public:
    Cohen(Settings& settings, const EnvironmentContext& context, Fields&)
        : reach_(settings.number_or("reach", 0.1, Range::positive())),
          resistance_(settings.number_or("resistance", 1, Range::not_negative())),
          tropism_(settings.vector_or("tropism", {0, 0, 0})),
          branching_(settings.number_or("branching", 0.2, Range::between(0, 1))),
          fork_distance_(settings.number_or("fork_distance", 0, Range::not_negative())),
          fork_rise_(settings.number_or("fork_rise", 0, Range::not_negative())),
          crowding_(settings.number_or("crowding", 2, Range::positive())),
          tip_weight_(settings.number_or("tip_weight", 1, Range::not_negative())),
          statistics_(context.plants) {
        const double attraction = settings.number_or("attraction", 5, Range::not_negative());
        const double inhibition = settings.number_or("inhibition", 5, Range::not_negative());
        sources_ = dense_places(settings, "attractors", -attraction);
        const std::vector<DensePlace> inhibitors = dense_places(settings, "inhibitors", inhibition);
        sources_.insert(sources_.end(), inhibitors.begin(), inhibitors.end());
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        matter_.clear();
        for (const Query& query : queries) {
            matter_.push_back({query.pose.position, is_tip(query) ? tip_weight_ : query.parameters[0]});
        }
        // Sums in an order of their own do not depend on the order of the queries.
        std::sort(matter_.begin(), matter_.end(), [](const DensePlace& a, const DensePlace& b) {
            return std::tie(a.place.x, a.place.y, a.place.z, a.weight) <
                   std::tie(b.place.x, b.place.y, b.place.z, b.weight);
        });
        for_in_parallel(std::size_t{0}, queries.size(), [&](std::size_t i) {
            if (is_tip(queries[i])) answer_tip(queries[i].pose, answers[i]);
        });
        statistics_.clear();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (is_tip(queries[i])) statistics_.add(queries[i].plant, answers[i][0]);
        }
    }

    std::vector<ChangingSetting> changing_settings() override {
        return {changing("reach", Range::positive(), reach_),
                changing("resistance", Range::not_negative(), resistance_),
                changing("branching", Range::between(0, 1), branching_),
                changing("fork_distance", Range::not_negative(), fork_distance_),
                changing("fork_rise", Range::not_negative(), fork_rise_),
                changing("crowding", Range::positive(), crowding_),
                changing("tip_weight", Range::not_negative(), tip_weight_)};
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

private:
    static bool is_tip(const Query& query) { return query.parameters.size() >= 4; }

    void answer_tip(const Pose& pose, Answer answer) const {
        const DensityThere density = density_at(pose.position);
        const glm::dvec3 sum = resistance_ * pose.heading - density.rise + tropism_;
        // Pulls that cancel each other leave the heading as it is.
        const glm::dvec3 direction = glm::length(sum) > 1e-9 ? glm::normalize(sum) : pose.heading;
        answer[0] = density.value;
        for (int k = 0; k < 3; ++k) answer[1 + k] = direction[k];
        if (answer.size() >= 5) answer[4] = probability_of_fork(answer[4], density.value);
    }

    /// Returns the density of all but one tip at that very place, which has no gradient of its own.
    DensityThere density_at(const glm::dvec3& place) const {
        DensityThere density{-tip_weight_};
        for (const DensePlace& other : matter_) {
            const glm::dvec3 away = (place - other.place) / reach_;
            const double falls = 1 / (1 + glm::dot(away, away));
            density.value += other.weight * falls;
            density.rise -= 2 * other.weight * falls * falls * away;
        }
        for (const DensePlace& source : sources_) {
            const glm::dvec3 away = (place - source.place) / reach_;
            const double apart = glm::length(away);
            density.value += source.weight / (1 + apart);
            if (apart > 0) density.rise -= source.weight / ((1 + apart) * (1 + apart)) * away / apart;
        }
        return density;
    }

    double probability_of_fork(double since_fork, double density) const {
        if (since_fork < fork_distance_) return 0;
        const double risen = fork_rise_ > 0 ? std::min(1.0, (since_fork - fork_distance_) / fork_rise_) : 1;
        return branching_ * risen * math::exp(-std::max(density, 0.0) / crowding_);
    }

    double reach_, resistance_;
    glm::dvec3 tropism_;
    double branching_, fork_distance_, fork_rise_, crowding_, tip_weight_;
    std::vector<DensePlace> sources_;
    std::vector<DensePlace> matter_;  ///< matter of this step
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"cohen", "growth away from dense places, attractors and inhibitors, forks by density (Cohen 1967)",
     R"(The density at a place is the sum of w / (1 + r^2) over all other queries, of s / (1 + r) over the
inhibitors and of -s / (1 + r) over the attractors; r is the distance divided by `reach`.

?name(d, x, y, z)    -> a tip; d: the density; x, y, z: the unit vector in which to grow: the tip's heading times
                        `resistance`, minus the gradient of the density per `reach`, plus `tropism`
?name(d, x, y, z, b) -> and b: from the distance along the axis since the last fork (m), the probability of a fork:
                        0 if b < fork_distance; else branching * min(1, (b - fork_distance) / fork_rise)
                        * exp(-max(d, 0) / crowding)
?name(w)                has the weight w, and keeps its value: an internode, or what has ended
Queries with two or three parameters are such, too; parameters after the fifth (at most 20 in all) keep their values.

reach          0.1 m, > 0; distance at which the density of a query has fallen to a half
resistance     1, >= 0; how much a tip keeps its direction; 0: it follows the field only
tropism        [0, 0, 0]; is added to the direction of growth
branching      0.2, 0 to 1; probability of a fork in the empty field
fork_distance  0 m, >= 0; least distance between two forks of an axis
fork_rise      0 m, >= 0; distance over which the probability of a fork rises to `branching`
tip_weight     1, >= 0; w of a tip
crowding       2, > 0; density that divides the probability of a fork by e
attractors     none, m; [[x, y, z], ...]: places that tips grow to
inhibitors     none, m; [[x, y, z], ...]: places that tips avoid
attraction     5, >= 0; strength s of the attractors
inhibition     5, >= 0; strength s of the inhibitors

Time grows with the number of tips times the number of queries. Statistics of a plant: mean, min, max of d, queries (tips).
)",
     construct<Cohen>}};

}  // namespace
}  // namespace espalier::environment
