// ornament: how many discs lie over a place, and how far a picture lets them spread.
// Wong, Zongker & Salesin 1998, Computer-generated floral ornament.
#include "espalier/environment/environment_process.h"

#include "environment/exchange/answer_statistics.h"
#include "environment/space/neighbours/ground_grid.h"
#include "environment/space/neighbours/reach.h"

#include <algorithm>

namespace espalier::environment {
namespace {

class Ornament final : public EnvironmentProcess {
public:
    Ornament(Settings& settings, const EnvironmentContext& context, Fields&)
        : Ornament(ParameterFile(settings, context, {"grid size", "grid position", "grid range", "input image"}),
                   context) {}

    void advance(const WorldView&, Queries queries, Fields&) override {
        ground_.clear();
        for (const Query& query : queries) {
            if (query.parameters.size() > 1) ground_.add_disc(place(query), query.parameters[1]);
        }
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const std::optional<std::size_t> cell = ground_.cell(place(queries[i]));
            answers[i][0] = cell ? std::min(ground_.count(*cell), 255u) : 0;
            if (answers[i].size() > 1) answers[i][1] = cell ? ground_.colour(*cell)[1] / 255.0 : 0;
        }
        statistics_.sum_up(queries, answers);
    }

    std::vector<Quantity> statistics(std::uint32_t plant) const override { return statistics_.quantities(plant); }

    std::pair<int, int> query_arity() const override { return {1, 20}; }
    Spreading spreading() const override { return Spreading::reach; }
    Box reach(const Query& query) const override {
        if (query.parameters.size() < 2) return {};
        const glm::dvec2 aside = ground_.reach(query.parameters[1]);
        return box_around(query.pose.position, {aside, everywhere});
    }
    ProcessMemory memory() const override { return {ground_.bytes()}; }

private:
    Ornament(ParameterFile file, const EnvironmentContext& context)
        : ground_(file, context), statistics_(context.plants) {}

    static glm::dvec2 place(const Query& query) { return glm::dvec2(query.pose.position.x, query.pose.position.y); }

    GroundGrid ground_;
    AnswerStatistics statistics_;
};

const Registered<ProcessType> entry{
    {"ornament", "number of discs that cover a place, for ornaments that fill a plane (Wong et al. 1998)",
     R"(?name(p, r) -> p = the number of discs that cover the place, at most 255, including the query's own disc of radius r,
               r = green of the image there, 0 to 1; both are 0 outside the grid
?name(p)    -> p = the number of discs
Further parameters (at most 20 in all) keep their values. Places are x and y.

input_image    none; .rgb (SGI), .tga or .png, its lower left corner at `grid_position`; without a picture all is white
grid_size      [512, 512], >= 1; cells along both sides. A disc covers the cells whose centres are inside it
grid_position  [0, 0] m; lower left corner of the grid
grid_range     [1, 1] m, > 0; size of the grid from corner to corner
parameters     none; a file with these keys in words, as cpfg's program ornament reads it
verbose        accepted and ignored: the messages of cpfg's program

Statistics of a plant: mean, min, max of the counts, queries.
)",
     construct<Ornament>}};

}  // namespace
}  // namespace espalier::environment
