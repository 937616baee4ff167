// clover: patches of light on the ground, dimmed under the leaves that stand there.
// Bell 1986, The simulation of branching patterns in modular organisms; Mech & Prusinkiewicz 1996, section 4.
#include "espalier/base/math.h"
#include "espalier/environment/environment_process.h"

#include "environment/exchange/answer_statistics.h"
#include "environment/space/neighbours/ground_grid.h"
#include "environment/space/neighbours/reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

class Clover final : public EnvironmentProcess {
public:
    Clover(Settings& settings, const EnvironmentContext& context, Fields&)
        : Clover(ParameterFile(settings, context,
                               {"grid size", "grid position", "grid range", "transmittance", "input image",
                                "remove old leaves", "z is up"}),
                 context) {}

    void advance(const WorldView&, Queries queries, Fields&) override {
        if (forgets_) ground_.clear();
        if (as_cpfg_) return change_in_string_order(queries);
        // First all leaves that come, then all that go: the order of the queries does not matter.
        for (const Query& query : queries) {
            if (action(query) == 1) ground_.add_disc(place(query), radius(query));
        }
        for (const Query& query : queries) {
            if (action(query) != 0 && action(query) != 1) ground_.remove_disc(place(query), radius(query));
        }
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (as_cpfg_ && action(queries[i]) != 0) continue;
            const std::optional<std::size_t> cell = ground_.cell(place(queries[i]));
            answers[i][0] = cell ? light(*cell) : 0;
            if (answers[i].size() > 1) answers[i][1] = cell ? red(*cell) : 0;
        }
        statistics_.clear();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (!as_cpfg_ || action(queries[i]) == 0) statistics_.add(queries[i].plant, answers[i][0]);
        }
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return forgets_ ? Spreading::reach : Spreading::queries; }
    Box reach(const Query& query) const override {
        if (action(query) == 0) return {};
        const glm::dvec2 aside = ground_.reach(radius(query));
        const glm::dvec3& at = query.pose.position;
        return z_is_up_ ? box_around(at, {aside, everywhere}) : box_around(at, {aside.x, everywhere, aside.y});
    }
    ProcessMemory memory() const override { return {ground_.bytes()}; }

    void save(std::ostream& out) const override { ground_.save(out); }
    void restore(std::istream& in) override { ground_.restore(in); }

private:
    Clover(ParameterFile file, const EnvironmentContext& context)
        : as_cpfg_(file.has_numbers_of_cpfg()),
          transmittance_(std::max(file.number("transmittance", 0.6, Range::between(0, 1)), 1e-4)),
          forgets_(file.flag("remove old leaves", false, {"on", "yes"}, {"off", "no"})),
          z_is_up_(file.flag("z is up", true, {"on", "yes"}, {"no", "off"})),
          ground_(file, context, as_cpfg_ ? GroundGrid::Rule::touched : GroundGrid::Rule::centres),
          statistics_(context.plants) {}

    void change_in_string_order(Queries queries) {
        for (const Query& query : queries) {
            if (action(query) == 1) {
                ground_.add_disc(place(query), radius(query));
            } else if (action(query) != 0) {
                ground_.remove_disc(place(query), radius(query));
            }
        }
    }

    glm::dvec2 place(const Query& query) const {
        const glm::dvec3& position = query.pose.position;
        return {position.x, z_is_up_ ? position.y : position.z};
    }

    /// 0: asks only, 1: a leaf comes, all others: a leaf goes.
    static double action(const Query& query) { return query.parameters.size() > 1 ? query.parameters[0] : 0; }

    static double radius(const Query& query) {
        return std::sqrt(std::max(query.parameters[1], 0.0) / std::numbers::pi);
    }

    double light(std::size_t cell) const {
        const double leaves = std::min(ground_.count(cell), 255u);
        return ground_.colour(cell)[1] / 255.0 * math::pow(transmittance_, leaves);
    }

    double red(std::size_t cell) const {
        return as_cpfg_ && !ground_.has_picture() ? 0 : ground_.colour(cell)[0] / 128.0;
    }

    bool as_cpfg_;
    double transmittance_;
    bool forgets_, z_is_up_;
    GroundGrid ground_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"clover", "patches of light on the ground under leaves (Bell 1986; Mech & Prusinkiewicz 1996)",
     R"(?name(p)         -> light at the place: green of the image (0 to 1) times t^n under n leaves; 0 outside the grid
?name(action, a) -> light, and a = red of the image / 128. Action 0 only asks; 1 adds a leaf of area a;
                    any other number removes one. In each step, leaves are added, then removed, then queries answered
Further parameters (at most 20 in all) keep their values.

transmittance  0.6, 0 to 1; t: fraction of light that passes through a leaf; 0 is taken as 0.0001
input_image    none; .rgb (SGI), .tga or .png, its lower left corner at `grid_position`; without a picture all is white
grid_size      [512, 512], >= 1; cells along both sides of the ground
grid_position  [0, 0] m; lower left corner of the ground
grid_range     [1, 1] m, > 0; size of the ground from corner to corner
remove_old_leaves  false; leaves remain until they are removed; true: each step begins without leaves
z_is_up        true; the ground is x and y; false: x and z
parameters     none; a file with these keys in words, as cpfg's program clover reads it
verbose        accepted and ignored: the messages of cpfg's program
numbers        "exact", or "cpfg"; cpfg (the default with `parameters` and in .e files): a leaf covers every cell that
               its disc touches by more than 0.03 of its width, at most 255 lie over each other, there is no red without
               a picture, the picture is stretched from corner cell to corner cell, and leaves are added and removed in
               string order by queries that get no answer

A leaf covers the cells whose centres are inside its disc. Statistics of a plant: mean, min, max of the light, queries.
)",
     construct<Clover>, true}};

}  // namespace
}  // namespace espalier::environment
