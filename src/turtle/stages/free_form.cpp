// free-form: a box of space that bends and takes the plant along.

#include "espalier/geometry/free_form.h"

#include "espalier/turtle/geometry_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::turtle {
namespace {

class FreeFormStage final : public GeometryStage {
public:
    explicit FreeFormStage(Settings& settings) {
        form_.lower = settings.vector("lower");
        form_.upper = settings.vector("upper");
        const std::string leaves = settings.choice_or("leaves", "carried", {"bent", "carried", "left"});
        using enum FreeForm::Leaves;
        form_.leaves = leaves == "bent" ? bent : leaves == "carried" ? carried : left;
        for (int axis = 0; axis < 3; ++axis) {
            if (form_.upper[axis] > form_.lower[axis]) continue;
            throw UserError(settings.place("upper"), "'upper' must be greater than 'lower' along x, y and z");
        }
        const std::vector<double> counts = settings.numbers_or("lattice", {2, 2, 2});
        const auto fits = [](double count) { return count >= 2 && count <= 16 && count == std::floor(count); };
        if (counts.size() != 3 || !std::all_of(counts.begin(), counts.end(), fits)) {
            throw UserError(settings.place("lattice"), "'lattice' must be three whole numbers from 2 to 16");
        }
        for (std::size_t axis = 0; axis < 3; ++axis) form_.counts[axis] = static_cast<std::size_t>(counts[axis]);
        form_.moves = settings.vectors("moves");
        const std::size_t points = form_.counts[0] * form_.counts[1] * form_.counts[2];
        if (form_.moves.size() == points) return;
        throw UserError(settings.place("moves"), fmt::format("'moves' must have a vector for each of the {} points of "
                                                             "the lattice, not {}",
                                                             points, form_.moves.size()));
    }

    void apply(StagedPlant& plant) const override { deform(form_, plant.geometry.internodes, plant.geometry); }

private:
    FreeForm form_;
};

const Registered<GeometryStageType> entry{
    {"free-form", "a box of space that bends and takes the plant along (Sederberg & Parry 1986)",
     R"(lower    required, m; the corner of the box with the least x, y, z
upper    required, m; the opposite corner
lattice  [2, 2, 2]; points along x, y and z, 2 to 16 each
moves    required, m; how far each point of the lattice moves: [[x, y, z], ...], x first, then y, then z
leaves   "carried", or "bent", "left"; polygons, patches and organs: carried keeps their shapes and moves them with their
         first vertex, bent bends them too, left leaves all of them where they are
What is outside the box moves as the nearest point of the box. Radii do not change.
Source: Sederberg & Parry 1986, Free-form deformation of solid geometric models; as a component of plants, Lintermann &
Deussen 1997.
)",
     construct<FreeFormStage>}};

}  // namespace
}  // namespace espalier::turtle
