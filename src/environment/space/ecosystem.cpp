// ecosystem: plants are discs on the ground, and where two overlap one loses.
// Self-thinning as in Deussen, Hanrahan, Lintermann, Mech, Pharr & Prusinkiewicz 1998, Realistic modeling and rendering
// of plant ecosystems, section 4.
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/answer_statistics.h"
#include "environment/exchange/parameter_file.h"
#include "environment/space/neighbours/point_grid.h"
#include "environment/space/neighbours/reach.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {
namespace {

/// One point grid per size, doubling from each to the next, so that one large disc does not make all cells large.
class DiscOverlap {
public:
    DiscOverlap(std::span<const glm::dvec3> centres, std::span<const double> radii);

    /// Calls visit(other) for the discs that overlap disc `i` (distance <= sum of the radii) and are at least of the
    /// size class of `smallest`, until it returns false. False if it did. Not for `i` itself.
    template <class Visit>
    bool visit_overlapping(std::uint32_t i, double smallest, const Visit& visit) const {
        for (auto level = levels_.rbegin(); level != levels_.rend() && level->largest >= smallest; ++level) {
            const bool goes_on = level->grid.visit_around(centres_[i], radii_[i] + level->largest, [&](auto other) {
                const bool apart = glm::distance(centres_[other], centres_[i]) > radii_[other] + radii_[i];
                return other == i || apart || visit(other);
            });
            if (!goes_on) return false;
        }
        return true;
    }

private:
    struct Level {
        double largest;  ///< radius
        PointGrid grid;
    };

    std::span<const glm::dvec3> centres_;
    std::span<const double> radii_;
    std::vector<Level> levels_;  ///< the smallest discs first
};

DiscOverlap::DiscOverlap(std::span<const glm::dvec3> centres, std::span<const double> radii)
    : centres_(centres), radii_(radii) {
    double largest = 0;
    for (const double radius : radii) largest = std::max(largest, radius);
    // Below a millionth of the largest all are small alike.
    const int lowest = largest > 0 ? std::ilogb(largest) - 20 : 0;
    std::map<int, std::vector<std::uint32_t>> classes;
    for (std::uint32_t i = 0; i < radii.size(); ++i) {
        classes[radii[i] > 0 ? std::max(std::ilogb(radii[i]), lowest) : lowest].push_back(i);
    }
    for (auto& [size, members] : classes) {
        const double end = std::ldexp(1.0, size + 1);
        std::stable_sort(members.begin(), members.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return radii[a] > radii[b]; });
        levels_.push_back({largest > 0 ? end : 0, PointGrid(centres, members, end)});
    }
}

class Ecosystem final : public EnvironmentProcess {
public:
    Ecosystem(Settings& settings, const EnvironmentContext& context, Fields&) : statistics_(context.plants) {
        ParameterFile file(settings, context, {"grid size", "3d case", "vigor"});
        file.numbers("grid size", {1, 1, 1}, Range::between(1, 1e9));  // the search here needs no grid
        flat_ = !file.flag("3d case", false, {"on", "1"});
        by_vigour_ = file.flag("vigor", false, {"on", "yes"}, {"off", "no"});
        const char* usual = file.has_file() ? "string" : "vigour";
        in_string_order_ = settings.choice_or("scan", usual, {"vigour", "string"}) == "string";
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        centres_.clear();
        radii_.clear();
        second_.clear();
        for (const Query& query : queries) {
            const glm::dvec3& place = query.pose.position;
            centres_.emplace_back(place.x, flat_ ? 0 : place.y, place.z);
            radii_.push_back(query.parameters[0]);
            second_.push_back(query.parameters.size() > 1 ? query.parameters[1] : 0);
        }
        wins_.assign(queries.size(), 1);
        const DiscOverlap discs(centres_, radii_);
        if (!by_vigour_) {
            compare_sizes(discs);
        } else if (in_string_order_) {
            scan_string(discs);
        } else {
            scan_by_vigour(discs);
        }
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i][0] = wins_[i];
        statistics_.sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        return statistics_.counts(plant, "winners", "losers");
    }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    // With vigour, a disc that falls spares others, which may then eliminate those behind them, and so on.
    Spreading spreading() const override { return by_vigour_ ? Spreading::queries : Spreading::reach; }
    // Only discs of at most its size lose against it.
    Box reach(const Query& query) const override {
        const double wide = beyond_rounding * 2 * query.parameters[0];
        return box_around(query.pose.position, {wide, flat_ ? everywhere : wide, wide});
    }

private:
    // Without vigour: of two that overlap in one group the smaller loses, and two of one size both do.
    void compare_sizes(const DiscOverlap& discs) {
        for_in_parallel(std::size_t{0}, centres_.size(), [&](std::size_t k) {
            const auto i = static_cast<std::uint32_t>(k);
            wins_[i] = discs.visit_overlapping(i, radii_[i], [&](std::uint32_t other) {
                return second_[other] != second_[i] || radii_[other] < radii_[i];
            });
        });
    }

    bool yields(std::uint32_t i, std::uint32_t other) const {
        return second_[i] < second_[other] || (second_[i] == second_[other] && radii_[i] <= radii_[other]);
    }

    // The rule of cpfg's program: one after the other in string order; a disc that has lost eliminates none.
    void scan_string(const DiscOverlap& discs) {
        for (std::uint32_t i = 0; i < centres_.size(); ++i) {
            wins_[i] =
                discs.visit_overlapping(i, 0, [&](std::uint32_t other) { return !wins_[other] || !yields(i, other); });
        }
    }

    // The most vigorous first, so that only survivors eliminate others. Ties eliminate both.
    void scan_by_vigour(const DiscOverlap& discs) {
        std::vector<std::uint32_t> order(centres_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return !yields(a, b); });
        std::vector<char> judged(order.size(), 0);
        for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
            while (end < order.size() && yields(order[begin], order[end])) ++end;
            for (const std::uint32_t i : std::span(order).subspan(begin, end - begin)) {
                wins_[i] = discs.visit_overlapping(
                    i, 0, [&](std::uint32_t other) { return !(judged[other] && wins_[other]); });
            }
            std::vector<std::uint32_t> losers;
            for (const std::uint32_t i : std::span(order).subspan(begin, end - begin)) {
                const auto ends = [&](std::uint32_t other) {
                    return !judged[other] && wins_[other] && yields(i, other) && yields(other, i);
                };
                const bool stays =
                    wins_[i] && discs.visit_overlapping(i, 0, [&](std::uint32_t other) { return !ends(other); });
                if (!stays) losers.push_back(i);
            }
            for (const std::uint32_t i : losers) wins_[i] = 0;
            for (const std::uint32_t i : std::span(order).subspan(begin, end - begin)) judged[i] = 1;
        }
    }

    bool flat_, by_vigour_, in_string_order_;
    std::vector<glm::dvec3> centres_;
    std::vector<double> radii_, second_;
    std::vector<char> wins_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"ecosystem", "plants as discs; where two overlap, the smaller or weaker loses (Deussen et al. 1998)",
     R"(?name(radius)         -> 1, or 0 if the disc loses; two overlap at a distance up to the sum of their radii
?name(radius, group)  -> the same among the queries of this group only; without a group it is 0
?name(radius, vigour) -> if `vigor` is on: the disc with less vigour loses; of equals, the smaller
Further parameters (at most 20 in all) keep their values.

vigor     false; the second parameter is a group; true: it is a vigour
scan      "vigour", or "string"; with vigour, a disc that has lost no longer eliminates others, so the order matters.
          vigour: the most vigorous first; ties eliminate both. Independent of the order of the queries.
          string (the default with `parameters`): in string order; of two equals the later remains, as in cpfg
3d_case   false; heights are ignored, positions are compared by x and z; true: balls in space
grid_size   [1, 1, 1]; accepted and ignored: the search needs no grid
verbose     accepted and ignored: the messages of cpfg's program
parameters  none; a file with `vigor: on`, `3d case: on`, `grid size: n n n`, as cpfg's program ecosystem reads it

Without vigour two of equal radius that overlap both get 0.
Statistics of a plant: winners and losers, the number of answers 1 and 0.
)",
     construct<Ecosystem>}};

}  // namespace
}  // namespace espalier::environment
