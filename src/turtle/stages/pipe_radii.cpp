// pipe-radii: internodes as thick as what they bear asks for.
// The pipe model of Shinozaki, Yoda, Hozumi & Kira 1964 with the exponent of MacDonald 1983; forks as in Brzoska 2019,
// section 5.1: a branch much thinner than its bearer starts with its own radius.
#include "espalier/base/math.h"
#include "espalier/turtle/geometry_stage.h"

#include "turtle/internode_bearers.h"

#include <algorithm>
#include <vector>

namespace espalier::turtle {
namespace {

class PipeRadii final : public GeometryStage {
public:
    explicit PipeRadii(Settings& settings)
        : exponent_(settings.number_or("exponent", 2.5, Range::between(0.5, 10))),
          tip_(settings.number_or("tip", 0.005, Range::positive())),
          factor_(settings.number_or("factor", 1, Range::positive())),
          join_(settings.number_or("join", 0.5, Range::between(0, 1))),
          leader_(settings.number_or("leader", 0, Range::between(0, 10))) {}

    void apply(StagedPlant& plant) const override {
        Column<Internode>& internodes = plant.geometry.internodes;
        const std::vector<std::uint32_t> bearers = internode_bearers(plant.geometry, plant.string);
        std::vector<double> radii = node_radii(bearers);
        if (leader_ > 0) thicken_leader(internodes, radii);
        std::vector<bool> is_thin(internodes.size(), false);
        for (std::size_t i = 0; i < internodes.size(); ++i) {
            const double own = radii[i], borne_by = bearers[i] == no_bearer ? own : radii[bearers[i]];
            is_thin[i] = own < join_ * borne_by;
            internodes[i].tip_radius = own;
            internodes[i].base_radius = is_thin[i] ? own : borne_by;
            internodes[i].pixels = 0;
        }
        divide_axes(plant.geometry, bearers, is_thin);
        plant.geometry.in_pixels = false;
    }

private:
    /// A node of an axis has one radius, so an axis that goes on much thinner goes on as another.
    static void divide_axes(PlantGeometry& geometry, const std::vector<std::uint32_t>& bearers,
                            const std::vector<bool>& is_thin) {
        std::vector<std::uint32_t> before;
        for (const Internode& internode : geometry.internodes) before.push_back(internode.axis);
        for (std::size_t i = 0; i < before.size(); ++i) {
            const bool goes_on = bearers[i] != no_bearer && before[bearers[i]] == before[i];
            if (!goes_on) continue;
            geometry.internodes[i].axis = is_thin[i] ? geometry.axes++ : geometry.internodes[bearers[i]].axis;
        }
    }

    /// At the tip of each internode: r^n is the sum over what it bears, and ends have the radius `tip`.
    std::vector<double> node_radii(const std::vector<std::uint32_t>& bearers) const {
        std::vector<double> powers(bearers.size(), 0);  // powers of r / tip
        for (std::size_t i = bearers.size(); i-- > 0;) {
            if (powers[i] == 0) powers[i] = 1;
            if (bearers[i] != no_bearer) powers[bearers[i]] += powers[i];
        }
        for (double& value : powers) value = factor_ * tip_ * math::pow(value, 1 / exponent_);
        return powers;
    }

    /// The main axis, of order 0, from its top down, at every height thicker than what stands beside it there.
    void thicken_leader(const Column<Internode>& internodes, std::vector<double>& radii) const {
        std::vector<std::size_t> beside;  // by the height they reach, the highest last
        double least = 0;
        for (std::size_t i = 0; i < internodes.size(); ++i) {
            if (internodes[i].order > 0) beside.push_back(i);
        }
        const auto top = [&](std::size_t i) { return std::max(internodes[i].base.y, internodes[i].tip.y); };
        std::sort(beside.begin(), beside.end(), [&](std::size_t a, std::size_t b) { return top(a) < top(b); });
        for (std::size_t i = internodes.size(); i-- > 0;) {
            if (internodes[i].order > 0) continue;
            const double low = std::min(internodes[i].base.y, internodes[i].tip.y);
            for (; !beside.empty() && top(beside.back()) > low; beside.pop_back()) {
                least = std::max(least, leader_ * radii[beside.back()]);
            }
            radii[i] = std::max(radii[i], least);
        }
    }

    double exponent_, tip_, factor_, join_, leader_;
};

const Registered<GeometryStageType> entry{
    {"pipe-radii",
     "radii by the pipe model: r^n of an internode is the sum over those it bears (Shinozaki et al. 1964)",
     R"(exponent  2.5, 0.5 to 10; n: 2 preserves the area of cross-sections, trees lie between 2 and 3
tip       0.005 m, > 0; the radius of internodes that bear none
factor    1, > 0; thickness: all radii are multiplied by it
join      0.5, 0 to 1; a branch whose radius is below this share of its bearer's begins with its own radius, others begin
          with the bearer's; 0: all do, 1: only branches as thick as their bearer do. An axis that goes on that thin is
          recorded as a line of its own from there on
leader    0, 0 to 10; the main axis is at least so many times as thick as all that reaches its height; 0: only the pipe
          model counts
Widths that the model sets are replaced.
)",
     construct<PipeRadii>}};

}  // namespace
}  // namespace espalier::turtle
