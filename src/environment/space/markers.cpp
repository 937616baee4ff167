// markers: attraction points that the nodes of plants compete for: space colonization.
// Runions, Lane & Prusinkiewicz 2007, Modeling trees with a space colonization algorithm, section 2; angle of
// perception: Palubicki et al. 2009, Self-organizing tree models for image synthesis, section 4.1; kill distance over
// time: Brzoska 2019, Interaktive Pflanzenmodellierung, eq. 17.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "environment/exchange/covering.h"
#include "environment/space/markers/cloud.h"
#include "environment/space/markers/colonization.h"
#include "environment/space/markers/end_of_growth.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

/// A number, or from `begin` to `end` in `steps` steps along the middle part of a sigmoid.
class KillDistance {
public:
    KillDistance(const Settings& settings, double influence) {
        if (!settings.is_table("kill")) {
            begin_ = end_ = distance(settings, "kill", influence);
            return;
        }
        const Settings table = settings.table("kill");
        begin_ = distance(table, "begin", influence);
        end_ = distance(table, "end", influence);
        steps_ = static_cast<int>(table.integer("steps", Range::between(2, 1e6)));
        table.reject_unread();
    }

    double at(int step) const {
        if (begin_ == end_) return begin_;
        const double x = -8 + 16.0 / (steps_ - 1) * std::min(step, steps_ - 1);
        return begin_ - (begin_ - end_) / (1 + math::exp(-x));
    }

private:
    static double distance(const Settings& table, const char* key, double influence) {
        const double value = table.number(key, Range::positive());
        if (value <= influence) return value;
        throw UserError(table.place(key),
                        fmt::format("'{}' ({:g} m) must be at most 'influence' ({:g} m): points would "
                                    "go before they attract a node",
                                    key, value, influence));
    }

    double begin_ = 1, end_ = 1;
    int steps_ = 2;
};

ColonizationRules read_rules(const Settings& settings) {
    ColonizationRules rules;
    if (settings.has("influence")) rules.influence = settings.number("influence", Range::positive());
    const double perception = settings.number_or("perception", 360, {0, 360, true});
    rules.cosine = perception < 360 ? math::cos(glm::radians(perception / 2)) : -1;
    rules.perceived = settings.choice_or("contest", "nearest", {"nearest", "perceived"}) == "perceived";
    return rules;
}

class Markers final : public EnvironmentProcess {
public:
    Markers(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name),
          place_(settings.place()),
          place_of_influence_(settings.place("influence")),
          rules_(read_rules(settings)),
          kill_(settings, rules_.influence),
          tropism_(settings.vector_or("tropism", {0, 0, 0}) * settings.vector_or("weight", {1, 1, 1})),
          voxel_(read_voxel(settings, std::isfinite(rules_.influence) ? rules_.influence / 2 : 1)),
          points_(read_clouds(settings, context, context.memory / Colonization::bytes_per_point), rules_),
          won_(context.plants, 0),
          warnings_(context.warnings) {
        fields.provide({name_, "1", "attraction points left in a voxel", nullptr, true, [this] { return grid(); }});
    }

    void advance(const WorldView& world, Queries queries, Fields&) override {
        std::vector<ColonizingNode> nodes;
        nodes.reserve(queries.size());
        for (const Query& query : queries) {
            const std::uint64_t key = query.identity == 0 ? nodes.size() : mix(query.identity, query.plant);
            nodes.push_back({key, query.pose.position, query.pose.heading, !(query.parameters[0] < 0)});
        }
        points_.set_nodes(std::move(nodes));
        points_.remove_within(kill_.at(world.step));
    }

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        tell_the_end();
        std::fill(won_.begin(), won_.end(), 0);
        const std::vector<Colonization::Won> won = points_.won();
        winners_ = in_reach_ = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            in_reach_ += won[i].count;
            if (!(answers[i][0] < 0)) answers[i][0] = answer(won[i], answers[i]);
            if (answers[i][0] <= 0) continue;
            ++winners_;
            if (queries[i].plant < won_.size()) won_[queries[i].plant] += answers[i][0];
        }
        if (!queries.empty() && winners_ == 0 && !ended_) ended_ = world.step;
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return {{"won", plant < won_.size() ? won_[plant] : 0},
                {"left", static_cast<double>(points_.left())},
                {"in_reach", static_cast<double>(in_reach_)},
                {"winners", static_cast<double>(winners_)}};
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::queries; }

    ProcessMemory memory() const override { return {points_.points().size() * Colonization::bytes_per_point}; }

    void save(std::ostream& out) const override { points_.save(out); }
    void restore(std::istream& in) override { points_.restore(in); }

private:
    /// The number of points won, and the direction into the parameters behind it. Pulls that cancel each other, or pull
    /// where they pulled before, so that a node stands there already, count for none.
    double answer(const Colonization::Won& won, Answer answer) const {
        if (won.count == 0 || glm::length(won.sum) < 1e-9 * won.count) return 0;
        const glm::dvec3 pull = glm::normalize(won.sum) + tropism_;
        if (glm::length(pull) < 1e-9) return 0;
        const glm::dvec3 direction = glm::normalize(pull);
        if (answer.size() < 4) return won.count;
        const glm::dvec3 before(answer[1], answer[2], answer[3]);
        if (glm::distance(before, direction) < 1e-6) return 0;
        for (int k = 0; k < 3; ++k) answer[1 + k] = direction[k];
        return won.count;
    }

    // In the step behind: where the run ends with the growth, there is nothing to tell.
    void tell_the_end() {
        if (!ended_ || !warnings_) return;
        Place place = place_;
        std::string what = fmt::format("the points of '{}' pull every node where it has grown already", name_), remedy;
        if (points_.left() == 0) {
            what = fmt::format("no point of '{}' is left", name_);
            remedy = "a larger or denser cloud, or fewer steps";
        } else if (in_reach_ == 0) {
            place = place_of_influence_;
            what = fmt::format("none of the {} points left of '{}' is in the reach of a node", points_.left(), name_);
            remedy = "another seed, a larger 'influence', a denser cloud, or one that is nearer to the plant";
        }
        warnings_->push_back({Diagnostic::Severity::warning, place, end_of_growth(*ended_, what, remedy), ""});
        warnings_ = nullptr;
    }

    std::shared_ptr<const FieldGrid> grid() const {
        VoxelValues left(voxel_, {0, 0, 0});
        for (std::size_t i = 0; i < points_.points().size(); ++i) {
            // All points, so that a viewer is shown the same box in every step.
            left.add(voxel_at(points_.points()[i], voxel_), points_.is_left(i) ? 1.0f : 0.0f);
        }
        return left.grid();
    }

    std::string name_;
    Place place_, place_of_influence_;
    std::optional<int> ended_;  ///< the step in which no node won a point
    ColonizationRules rules_;
    KillDistance kill_;
    glm::dvec3 tropism_;
    double voxel_;
    Colonization points_;
    std::vector<double> won_;
    std::size_t winners_ = 0, in_reach_ = 0;
    std::vector<Diagnostic>* warnings_;  ///< null as soon as the end of growth has been told
};

const std::string& help() {
    static const std::string text =
        std::string(R"(?name(n)                 -> n: how many attraction points the node has won; 0: none
?name(n, x, y, z)        -> and the direction of growth, a unit vector, if n > 0; else x, y, z keep their values
A query with n < 0 takes space and wins nothing. Further parameters (at most 20 in all) keep their values.

In each step, points within the kill distance of a node are removed. Then every point is won by the nearest of all nodes
of all plants, if that is within `influence` and sees the point in its angle of perception. A node's direction is the
mean of the unit vectors to its points, plus the tropism. Grow a node of its own in that direction: @R(x, y, z) F(D).
A node whose direction is the one it was last answered wins nothing, because it has grown there.

influence  none, m, > 0; points attract no nodes that are farther away; none: all attract
kill       required, m, > 0; points nearer to a node are removed; at most `influence`. { begin, end, steps }: it changes
           from begin to end along a sigmoid in so many steps (2 to 1e6)
perception  360 degrees, > 0, <= 360; the full angle of a cone about the turtle's heading; points outside do not attract
contest    "nearest", or "perceived"; nearest: a point belongs to the nearest node, whether or not that perceives it;
           perceived: to the nearest of the nodes that perceive it
tropism    [0, 0, 0]; is added to the mean direction, whose length is 1
weight     [1, 1, 1]; factors of the tropism's components
voxel      half of the influence, m, >= 1.5e-5; edge of a voxel of the field, which counts the points left
)") + cloud_help +
        R"(
Statistics: won (points, of the plant); left, in_reach (points) and winners (nodes) of the whole world.
A run tells when growth has ended, and why: no point is left, or none is in reach.
)";
    return text;
}

const Registered<ProcessType> entry{
    {"markers", "attraction points that nodes compete for: space colonization (Runions et al. 2007)", help(),
     construct<Markers>}};

}  // namespace
}  // namespace espalier::environment
