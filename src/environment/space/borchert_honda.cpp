// borchert-honda: buds send what they have gathered to the base, and the resource that comes back favours one axis.
// The extended model of Borchert and Honda in Palubicki, Horel, Longay, Runions, Lane, Mech & Prusinkiewicz 2009,
// Self-organizing tree models for image synthesis, section 5.1; shedding: section 5.3.
#include "espalier/environment/environment_process.h"

#include "base/parallel.h"
#include "environment/exchange/changing_settings.h"

#include <algorithm>
#include <vector>

namespace espalier::environment {
namespace {

/// At a fork: what the rest of the axis has gathered, and the lateral.
struct Fork {
    double main = 0, lateral = 0;
};

class BorchertHonda final : public EnvironmentProcess {
public:
    BorchertHonda(Settings& settings, const EnvironmentContext& context, Fields&)
        : alpha_(settings.number_or("alpha", 2, Range::not_negative())),
          lambda_(settings.number_or("lambda", 0.5, Range::between(0, 1))),
          totals_(context.plants) {}

    void answer(const WorldView& world, Queries queries, std::span<Answer> answers, Fields&) override {
        totals_.assign(std::max(totals_.size(), world.plants.size()), {});
        for_in_parallel(std::size_t{0}, world.plants.size(), [&](std::size_t i) {
            const auto of_plant = [&](const Query& query) { return query.plant < i; };
            const auto first = std::partition_point(queries.begin(), queries.end(), of_plant);
            const auto end = std::partition_point(first, queries.end(), [&](const Query& q) { return q.plant == i; });
            const auto at = static_cast<std::size_t>(first - queries.begin());
            const auto count = static_cast<std::size_t>(end - first);
            answer_plant(world.plants[i], queries.subspan(at, count), answers.subspan(at, count), totals_[i]);
        });
    }

    std::vector<ChangingSetting> changing_settings() override {
        return {changing("alpha", Range::not_negative(), alpha_), changing("lambda", Range::between(0, 1), lambda_)};
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override {
        const Totals totals = plant < totals_.size() ? totals_[plant] : Totals();
        return {{"gathered", totals.gathered}, {"growing", totals.growing}};
    }

    std::pair<int, int> query_arity() const override { return {2, 20}; }
    Spreading spreading() const override { return Spreading::plants; }

private:
    struct Totals {
        double gathered = 0, growing = 0;
    };

    void answer_plant(const PlantView& plant, Queries queries, std::span<Answer> answers, Totals& totals) const {
        const ModuleString& string = *plant.string;
        std::vector<Fork> forks(string.size());
        totals.gathered = gather(string, queries, forks);
        const double given = alpha_ * totals.gathered;
        hand_out(string, queries, answers, forks, given);
        BranchLinks links;
        link_branches(string, links);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (queries[i].parameters[0] < 0) {
                gauge(plant, links, queries[i], forks[queries[i].module], answers[i]);
            } else {
                totals.growing += answers[i][1] >= 1;
            }
        }
    }

    /// From the tips to the base: the forks at opening brackets and at queries. Returns what the plant has gathered.
    static double gather(const ModuleString& string, Queries queries, std::vector<Fork>& forks) {
        std::vector<double> axes;
        double sum = 0;
        std::size_t left = queries.size();
        for (std::size_t module = string.size(); module-- > 0;) {
            if (string.letters[module] == Alphabet::close_bracket) {
                axes.push_back(sum);
                sum = 0;
            } else if (string.letters[module] == Alphabet::open_bracket && !axes.empty()) {
                forks[module] = {axes.back(), sum};
                sum += axes.back();
                axes.pop_back();
            } else if (left > 0 && queries[left - 1].module == module) {
                const double own = std::max(queries[--left].parameters[0], 0.0);
                forks[module] = {sum, own};
                sum += own;
            }
        }
        return sum;
    }

    double share_of_lateral(const Fork& fork) const {
        const double main = lambda_ * fork.main, lateral = (1 - lambda_) * fork.lateral;
        if (main + lateral > 0) return lateral / (main + lateral);
        return fork.main > 0 ? 0 : 1;  // lambda is 0 or 1, or nothing has been gathered
    }

    /// From the base to the tips.
    void hand_out(const ModuleString& string, Queries queries, std::span<Answer> answers,
                  const std::vector<Fork>& forks, double given) const {
        std::vector<double> axes;
        std::size_t next = 0;
        for (std::size_t module = 0; module < string.size(); ++module) {
            if (string.letters[module] == Alphabet::open_bracket) {
                const double lateral = given * share_of_lateral(forks[module]);
                axes.push_back(given - lateral);
                given = lateral;
            } else if (string.letters[module] == Alphabet::close_bracket && !axes.empty()) {
                given = axes.back();
                axes.pop_back();
            } else if (next < queries.size() && queries[next].module == module) {
                if (!(queries[next].parameters[0] < 0)) {
                    answers[next][1] = given * share_of_lateral(forks[module]);
                    given -= answers[next][1];
                }
                ++next;
            }
        }
    }

    /// What the branch has gathered from there on, and its internodes.
    static void gauge(const PlantView& plant, const BranchLinks& links, const Query& query, const Fork& fork,
                      Answer answer) {
        const std::uint32_t opening = links.partner[query.module];
        const std::uint32_t end = opening == BranchLinks::none ? BranchLinks::none : links.partner[opening];
        const Column<Internode>& internodes = plant.interpretation->geometry.internodes;
        const auto before = [](const Internode& internode, std::uint32_t module) { return internode.module < module; };
        const auto from = std::lower_bound(internodes.begin(), internodes.end(), query.module, before);
        const auto to = std::lower_bound(from, internodes.end(), end, before);
        answer[1] = fork.main;
        if (answer.size() > 2) answer[2] = static_cast<double>(to - from);
    }

    double alpha_, lambda_;
    std::vector<Totals> totals_;
};

const Registered<ProcessType> entry{
    {"borchert-honda", "shares out what buds gather, favouring main axes or laterals (Palubicki et al. 2009)",
     R"(?name(q, v)     -> v: the resource of a bud that has gathered q >= 0 (light, or points of `markers`)
?name(q, v, n)  with q < 0: a gauge, at the beginning of a branch -> v: what the branch has gathered from there on; n: its
                internodes. A branch with little v / n is shed: see the cut %
Further parameters (at most 20 in all) keep their values.

What buds have gathered is summed up towards the base, along the brackets of the string: the branch in a bracket is the
lateral, what follows the bracket the main axis. Alpha times the sum of all comes back. At each fork the main axis gets
lambda Qm / (lambda Qm + (1 - lambda) Ql) of it, the lateral the rest. A bud with v >= 1 grows a shoot of floor(v)
metamers.

alpha   2, >= 0; resource that comes back for each unit that buds have gathered
lambda  0.5, 0 to 1; above 0.5 main axes are favoured and trees excurrent, below it they are decurrent

Statistics of a plant: gathered, the sum of q; growing, the number of buds with v >= 1.
)",
     construct<BorchertHonda>}};

}  // namespace
}  // namespace espalier::environment
