#include "studio/derivation_length.h"

#include "espalier/lsystem/derivation.h"

#include <algorithm>

namespace espalier::studio {
namespace {

constexpr std::uint32_t length_global = 1;  // Z, see LSystem::globals

bool reads(const Expression& expression) {
    const bool here =
        (expression.kind == Expression::Kind::global && expression.index == length_global) ||
        (expression.kind == Expression::Kind::call && (expression.function == Function::get_derivation_length ||
                                                       expression.function == Function::set_derivation_length));
    return here || std::any_of(expression.operands.begin(), expression.operands.end(), reads);
}

bool reads(const std::optional<Expression>& expression) {
    return expression && reads(*expression);
}

bool reads_in(const Block& block) {
    return std::any_of(block.begin(), block.end(), [](const Statement& statement) {
        const auto read = [](const std::optional<Expression>& expression) { return reads(expression); };
        return std::any_of(statement.expressions.begin(), statement.expressions.end(), read) ||
               std::any_of(statement.bodies.begin(), statement.bodies.end(), reads_in);
    });
}

bool reads_in(const std::vector<ModuleTemplate>& modules) {
    return std::any_of(modules.begin(), modules.end(), [](const ModuleTemplate& module) {
        return std::any_of(module.arguments.begin(), module.arguments.end(),
                           [](const Expression& argument) { return reads(argument); });
    });
}

bool reads_in(const std::vector<Production>& productions) {
    return std::any_of(productions.begin(), productions.end(), [](const Production& production) {
        return reads_in(production.before) || reads(production.condition) || reads_in(production.after) ||
               reads_in(production.successor) || reads(production.weight);
    });
}

bool varies(const Expression& expression) {
    return expression.kind == Expression::Kind::global || expression.kind == Expression::Kind::element ||
           std::any_of(expression.operands.begin(), expression.operands.end(), varies);
}

bool depends_on_length(const LSystem& system) {
    return !system.end.empty() || (system.derivation_length && varies(*system.derivation_length)) ||
           reads_in(system.start) || reads_in(system.start_each) || reads_in(system.end_each) ||
           reads_in(system.axiom) || reads_in(system.productions) || reads_in(system.decomposition.productions) ||
           reads_in(system.homomorphism.productions);
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
