#include "studio/growth/reuse_plan.h"

#include "espalier/lsystem/derivation.h"

#include "lsystem/programs/constant.h"
#include "studio/growth/derivation_length.h"
#include "studio/growth/expressions_of.h"
#include "turtle/asking.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <set>
#include <string>

namespace espalier::studio {
namespace {

using Json = nlohmann::ordered_json;

// What a derivation's memory holds of each plant is kept for every step.
constexpr std::size_t most_plants = 256;

bool calls(const Expression& expression, std::initializer_list<Function> functions) {
    return expression.kind == Expression::Kind::call &&
           std::find(functions.begin(), functions.end(), expression.function) != functions.end();
}

bool uses_files(const Expression& expression) {
    return calls(expression, {Function::file_open, Function::file_close, Function::file_print, Function::file_scan,
                              Function::file_flush});
}

bool reads_resources(const Expression& expression) {
    return calls(expression, {Function::func, Function::curve_x, Function::curve_y, Function::curve_z,
                              Function::curve_gal, Function::view_extent, Function::in_blob});
}

template <class List, class Same>
bool same_all(const List& a, const List& b, const Same& same) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

bool same(const Expression& a, const Expression& b) {
    return a.kind == b.kind && a.op == b.op && a.function == b.function && a.index == b.index &&
           std::bit_cast<std::uint64_t>(a.value) == std::bit_cast<std::uint64_t>(b.value) && a.text == b.text &&
           same_all(a.operands, b.operands, [](const auto& x, const auto& y) { return same(x, y); });
}

bool same(const std::optional<Expression>& a, const std::optional<Expression>& b) {
    return a && b ? same(*a, *b) : a.has_value() == b.has_value();
}

bool same_block(const Block& a, const Block& b) {
    return same_all(a, b, [](const Statement& x, const Statement& y) {
        return x.kind == y.kind &&
               same_all(x.expressions, y.expressions, [](const auto& e, const auto& f) { return same(e, f); }) &&
               same_all(x.bodies, y.bodies, same_block);
    });
}

bool same(const ArrayDeclaration& a, const ArrayDeclaration& b) {
    const auto equal = [](const Expression& x, const Expression& y) { return same(x, y); };
    return a.external == b.external && same_all(a.dimensions, b.dimensions, equal) &&
           same_all(a.values, b.values, equal);
}

/// Two models, part by part: whether they derive alike, and which parameters they write differently.
class Comparison {
public:
    Comparison(const Model& before, const Model& now) : before_(before), now_(now) {
        for (const LSystem& system : before.systems) {
            note_read(system.productions);
            note_read(system.decomposition.productions);
        }
    }

    /// Both are drawn alike, too.
    bool is_same_drawing() const {
        return same_all(before_.systems, now_.systems, [this](const LSystem& a, const LSystem& b) {
            const RuleSet &x = a.homomorphism, &y = b.homomorphism;
            return x.present == y.present && same(x.maximum_depth, y.maximum_depth) && same(x.seed, y.seed) &&
                   same_all(x.productions, y.productions, [this](const Production& p, const Production& q) {
                       return is_same_left(p, q) && is_same_modules(p.successor, q.successor);
                   });
        });
    }

    /// Null if they do not derive alike.
    std::shared_ptr<const ParameterChanges> changes() {
        const auto asks_alike = [&] {
            return before_.processes == now_.processes && before_.default_answers == now_.default_answers;
        };
        if (before_.arithmetic != now_.arithmetic || !asks_alike()) return nullptr;
        const bool is_same = same_all(before_.systems, now_.systems,
                                      [this](const LSystem& a, const LSystem& b) { return is_same_system(a, b); });
        return is_same ? collected() : nullptr;
    }

private:
    using Slot = std::pair<LetterId, std::size_t>;  // a letter and which of its parameters

    void note_read(const std::vector<Production>& productions) {
        for (const Production& production : productions) {
            for (const auto* patterns : {&production.left, &production.strict, &production.right}) {
                for (const ModulePattern& pattern : *patterns) read_.insert(pattern.letter);
            }
        }
    }

    bool is_same_system(const LSystem& a, const LSystem& b) {
        const auto symbol = [](const Model& model) {
            return [&model](SymbolId id) { return model.alphabet.symbol_name(id); };
        };
        std::vector<std::string> filtered_before, filtered_now;
        std::transform(a.filtered.begin(), a.filtered.end(), std::back_inserter(filtered_before), symbol(before_));
        std::transform(b.filtered.begin(), b.filtered.end(), std::back_inserter(filtered_now), symbol(now_));
        return a.ring == b.ring && same(a.seed, b.seed) && a.filter == b.filter && filtered_before == filtered_now &&
               same_all(a.arrays, b.arrays, [](const auto& x, const auto& y) { return same(x, y); }) &&
               a.globals.size() == b.globals.size() && a.external_globals == b.external_globals &&
               same_block(a.start, b.start) && same_block(a.start_each, b.start_each) &&
               same_block(a.end_each, b.end_each) && same_block(a.end, b.end) && is_same_text(a.axiom, b.axiom) &&
               is_same_rules(a.productions, b.productions) && a.decomposition.present == b.decomposition.present &&
               same(a.decomposition.maximum_depth, b.decomposition.maximum_depth) &&
               same(a.decomposition.seed, b.decomposition.seed) &&
               is_same_rules(a.decomposition.productions, b.decomposition.productions);
    }

    bool is_same_letter(LetterId a, LetterId b) const {
        return a == b && before_.alphabet.name(a) == now_.alphabet.name(b) &&
               before_.alphabet.arity(a) == now_.alphabet.arity(b);
    }

    bool is_same_rules(const std::vector<Production>& a, const std::vector<Production>& b) {
        return same_all(a, b, [this](const Production& x, const Production& y) {
            return is_same_left(x, y) && is_same_text(x.successor, y.successor);
        });
    }

    // All but the successors.
    bool is_same_left(const Production& x, const Production& y) const {
        return is_same_patterns(x.left, y.left) && is_same_patterns(x.strict, y.strict) &&
               is_same_patterns(x.right, y.right) && x.formals.size() == y.formals.size() &&
               same_block(x.before, y.before) && same(x.condition, y.condition) && same_block(x.after, y.after) &&
               same(x.weight, y.weight);
    }

    bool is_same_modules(const std::vector<ModuleTemplate>& a, const std::vector<ModuleTemplate>& b) const {
        return same_all(a, b, [this](const ModuleTemplate& x, const ModuleTemplate& y) {
            return is_same_letter(x.letter, y.letter) &&
                   same_all(x.arguments, y.arguments, [](const auto& e, const auto& f) { return same(e, f); });
        });
    }

    bool is_same_patterns(const std::vector<ModulePattern>& a, const std::vector<ModulePattern>& b) const {
        return same_all(a, b, [this](const ModulePattern& x, const ModulePattern& y) {
            if (x.skip_branch || y.skip_branch) return x.skip_branch == y.skip_branch;  // these have no letter
            return is_same_letter(x.letter, y.letter) && x.first_formal == y.first_formal;
        });
    }

    bool is_same_text(const std::vector<ModuleTemplate>& a, const std::vector<ModuleTemplate>& b) {
        return same_all(a, b, [this](const ModuleTemplate& x, const ModuleTemplate& y) {
            if (!is_same_letter(x.letter, y.letter)) return false;
            for (std::size_t i = 0; i < x.arguments.size(); ++i) {
                if (!note_argument({x.letter, i}, x.arguments[i], y.arguments[i])) return false;
            }
            return true;
        });
    }

    // False if the argument differs and what was derived from it does too.
    bool note_argument(const Slot& slot, const Expression& before, const Expression& now) {
        if (read_.contains(slot.first)) return same(before, now);
        const std::optional<double> old_value = constant_value(before, before_.arithmetic);
        const std::optional<double> new_value = constant_value(now, now_.arithmetic);
        if (!old_value || !new_value) {
            computed_.insert(slot);
            return same(before, now);
        }
        const double from = stored(*old_value, before_.arithmetic), to = stored(*new_value, now_.arithmetic);
        const auto [known, is_new] = constants_[slot].try_emplace(std::bit_cast<std::uint64_t>(from), to);
        return is_new || std::bit_cast<std::uint64_t>(known->second) == std::bit_cast<std::uint64_t>(to);
    }

    // Where a parameter is computed as well, the string does not tell which of its values were constants.
    std::shared_ptr<const ParameterChanges> collected() const {
        auto changes = std::make_shared<ParameterChanges>(now_.alphabet);
        for (const auto& [slot, values] : constants_) {
            for (const auto& [bits, to] : values) {
                if (bits == std::bit_cast<std::uint64_t>(to)) continue;
                if (computed_.contains(slot)) return nullptr;
                changes->add(slot.first, slot.second, std::bit_cast<double>(bits), to);
            }
        }
        return changes;
    }

    const Model &before_, &now_;
    std::set<LetterId> read_;  ///< by productions
    std::set<Slot> computed_;
    std::map<Slot, std::map<std::uint64_t, double>> constants_;
};

// The first step whose insertions differ.
int first_difference(const std::vector<Insertion>& before, const std::vector<Insertion>& now) {
    const auto is_same = [](const Insertion& a, const Insertion& b) {
        return a.modules == b.modules && a.step == b.step && a.before == b.before && a.number == b.number;
    };
    int first = INT_MAX;
    for (std::size_t i = 0; i < std::max(before.size(), now.size()); ++i) {
        if (i < before.size() && i < now.size() && is_same(before[i], now[i])) continue;
        if (i < before.size()) first = std::min(first, before[i].step);
        if (i < now.size()) first = std::min(first, now[i].step);
    }
    return first;
}

// Compares all files but the models' and the scene's, which were compared themselves.
bool has_same_side_files(const Origin& before, const Origin& now) {
    const auto side_files = [](const Origin& origin) {
        std::map<std::filesystem::path, std::uint64_t> digests;
        for (const auto& [path, file] : origin.files) {
            if (path.extension() != ".panel") digests[path] = file.digest;
        }
        if (origin.exchanges) digests.erase(std::filesystem::absolute(origin.scene.path).lexically_normal());
        for (const Plant& plant : origin.scene.plants) {
            digests.erase(std::filesystem::absolute(source_of(*plant.model).path).lexically_normal());
        }
        return digests;
    };
    return side_files(before) == side_files(now);
}

bool derivations_read_resources(const Scene& scene) {
    return std::any_of(scene.plants.begin(), scene.plants.end(), [](const Plant& plant) {
        return holds_in_derivation(source_of(*plant.model).main(), reads_resources);
    });
}

// The settings of a scene but for its stages, what is recorded or shown of it, and what its models are made of: these
// are compared themselves.
std::string settings_without_stages(const Scene& scene) {
    auto settings = Json::parse(scene.root.resolved_json());
    for (const char* key : {"timeline", "panel"}) settings.erase(key);
    if (settings.contains("plant")) {
        for (auto& plant : settings["plant"]) {
            for (const char* key : {"stage", "define", "model"}) plant.erase(key);
        }
    }
    auto processes = Json::array();
    for (const auto& [name, table] : scene.environment.processes) {
        processes.push_back({name, Json::parse(table.resolved_json())});
    }
    return settings.dump() + processes.dump();
}

// Of the turtle they change its colour alone, which no answer depends on.
bool is_of_colours(const ParameterChanges& changes, const Model& model) {
    const std::vector<LetterId> letters = changes.letters();
    return std::all_of(letters.begin(), letters.end(), [&](LetterId letter) {
        const std::string& name = model.alphabet.name(letter);
        return name == ";" || name == ",";
    });
}

// Only their stages and colours differ.
std::optional<ReusePlan> plan_for_stages(const Origin& before, const Origin& now) {
    const std::size_t count = now.scene.plants.size();
    if (settings_without_stages(before.scene) != settings_without_stages(now.scene) ||
        !has_same_side_files(before, now)) {
        return std::nullopt;
    }
    ReusePlan found;
    for (std::size_t i = 0; i < count; ++i) {
        const Plant &a = before.scene.plants[i], &b = now.scene.plants[i];
        Comparison compared(source_of(*a.model), source_of(*b.model));
        const auto changes = compared.changes();
        if (!changes || !is_of_colours(*changes, source_of(*b.model)) || !compared.is_same_drawing())
            return std::nullopt;
        if (a.stream != b.stream || first_difference(a.insertions, b.insertions) != INT_MAX) return std::nullopt;
        if (!changes->empty() && !b.insertions.empty()) return std::nullopt;
        found.plants.push_back(changes->empty() ? nullptr : changes);
    }
    return found;
}

bool is_query(const Model& model, LetterId letter) {
    const std::string& name = model.alphabet.name(letter);
    return name.starts_with('?') || name == "s";
}

// The homomorphism neither reads what is asked, nor remembers what it drew before.
bool draws_the_same_again(const Model& model) {
    const LSystem& system = model.main();
    if (holds_in_homomorphism(system, [](const Expression& e) { return e.kind == Expression::Kind::assign; }))
        return false;
    const auto reads_queries = [&](const std::vector<ModulePattern>& patterns) {
        return std::any_of(patterns.begin(), patterns.end(), [&](const ModulePattern& pattern) {
            return !pattern.skip_branch && is_query(model, pattern.letter);
        });
    };
    const auto& productions = system.homomorphism.productions;
    return std::none_of(productions.begin(), productions.end(), [&](const Production& production) {
        return reads_queries(production.left) || reads_queries(production.strict) || reads_queries(production.right);
    });
}

bool has_same_length(const Origin& before, const Origin& now) {
    const bool depends = depends_on_length(now.scene);
    if (depends != depends_on_length(before.scene)) return false;
    return !depends || before.last_step == now.last_step;
}

}  // namespace

bool draws_apart(const Scene& scene) {
    if (!scene.environment.processes.empty() || scene.plants.size() > most_plants) return false;
    return std::none_of(scene.plants.begin(), scene.plants.end(), [](const Plant& plant) {
        const Model& model = source_of(*plant.model);
        return plant.in_time || plant.drawing_in_time || model.systems.size() > 1 || has_queries(model.alphabet) ||
               holds_in_derivation(model.main(), uses_files);
    });
}

bool stages_draw_apart(const World& world) {
    const Scene& scene = world.scene();
    if (scene.plants.size() > most_plants || scene.path.empty()) return false;
    const Environment& environment = world.environment();
    for (std::size_t process = 0; process < environment.size(); ++process) {
        const Spreading reads = environment.spreading(process);
        if (reads != Spreading::queries && reads != Spreading::reach) return false;
    }
    return std::none_of(scene.plants.begin(), scene.plants.end(), [](const Plant& plant) {
        const Model& model = source_of(*plant.model);
        return plant.in_time || plant.drawing_in_time || model.systems.size() > 1 ||
               holds_in_derivation(model.main(), uses_files) || !fields_read_by(model).empty() ||
               !draws_the_same_again(model);
    });
}

void ParameterChanges::add(LetterId letter, std::size_t parameter, double from, double to) {
    changes_[{letter, parameter}].emplace_back(std::bit_cast<std::uint64_t>(from), to);
}

std::vector<LetterId> ParameterChanges::letters() const {
    std::vector<LetterId> letters;
    for (const auto& [slot, values] : changes_) letters.push_back(slot.first);
    return letters;
}

void ParameterChanges::apply(ModuleString& string) const {
    std::vector<std::vector<std::pair<std::size_t, const Values*>>> of_letter(arities_.size());
    for (const auto& [slot, values] : changes_) of_letter[slot.first].emplace_back(slot.second, &values);
    std::size_t at = 0;
    for (const LetterId letter : string.letters) {
        for (const auto& [parameter, values] : of_letter[letter]) {
            double& value = string.parameters[at + parameter];
            const auto bits = std::bit_cast<std::uint64_t>(value);
            const auto found = std::find_if(values->begin(), values->end(),
                                            [bits](const auto& change) { return change.first == bits; });
            if (found != values->end()) value = found->second;
        }
        at += arities_[letter];
    }
}

bool ReusePlan::changes_strings() const {
    return std::any_of(plants.begin(), plants.end(), [](const auto& plant) { return plant != nullptr; });
}

std::optional<ReusePlan> reuse_plan(const Origin& before, const Origin& now) {
    const std::size_t count = now.scene.plants.size();
    if (before.exchanges != now.exchanges) return std::nullopt;
    if (before.scene.seed != now.scene.seed || before.scene.plants.size() != count || !has_same_length(before, now))
        return std::nullopt;
    if (now.exchanges) return plan_for_stages(before, now);
    const bool reads_resources = derivations_read_resources(now.scene);
    if (reads_resources && !has_same_side_files(before, now)) return std::nullopt;
    ReusePlan found;
    std::map<std::pair<const CompiledModel*, const CompiledModel*>, std::shared_ptr<const ParameterChanges>> compared;
    for (std::size_t i = 0; i < count; ++i) {
        const Plant &a = before.scene.plants[i], &b = now.scene.plants[i];
        if (a.stream != b.stream) return std::nullopt;
        auto& changes = compared[{a.model.get(), b.model.get()}];
        if (!changes) changes = Comparison(source_of(*a.model), source_of(*b.model)).changes();
        if (!changes) return std::nullopt;
        // Inserted modules have parameters of their own, which must not be taken for those of productions.
        const bool inserts = !a.insertions.empty() || !b.insertions.empty();
        if (inserts && !changes->empty()) return std::nullopt;
        found.steps = std::min(found.steps, first_difference(a.insertions, b.insertions));
        found.plants.push_back(changes->empty() ? nullptr : changes);
    }
    return found;
}

}  // namespace espalier::studio
