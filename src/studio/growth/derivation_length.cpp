#include "studio/growth/derivation_length.h"

#include "espalier/lsystem/derivation.h"

#include "studio/growth/expressions_of.h"

#include <algorithm>

namespace espalier::studio {
namespace {

constexpr std::uint32_t length_global = 1;  // Z, see LSystem::globals

bool reads_length(const Expression& expression) {
    return (expression.kind == Expression::Kind::global && expression.index == length_global) ||
           (expression.kind == Expression::Kind::call && (expression.function == Function::get_derivation_length ||
                                                          expression.function == Function::set_derivation_length));
}

bool varies(const Expression& expression) {
    return expression.kind == Expression::Kind::global || expression.kind == Expression::Kind::element;
}

bool depends_on_length(const LSystem& system) {
    return !system.end.empty() || holds_in(system.derivation_length, varies) ||
           holds_in_derivation(system, reads_length) || holds_in_homomorphism(system, reads_length);
}

}  // namespace

bool depends_on_length(const Scene& scene) {
    if (scene.frames || scene.last_frame) return true;
    return std::any_of(scene.plants.begin(), scene.plants.end(), [](const Plant& plant) {
        const Model& model = source_of(*plant.model);
        // Systems within one another lend each other what they know.
        return model.systems.size() > 1 || plant.in_time || depends_on_length(model.main());
    });
}

}  // namespace espalier::studio
