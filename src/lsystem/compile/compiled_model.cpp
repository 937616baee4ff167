#include "lsystem/compile/compiled_model.h"

#include "espalier/base/stop.h"

#include "base/excerpt.h"
#include "lsystem/compile/locals.h"
#include "lsystem/programs/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::lsystem {
namespace {

constexpr double deepest = 1e6;
constexpr std::size_t filled_at_once = std::size_t{1} << 20;

/// True if a `%` may come to stand in the string.
bool writes_cut(const Model& model) {
    const auto cuts = [](const std::vector<ModuleTemplate>& modules) {
        return std::any_of(modules.begin(), modules.end(),
                           [](const ModuleTemplate& module) { return module.letter == Alphabet::cut; });
    };
    const auto any = [&](const std::vector<Production>& rules) {
        return std::any_of(rules.begin(), rules.end(),
                           [&](const Production& production) { return cuts(production.successor); });
    };
    return cuts(model.main().axiom) || std::any_of(model.systems.begin(), model.systems.end(), [&](const auto& system) {
               return any(system.productions) || any(system.decomposition.productions);
           });
}

bool names_bracket_to_the_left(const Production& production) {
    return std::any_of(production.left.begin(), production.left.end(),
                       [](const ModulePattern& pattern) { return pattern.letter <= Alphabet::close_bracket; });
}

/// Compiles one L-system of a model.
class SystemCompiler {
public:
    SystemCompiler(const Model& model, std::size_t index)
        : model_(&model),
          system_(model.systems[index]),
          locals_(model.systems.size() == 1 ? find_locals(system_) : std::nullopt),
          programs_(system_, index > 0, model.arithmetic, locals_),
          compiled_(std::make_unique<CompiledSystem>()) {
        compiled_->source = model_;
        compiled_->system = &system_;
        compiled_->index = index;
    }

    std::unique_ptr<CompiledSystem> compile();

private:
    void compile_arrays();
    void compile_blocks();
    enum class Blocks { apart, with_values };
    CompiledRules compile_rules(const std::vector<Production>& productions, bool stochastic, Blocks blocks);
    void compile_depth(const RuleSet& source, CompiledRules& rules);
    CompiledProduction compile_production(const Production& production, Blocks blocks);
    void compile_programs(CompiledProduction& production, Blocks blocks);
    std::vector<CompiledPattern> patterns(const std::vector<ModulePattern>& source);
    void descend(CompiledProduction& production) const;
    void find_lanes(CompiledProduction& production);
    std::optional<Lane> lane(const Expression& expression, const std::vector<CompiledPattern>& strict) const;
    std::optional<Lane> sum_lane(const Expression& expression, const std::vector<CompiledPattern>& strict) const;
    void index(CompiledRules& rules) const;
    std::int32_t always(const CompiledRules& rules, LetterId letter) const;
    static void find_laid_out(CompiledRules& rules);
    void place_registers();
    void make_columns();
    void place_registers(CompiledRules& rules);
    void find_ignored();
    void name_variables();

    const Model* model_;
    const LSystem& system_;
    const std::optional<std::vector<bool>> locals_;
    ProgramCompiler programs_;
    std::unique_ptr<CompiledSystem> compiled_;
};

std::unique_ptr<CompiledSystem> SystemCompiler::compile() {
    compile_arrays();
    compile_blocks();
    const Blocks blocks = locals_ ? Blocks::with_values : Blocks::apart;
    compiled_->rules = compile_rules(system_.productions, system_.seed.has_value(), blocks);
    const auto weighted = [](const RuleSet& rules) {
        return std::any_of(rules.productions.begin(), rules.productions.end(),
                           [](const Production& production) { return production.weight.has_value(); });
    };
    // Decomposition takes the first production that applies, whatever the weights (cpfg).
    compiled_->decomposition = compile_rules(system_.decomposition.productions, false, blocks);
    compile_depth(system_.decomposition, compiled_->decomposition);
    for (CompiledProduction& production : compiled_->rules.productions) {
        production.decomposes = compiled_->decomposition.follow(production);
    }
    compiled_->homomorphism =
        compile_rules(system_.homomorphism.productions, weighted(system_.homomorphism), Blocks::apart);
    compile_depth(system_.homomorphism, compiled_->homomorphism);
    find_laid_out(compiled_->homomorphism);
    compiled_->may_cut = writes_cut(*model_) && !compiled_->rules.has(Alphabet::cut);
    compiled_->plans = make_plans(*compiled_);
    compiled_->ring = system_.ring;
    find_ignored();
    name_variables();
    place_registers();
    make_columns();
    compiled_->choosing = make_choosing(*compiled_);
    return std::move(compiled_);
}

void SystemCompiler::compile_arrays() {
    for (const ArrayDeclaration& declared : system_.arrays) {
        CompiledArray array;
        array.name = declared.name;
        array.external = declared.external && compiled_->index > 0;
        double elements = 1;
        for (const Expression& dimension : declared.dimensions) {
            const std::optional<double> size = programs_.fold(dimension);
            if (!size || !(std::trunc(*size) >= 1)) {
                throw UserError(
                    dimension.place,
                    fmt::format("a dimension of array '{}' must be a constant of at least 1", declared.name));
            }
            array.dimensions.push_back(static_cast<std::size_t>(std::min(*size, 2 * most_elements)));
            elements *= std::trunc(*size);
        }
        if (!(elements <= most_elements)) {
            throw UserError(declared.place, fmt::format("array '{}' has {:g} elements; {:g} is the most", declared.name,
                                                        elements, most_elements));
        }
        if (static_cast<double>(declared.values.size()) > elements) {
            throw UserError(declared.place, fmt::format("array '{}' has {:g} elements, but {} values are given",
                                                        declared.name, elements, declared.values.size()));
        }
        array.size = array.external ? 0 : static_cast<std::size_t>(elements);
        array.values.assign(array.external ? 0 : declared.values.size(), 0);
        for (std::size_t k = 0; k < array.values.size(); ++k) {
            const std::optional<double> value = programs_.fold(declared.values[k]);
            if (!value) throw UserError(declared.values[k].place, "an array's initial values must be constants");
            array.values[k] = *value;
        }
        compiled_->arrays.push_back(std::move(array));
    }
}

void SystemCompiler::compile_blocks() {
    compiled_->start = programs_.block(system_.start);
    compiled_->start_each = programs_.block(system_.start_each);
    compiled_->end_each = programs_.block(system_.end_each);
    compiled_->end = programs_.block(system_.end);
    compiled_->axiom = programs_.arguments(system_.axiom);
    for (const ModuleTemplate& module : system_.axiom) compiled_->axiom_letters.push_back(module.letter);
    if (system_.derivation_length) compiled_->length = programs_.value(*system_.derivation_length);
    if (system_.seed) compiled_->seed = programs_.value(*system_.seed);
}

CompiledRules SystemCompiler::compile_rules(const std::vector<Production>& productions, bool stochastic,
                                            Blocks blocks) {
    CompiledRules rules;
    rules.stochastic = stochastic;
    for (const Production& production : productions) {
        if (production.strict.empty()) throw UserError(production.place, "a production needs a strict predecessor");
        rules.productions.push_back(compile_production(production, blocks));
        const CompiledProduction& compiled = rules.productions.back();
        for (const Program* program :
             {&compiled.before, &compiled.condition, &compiled.after, &compiled.successor, &compiled.weight}) {
            rules.effects |= program->effects;
        }
        rules.uses_context |= !compiled.context_free();
        const auto binds = [](const CompiledPattern& pattern) { return pattern.arity > 0; };
        rules.binds_context |= std::any_of(compiled.left.begin(), compiled.left.end(), binds) ||
                               std::any_of(compiled.right.begin(), compiled.right.end(), binds);
        rules.several_strict |= compiled.strict.size() > 1;
        rules.widest = std::max(rules.widest, compiled.strict.size());
        for (std::size_t k = 1; k < compiled.strict.size(); ++k) {
            rules.joints.emplace_back(compiled.strict[k - 1].letter, compiled.strict[k].letter);
        }
    }
    std::sort(rules.joints.begin(), rules.joints.end());
    index(rules);
    return rules;
}

void SystemCompiler::compile_depth(const RuleSet& source, CompiledRules& rules) {
    rules.warnings = source.warnings;
    if (source.maximum_depth) {
        const std::optional<double> depth = programs_.fold(*source.maximum_depth);
        if (!depth || !(*depth >= 0 && *depth <= deepest)) {
            throw UserError(source.maximum_depth->place, "the maximum depth must be a constant from 0 to 1e6");
        }
        rules.maximum_depth = static_cast<std::size_t>(*depth);
        rules.explicit_depth = true;
    }
    if (source.seed) {
        const std::optional<double> seed = programs_.fold(*source.seed);
        if (!seed) throw UserError(source.seed->place, "the seed must be a constant");
        rules.salt = std::bit_cast<std::uint64_t>(*seed);
    }
}

std::vector<CompiledPattern> SystemCompiler::patterns(const std::vector<ModulePattern>& source) {
    std::vector<CompiledPattern> compiled;
    for (const ModulePattern& pattern : source) {
        const int arity = pattern.skip_branch ? 0 : model_->alphabet.arity(pattern.letter);
        compiled.push_back(
            {pattern.letter, static_cast<std::uint16_t>(arity), pattern.first_formal, pattern.skip_branch});
        compiled_->formals = std::max(compiled_->formals, pattern.first_formal + static_cast<std::uint32_t>(arity));
    }
    return compiled;
}

/// Blocks that matter to their module alone are computed again with each value that may need them, so that whoever
/// computes it needs nothing that another has computed.
void SystemCompiler::compile_programs(CompiledProduction& compiled, Blocks blocks) {
    const Production& production = *compiled.source;
    const bool apart = blocks == Blocks::apart;
    const std::vector<const Block*> none, before{&production.before}, all{&production.before, &production.after};
    const Block nothing;
    compiled.before = programs_.block(apart ? production.before : nothing);
    compiled.after = programs_.block(apart ? production.after : nothing);
    if (production.condition) {
        const std::optional<double> known = programs_.fold(*production.condition);
        compiled.has_condition = !known || *known == 0;
        const bool alone = apart || !is_needed(production.before, *production.condition);
        compiled.condition = programs_.value(*production.condition, alone ? none : before);
    }
    compiled.has_weight = production.weight.has_value();
    if (production.weight) compiled.weight = programs_.value(*production.weight);
    compiled.successor = programs_.arguments(production.successor, apart ? none : all);
    compiled.begins_with_blocks = !apart && !(production.before.empty() && production.after.empty());
}

CompiledProduction SystemCompiler::compile_production(const Production& production, Blocks blocks) {
    CompiledProduction compiled;
    compiled.source = &production;
    compiled.left = patterns(production.left);
    std::reverse(compiled.left.begin(), compiled.left.end());
    compiled.strict = patterns(production.strict);
    compiled.right = patterns(production.right);
    compiled_->formals = std::max(compiled_->formals, static_cast<std::uint32_t>(production.formals.size()));
    compile_programs(compiled, blocks);
    compiled.length = production.successor.size();
    compiled.letters.assign(whole_blocks(std::max<std::size_t>(compiled.length, 1), letter_block),
                            Alphabet::open_bracket);
    for (std::size_t k = 0; k < compiled.length; ++k) {
        compiled.letters[k] = production.successor[k].letter;
        compiled.arities.push_back(static_cast<std::uint16_t>(production.successor[k].arguments.size()));
        compiled.parameters += compiled.arities.back();
    }
    compiled.writing_samples = compiled.after.effects.samples || compiled.successor.effects.samples;
    compiled.testing_samples =
        compiled.before.effects.samples || compiled.condition.effects.samples || compiled.weight.effects.samples;
    descend(compiled);
    find_lanes(compiled);
    return compiled;
}

void SystemCompiler::descend(CompiledProduction& production) const {
    Descent& descent = production.descent;
    descent.carries.resize(production.length, Descent::none);
    descent.heirs.resize(production.strict.size(), static_cast<std::uint32_t>(production.length));
    for (std::uint32_t s = 0; s < production.strict.size(); ++s) {
        const SymbolId symbol = model_->alphabet.symbol_of(production.strict[s].letter);
        for (std::uint32_t k = 0; k < production.length; ++k) {
            const bool is_taken = descent.carries[k] != Descent::none;
            if (is_taken || model_->alphabet.symbol_of(production.letters[k]) != symbol) continue;
            descent.carries[k] = s;
            descent.heirs[s] = k;
            break;
        }
    }
    for (const std::uint32_t carried : descent.carries) {
        descent.births.push_back({0, descent.born});
        descent.born += carried == Descent::none;
    }
    descent.births.resize(whole_blocks(production.length, birth_block));
}

/// True if the expression or block reads a formal of one of the patterns.
bool reads_formals_of(const Expression& expression, const std::vector<CompiledPattern>& patterns) {
    if (expression.kind == Expression::Kind::formal) {
        return std::any_of(patterns.begin(), patterns.end(), [&](const CompiledPattern& pattern) {
            return expression.index >= pattern.first_formal && expression.index < pattern.first_formal + pattern.arity;
        });
    }
    return std::any_of(expression.operands.begin(), expression.operands.end(),
                       [&](const Expression& operand) { return reads_formals_of(operand, patterns); });
}

bool reads_formals_of(const Block& block, const std::vector<CompiledPattern>& patterns) {
    return std::any_of(block.begin(), block.end(), [&](const Statement& statement) {
        const auto expression_reads = [&](const std::optional<Expression>& expression) {
            return expression && reads_formals_of(*expression, patterns);
        };
        const auto body_reads = [&](const Block& body) { return reads_formals_of(body, patterns); };
        return std::any_of(statement.expressions.begin(), statement.expressions.end(), expression_reads) ||
               std::any_of(statement.bodies.begin(), statement.bodies.end(), body_reads);
    });
}

void SystemCompiler::find_lanes(CompiledProduction& production) {
    for (const auto* context : {&production.left, &production.right}) {
        production.reads_context |=
            reads_formals_of(production.source->after, *context) ||
            (production.begins_with_blocks && reads_formals_of(production.source->before, *context));
    }
    std::vector<const Expression*> rest;
    for (const ModuleTemplate& module : production.source->successor) {
        for (const Expression& argument : module.arguments) {
            production.reads_context |=
                reads_formals_of(argument, production.left) || reads_formals_of(argument, production.right);
            // A block may have changed what formals stand for.
            const std::optional<Lane> found =
                production.begins_with_blocks ? std::nullopt : lane(argument, production.strict);
            if (!found) {
                production.rest_places.push_back(static_cast<std::uint32_t>(production.lanes.sources.size()));
                rest.push_back(&argument);
            }
            production.lanes.push_back(found.value_or(Lane{}));
        }
    }
    production.lanes.pad();
    production.affine = rest.empty();
    // Where only some are lanes, a program of its own computes the others.
    if (rest.size() == production.parameters) production.rest_places.clear();
    if (!production.rest_places.empty()) production.rest = programs_.values(rest);
}

/// Where the value of a formal stands among those of the strict predecessor.
std::optional<std::uint32_t> place_of(std::uint32_t formal, const std::vector<CompiledPattern>& strict) {
    std::uint32_t before = 0;
    for (const CompiledPattern& pattern : strict) {
        if (formal >= pattern.first_formal && formal < pattern.first_formal + pattern.arity) {
            return before + formal - pattern.first_formal;
        }
        before += pattern.arity;
    }
    return std::nullopt;
}

// Only forms that a multiplication followed by an addition computes with the very same rounding. What cpfg's arithmetic
// rounds once more needs a program.
// Adding -0.0 changes no number, not even -0.0.
std::optional<Lane> SystemCompiler::lane(const Expression& expression,
                                         const std::vector<CompiledPattern>& strict) const {
    const Arithmetic arithmetic = model_->arithmetic;
    if (std::optional<double> constant = programs_.fold(expression)) {
        constant = stored(*constant, arithmetic);
        // 0 times a value, plus -0.0, may be 0.0.
        if (!std::isfinite(*constant) || (*constant == 0 && std::signbit(*constant))) return std::nullopt;
        return Lane{0, 0, *constant};
    }
    if (expression.kind == Expression::Kind::formal) {
        const std::optional<std::uint32_t> source = place_of(expression.index, strict);
        return source ? std::optional(Lane{*source, 1, -0.0}) : std::nullopt;
    }
    if (expression.kind != Expression::Kind::apply || arithmetic == Arithmetic::cpfg) return std::nullopt;
    if (expression.op == Operator::add || expression.op == Operator::subtract) return sum_lane(expression, strict);
    if (expression.op != Operator::multiply) return std::nullopt;
    for (const int side : {0, 1}) {
        const std::optional<double> factor = programs_.fold(expression.operands[side]);
        const Expression& other = expression.operands[1 - side];
        if (!factor || other.kind != Expression::Kind::formal) continue;
        std::optional<Lane> scaled = lane(other, strict);
        if (scaled) scaled->scale = *factor;
        return scaled;
    }
    return std::nullopt;
}

// l * m + c, c + l * m, l * m - c and c - l, where c is not 0.
std::optional<Lane> SystemCompiler::sum_lane(const Expression& expression,
                                             const std::vector<CompiledPattern>& strict) const {
    const bool subtracts = expression.op == Operator::subtract;
    for (const int side : {0, 1}) {
        const std::optional<double> constant = programs_.fold(expression.operands[side]);
        const Expression& other = expression.operands[1 - side];
        const bool nested = other.kind == Expression::Kind::apply && other.op != Operator::multiply;
        if (!constant || *constant == 0 || nested) continue;
        std::optional<Lane> shifted = lane(other, strict);
        if (!shifted) continue;
        if (subtracts && side == 0) shifted->scale = -shifted->scale;
        shifted->offset = subtracts && side == 1 ? -*constant : *constant;
        return shifted;
    }
    return std::nullopt;
}

/// Lists the productions that may apply; in cpfg, brackets in a left context never match.
void SystemCompiler::index(CompiledRules& rules) const {
    const std::size_t letters = model_->alphabet.size();
    rules.first.assign(letters + 1, 0);
    const auto counts = [&](const CompiledProduction& production) {
        return model_->arithmetic != Arithmetic::cpfg || !names_bracket_to_the_left(*production.source);
    };
    for (const CompiledProduction& production : rules.productions) {
        rules.first[production.strict[0].letter + 1] += counts(production);
    }
    for (std::size_t l = 0; l < letters; ++l) rules.first[l + 1] += rules.first[l];
    rules.candidates.resize(rules.first.back());
    std::vector<std::uint32_t> next(rules.first.begin(), rules.first.end() - 1);
    for (std::uint32_t p = 0; p < rules.productions.size(); ++p) {
        const CompiledProduction& production = rules.productions[p];
        if (counts(production)) rules.candidates[next[production.strict[0].letter]++] = p;
    }
    rules.always.resize(letters);
    for (std::size_t l = 0; l < letters; ++l) rules.always[l] = always(rules, static_cast<LetterId>(l));
}

void SystemCompiler::find_laid_out(CompiledRules& rules) {
    for (const std::int32_t always : rules.always) {
        const CompiledProduction* picture = always < 0 ? nullptr : &rules.productions[static_cast<std::size_t>(always)];
        const bool final =
            picture && (rules.maximum_depth == 1 || (rules.maximum_depth > 1 && !rules.follow(*picture)));
        const bool simple = final && picture->affine;
        rules.laid_out.push_back(simple ? picture : nullptr);
    }
}

std::int32_t SystemCompiler::always(const CompiledRules& rules, LetterId letter) const {
    if (!rules.has(letter)) return -1;
    if (rules.first[letter + 1] - rules.first[letter] >= no_letter) {
        throw UserError(fmt::format("'{}' has more than {} productions", model_->alphabet.name(letter), no_letter - 1));
    }
    const std::uint32_t candidate = rules.candidates[rules.first[letter]];
    const CompiledProduction& production = rules.productions[candidate];
    const bool alone = rules.first[letter + 1] - rules.first[letter] == 1;
    const bool unconditional = production.context_free() && production.strict.size() == 1 &&
                               production.before.empty() && production.after.empty() && !production.has_condition &&
                               !production.has_weight;
    return unconditional && (alone || !rules.stochastic) ? static_cast<std::int32_t>(candidate) : -1;
}

void SystemCompiler::find_ignored() {
    const Alphabet& alphabet = model_->alphabet;
    std::vector<bool> listed(alphabet.symbol_count());
    for (const SymbolId symbol : system_.filtered) listed[symbol] = true;
    compiled_->ignored.assign(alphabet.size(), 0);
    if (system_.filter == LSystem::Filter::none) return;
    for (std::size_t l = 0; l < alphabet.size(); ++l) {
        const bool named = listed[alphabet.symbol_of(static_cast<LetterId>(l))];
        compiled_->ignored[l] = named == (system_.filter == LSystem::Filter::ignore);
    }
}

void SystemCompiler::name_variables() {
    for (std::uint32_t g = 0; g < system_.globals.size(); ++g) {
        const std::string& name = system_.globals[g];
        compiled_->global_indices.emplace(name, g);
        if (compiled_->index > 0 && programs_.is_external(g)) compiled_->external_globals.push_back({g, name});
    }
    for (std::uint32_t a = 0; a < compiled_->arrays.size(); ++a) {
        const CompiledArray& array = compiled_->arrays[a];
        compiled_->array_indices.emplace(array.name, a);
        if (array.external) compiled_->external_arrays.push_back({a, array.name});
    }
}

void SystemCompiler::place_registers(CompiledRules& rules) {
    for (CompiledProduction& production : rules.productions) {
        for (Program* program : {&production.before, &production.condition, &production.after, &production.successor,
                                 &production.rest, &production.weight}) {
            programs_.place_registers(*program, compiled_->formals);
        }
    }
}

void SystemCompiler::place_registers() {
    place_registers(compiled_->rules);
    place_registers(compiled_->decomposition);
    place_registers(compiled_->homomorphism);
    for (Program* program : {&compiled_->start, &compiled_->start_each, &compiled_->end_each, &compiled_->end,
                             &compiled_->axiom, &compiled_->length, &compiled_->seed}) {
        programs_.place_registers(*program, compiled_->formals);
    }
    compiled_->constants = programs_.constants();
    compiled_->registers = programs_.register_count(compiled_->formals);
}

/// Where a formal stands among the parameters of a module that is replaced alone, and of its nearest neighbours.
std::optional<ColumnProgram::Source> source_of(std::uint32_t formal, const CompiledProduction& production) {
    using enum ColumnProgram::Whose;
    if (const auto place = place_of(formal, production.strict)) return ColumnProgram::Source{own, *place};
    if (!production.is_of_neighbours()) return std::nullopt;
    if (const auto place = place_of(formal, production.left)) return ColumnProgram::Source{left, *place};
    if (const auto place = place_of(formal, production.right)) return ColumnProgram::Source{right, *place};
    return std::nullopt;
}

/// Programs of productions that are taken for what their modules are, whatever came before them.
void SystemCompiler::make_columns() {
    for (CompiledProduction& production : compiled_->rules.productions) {
        const auto place = [&](std::uint32_t formal) { return source_of(formal, production); };
        const auto columns = [&](const Program& program) {
            return ColumnProgram::make(program, compiled_->constants, compiled_->formals, place);
        };
        if (!production.before.empty()) continue;
        if (production.has_condition) production.tests = columns(production.condition);
        if (production.has_weight && !production.weight.effects.samples) production.weighs = columns(production.weight);
        if (production.affine || !production.after.empty()) continue;
        production.values = columns(production.rest_places.empty() ? production.successor : production.rest);
        compiled_->computes_columns |= production.values.has_value();
    }
}

}  // namespace

bool Descent::in_place() const {
    if (carries.size() != heirs.size()) return false;
    for (std::uint32_t k = 0; k < carries.size(); ++k) {
        if (carries[k] != k) return false;
    }
    return true;
}

Variables CompiledSystem::variables() const {
    Variables fresh;
    fresh.globals.assign(std::max<std::size_t>(2, system->globals.size()), 0);
    for (const CompiledArray& array : arrays) {
        std::vector<double>& values = fresh.arrays.emplace_back();
        values.reserve(array.size);
        values = array.values;
        while (values.size() < array.size) {
            end_if_asked();
            values.resize(std::min(array.size, values.size() + filled_at_once));
        }
    }
    return fresh;
}

bool CompiledSystem::uses_files() const {
    bool orders = rules.effects.ordered || decomposition.effects.ordered;
    for (const Program* block : {&start, &start_each, &end_each, &end, &axiom}) orders |= block->effects.ordered;
    return orders;
}

std::size_t CompiledSystem::bytes_of_arrays() const {
    std::size_t values = 0;
    for (const CompiledArray& array : arrays) values += array.size;
    return values * sizeof(double);
}

void require_arrays(const CompiledSystem& system, std::size_t instances, std::size_t memory) {
    const std::size_t bytes = system.bytes_of_arrays();
    if (bytes == 0 || bytes <= memory / instances) return;
    const auto smaller = [](const CompiledArray& a, const CompiledArray& b) { return a.size < b.size; };
    const auto largest = std::max_element(system.arrays.begin(), system.arrays.end(), smaller);
    const Place& place = system.system->arrays[static_cast<std::size_t>(largest - system.arrays.begin())].place;
    std::string message = fmt::format("{}{}array '{}' takes {} MiB", to_string(place), place.known() ? ": " : "",
                                      largest->name, largest->size * sizeof(double) >> 20);
    if (system.arrays.size() > 1) message += fmt::format(", all arrays {} MiB", bytes >> 20);
    if (instances > 1) message += fmt::format(" in each of {} sub-L-systems", instances);
    throw RunError(message + fmt::format("; {} MiB of memory are left{}", memory >> 20, excerpt(place)));
}

std::shared_ptr<const CompiledModel> compile(std::shared_ptr<const Model> model) {
    auto compiled = std::make_shared<CompiledModel>();
    for (std::size_t k = 0; k < model->systems.size(); ++k) {
        compiled->systems.push_back(SystemCompiler(*model, k).compile());
    }
    compiled->enclosure = enclosure_of(model->alphabet);
    compiled->nested = compiled->enclosure.open != no_letter || compiled->enclosure.open_scaled != no_letter;
    compiled->uses_context = compiled->any(&CompiledSystem::uses_context);
    compiled->binds_context = compiled->any(&CompiledSystem::binds_context);
    compiled->uses_files = compiled->any(&CompiledSystem::uses_files);
    compiled->has_memory = compiled->uses_files || compiled->any(&CompiledSystem::has_arrays);
    compiled->samples = compiled->any(&CompiledSystem::samples);
    compiled->source = std::move(model);
    require_lenders(*compiled);
    return compiled;
}

const Model& source_of(const CompiledModel& compiled) {
    return *compiled.source;
}

bool has_order(const CompiledModel& compiled) {
    return compiled.nested || compiled.main().ordered();
}

bool uses_random_numbers(const CompiledModel& compiled) {
    return compiled.any(&CompiledSystem::samples);
}

}  // namespace espalier::lsystem
