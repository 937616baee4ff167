// What is legal in a model and yet probably not meant.
#include "espalier/base/file.h"
#include "espalier/language/reader.h"

#include "base/text.h"
#include "language/parser/constant.h"
#include "language/parser/visit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace espalier::language {
namespace {

using language::constant_value;

class Review {
public:
    Review(const Model& model, const std::vector<std::string>& turtle_symbols)
        : model_(model), turtle_symbols_(turtle_symbols) {}

    std::vector<Diagnostic> run() {
        for (const LSystem& system : model_.systems) collect(system);
        for (const LSystem& system : model_.systems)
            for_each_production(system, [&](const Production& production) { review_word(production); });
        for (const LSystem& system : model_.systems) {
            for (const RuleSet* rules : {&system.decomposition, &system.homomorphism})
                review(rules->productions, false);
            review(system.productions, system.seed.has_value());
            review_filter(system);
            review_homomorphism(system.homomorphism);
            review_brackets(system.axiom, "axiom");
            review_polygons(system.axiom);
            review_modules(system.axiom);
            for (const Block* block : {&system.start, &system.start_each, &system.end_each, &system.end})
                review_statements(*block);
            for_each_production(system, [&](const Production& production) {
                review_statements(production.before);
                if (production.condition) review_condition(*production.condition);
                review_statements(production.after);
            });
            review_symbol_parts(system);
        }
        review_processes();
        review_calls();
        std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) {
            return std::tie(a.place.file, a.place.line, a.place.column) <
                   std::tie(b.place.file, b.place.line, b.place.column);
        });
        return std::move(found_);
    }

private:
    template <class Visit>
    static void for_each_production(const LSystem& system, Visit&& visit) {
        for (const Production& production : system.productions) visit(production);
        for (const Production& production : system.decomposition.productions) visit(production);
        for (const Production& production : system.homomorphism.productions) visit(production);
    }

    void collect(const LSystem& system) {
        for (const ModuleTemplate& module : system.axiom) produced_.insert(module.letter);
        for_each_production(system, [&](const Production& production) {
            for (const ModuleTemplate& module : production.successor) produced_.insert(module.letter);
            for (const auto* part : {&production.left, &production.strict, &production.right}) {
                for (const ModulePattern& pattern : *part) {
                    if (!pattern.skip_branch) mentioned_.insert(model_.alphabet.symbol_of(pattern.letter));
                }
            }
        });
        mentioned_.insert(system.filtered.begin(), system.filtered.end());
        for_each_module(system, [&](const ModuleTemplate& module) { collect_call(module); });
    }

    template <class Visit>
    static void for_each_module(const LSystem& system, Visit&& visit) {
        for (const ModuleTemplate& module : system.axiom) visit(module);
        for_each_production(system, [&](const Production& production) {
            for (const ModuleTemplate& module : production.successor) visit(module);
        });
    }

    // ?(id) and ?(id, scale) call an L-system of the file.
    bool calls(LetterId letter) const {
        const int arity = model_.alphabet.arity(letter);
        return model_.alphabet.name(letter) == "?" && (arity == 1 || arity == 2);
    }

    void collect_call(const ModuleTemplate& module) {
        if (!calls(module.letter)) return;
        const std::optional<double> id = constant_value(module.arguments.front());
        if (id) {
            called_.emplace(fmt::format("{}", *id), module.place);
        } else {
            calls_any_ = true;
        }
    }

    void review_calls() {
        std::set<std::string> labels;
        for (const LSystem& system : model_.systems) labels.insert(system.label);
        for (const auto& [label, place] : called_) {
            if (!labels.contains(label)) warn(place, fmt::format("no L-system of this file has the label {}", label));
        }
        for (std::size_t i = 1; i < model_.systems.size() && !calls_any_; ++i) {
            const LSystem& system = model_.systems[i];
            if (called_.contains(system.label)) continue;
            const Place place = system.productions.empty() ? Place{} : system.productions.front().place;
            warn(place, fmt::format("the L-system with the label {0} is never called: ?({0}) ... $", system.label));
        }
    }

    // --- productions --------------------------------------------------------------------------------------------

    void review(const std::vector<Production>& productions, bool stochastic) {
        unconditional_.clear();
        for (const Production& production : productions) {
            review_applicability(production);
            if (!stochastic) review_shadow(production);
            review_brackets(production.successor, "successor");
            review_polygons(production.successor);
            review_modules(production.successor);
        }
        if (stochastic) review_weights(productions);
    }

    // --- words that are not declared ------------------------------------------------------------------------------

    /// How many modules from `i` on spell a word such as Apex, of which only the last has parameters; 0: no word.
    template <class Modules>
    std::size_t word_length(const Modules& modules, std::size_t i) const {
        std::size_t length = 0;
        while (i + length < modules.size()) {
            const LetterId letter = modules[i + length].letter;
            const std::string& name = model_.alphabet.name(letter);
            const char first = length == 0 ? 'A' : 'a';
            if (name.size() != 1 || name[0] < first || name[0] > first + 25) break;
            ++length;
            if (model_.alphabet.arity(letter) > 0) break;
        }
        return length >= shortest_word ? length : 0;
    }

    /// Modules are single letters: a word needs a declaration.
    void review_word(const Production& production) {
        const std::size_t length = word_length(production.strict, 0);
        if (length == 0 || length != production.strict.size()) return;
        std::string name;
        for (const ModulePattern& pattern : production.strict) name += model_.alphabet.name(pattern.letter);
        const ModulePattern& last = production.strict.back();
        const auto first = production.formals.begin() + last.first_formal;
        const std::vector<std::string> parameters(first, first + model_.alphabet.arity(last.letter));
        const std::string declared =
            parameters.empty() ? name : fmt::format("{}({})", name, fmt::join(parameters, ", "));
        if (!words_.insert(name).second) return;
        warn(production.place, fmt::format("'{}' is read as {} modules of one letter each: 'module {};' before "
                                           "'lsystem:' makes it one module",
                                           name, length, declared));
    }

    bool is_word(const Production& production) const {
        return !words_.empty() && word_length(production.strict, 0) == production.strict.size();
    }

    void review_applicability(const Production& production) {
        if (is_word(production)) return;
        for (const auto* part : {&production.strict, &production.left, &production.right}) {
            for (const ModulePattern& pattern : *part) {
                if (pattern.skip_branch || produced_.contains(pattern.letter)) continue;
                warn(pattern.place, fmt::format("this production can never apply: nothing produces {}{}",
                                                described(pattern.letter), why_not(pattern.letter)));
                return;
            }
        }
        if (model_.arithmetic == Arithmetic::cpfg) review_left_brackets(production);
        if (!production.condition) return;
        const std::optional<double> value = constant_value(*production.condition);
        if (value == 0) warn(production.condition->place, "this production can never apply: its condition is always 0");
    }

    void review_left_brackets(const Production& production) {
        const auto is_bracket = [](const ModulePattern& pattern) { return pattern.letter <= Alphabet::close_bracket; };
        const auto bracket = std::find_if(production.left.begin(), production.left.end(), is_bracket);
        if (bracket == production.left.end()) return;
        warn(bracket->place,
             "this production can never apply: with the arithmetic of cpfg, brackets in a left context do not match");
    }

    void review_shadow(const Production& late) {
        const auto takes_all = [&](const Production* early) {
            return early->strict.size() <= late.strict.size() &&
                   std::equal(early->strict.begin(), early->strict.end(), late.strict.begin(),
                              [](const auto& a, const auto& b) { return a.letter == b.letter; });
        };
        std::vector<const Production*>& unconditional = unconditional_[late.strict.front().letter];
        const auto early = std::find_if(unconditional.begin(), unconditional.end(), takes_all);
        if (early != unconditional.end()) {
            warn(late.place, fmt::format("this production can never apply: the one in {} takes all its modules",
                                         to_string((*early)->place)));
        } else if (late.left.empty() && late.right.empty() && !late.condition) {
            unconditional.push_back(&late);
        }
    }

    /// The productions of one strict predecessor in a stochastic L-system.
    struct Pool {
        const Production* first = nullptr;
        const Production* fallback = nullptr;  ///< without context and condition
        std::size_t size = 0;
        bool any_chance = false;
        bool any_weight = false;
        bool all_fractions = true;  ///< every weight is a number below 1, and nothing but chance decides
        double weights = 0;         ///< their sum
    };

    void review_weights(const std::vector<Production>& productions) {
        std::map<std::vector<LetterId>, Pool> pools;
        for (const Production& production : productions) {
            std::vector<LetterId> letters;
            for (const ModulePattern& pattern : production.strict) letters.push_back(pattern.letter);
            Pool& pool = pools[letters];
            if (!pool.first) pool.first = &production;
            const bool always = production.left.empty() && production.right.empty() && !production.condition;
            if (always) pool.fallback = &production;
            const double weight = production.weight ? constant_value(*production.weight).value_or(computed) : computed;
            pool.all_fractions = pool.all_fractions && always && weight < 1;
            pool.weights += weight;
            ++pool.size;
            pool.any_weight = pool.any_weight || production.weight;
            pool.any_chance = pool.any_chance || weight != 0;
        }
        for (const auto& [letters, pool] : pools) review_pool(pool, described(letters.front()));
    }

    void review_pool(const Pool& pool, const std::string& predecessor) {
        if (!pool.any_chance) {
            warn(pool.first->place, fmt::format("all productions of {} have weight 0", predecessor));
        }
        if (pool.size > 1 && pool.fallback && !pool.any_weight) {
            warn(pool.fallback->place,
                 fmt::format("with 'seed:' this production is drawn as often as each of the others of {} that match, "
                             "whatever their order: give it a condition, or all of them weights",
                             predecessor));
        }
        // Older notations write probabilities here.
        if (pool.size > 1 && pool.all_fractions && pool.any_chance && std::abs(pool.weights - 1) > rounded_weights) {
            warn(pool.first->place,
                 fmt::format("the weights of {} sum to {:.3g}: they are not probabilities, each is divided by this sum",
                             predecessor, pool.weights));
        }
    }

    void review_polygons(const std::vector<ModuleTemplate>& modules) {
        int open = 0;
        for (const ModuleTemplate& module : modules) {
            const std::string& symbol = model_.alphabet.name(module.letter);
            if (symbol == "{" && open++ == 1) {
                warn(module.place,
                     "this polygon begins within another one, whose vertices it does not share: is a "
                     "'}' missing?");
            }
            if (symbol == "}" && open > 0) --open;
        }
    }

    void review_brackets(const std::vector<ModuleTemplate>& modules, const char* where) {
        std::vector<const ModuleTemplate*> open;
        for (const ModuleTemplate& module : modules) {
            if (module.letter == Alphabet::open_bracket) open.push_back(&module);
            if (module.letter != Alphabet::close_bracket) continue;
            if (open.empty()) {
                warn(module.place, fmt::format("this ']' closes no branch of this {}", where));
                return;
            }
            open.pop_back();
        }
        if (!open.empty())
            warn(open.back()->place, fmt::format("this branch is not closed in this {}: ']' is missing", where));
    }

    // --- modules ------------------------------------------------------------------------------------------------

    void review_modules(const std::vector<ModuleTemplate>& modules) {
        for (std::size_t i = 0; i < modules.size(); ++i) {
            const LetterId letter = modules[i].letter;
            const std::string& symbol = model_.alphabet.name(letter);
            if (const std::size_t length = words_.empty() ? 0 : word_length(modules, i); length > 0) {
                i += length - 1;
            } else if (symbol == "'") {
                // The reader has said so.
            } else if (symbol == "?" && model_.alphabet.arity(letter) == 0) {
                review_question(modules, i);
                ++i;  // the letter of ?E, ?P, ... belongs to it
            } else if (symbol == "~") {
                ++i;  // the name of a surface
            } else if (const std::size_t drawn = turtle_symbol_length(modules, i); drawn > 0) {
                i += drawn - 1;
            } else if (!turtle_symbols_.empty() && !is_known(symbol) && reported_.insert(letter).second) {
                warn(modules[i].place, fmt::format("{} has no effect: no production names it and the turtle does not "
                                                   "know it",
                                                   described(letter)));
            }
        }
    }

    /// The letters that stand alone in some strings, and those in symbols of the turtle with the symbol.
    struct Uses {
        std::set<LetterId> alone;
        std::map<LetterId, std::string> parts;
    };

    // A production of T finds the T of @Ts as well. That is meant where T stands in @Ts only, say for O(d) --> O(2 * d)
    // and @O(1), and hardly where it stands alone too.
    void review_symbol_parts(const LSystem& system) {
        Uses uses;
        collect_uses(system.axiom, {}, uses);
        for (const auto* productions : {&system.productions, &system.decomposition.productions}) {
            for (const Production& production : *productions) collect_uses(production, uses);
        }
        review_symbol_parts(system.productions, uses);
        review_symbol_parts(system.decomposition.productions, uses);
        if (system.homomorphism.maximum_depth) {
            for (const Production& production : system.homomorphism.productions) collect_uses(production, uses);
        }
        review_symbol_parts(system.homomorphism.productions, uses);
    }

    void collect_uses(const Production& production, Uses& uses) const {
        collect_uses(production.successor, production.strict.front().letter, uses);
    }

    // A letter that replaces itself stands alone there only because its symbol's beginning stays where it is.
    void collect_uses(const std::vector<ModuleTemplate>& modules, std::optional<LetterId> replaced, Uses& uses) const {
        for (std::size_t i = 0; i < modules.size();) {
            const LetterId letter = modules[i].letter;
            const std::string& symbol = model_.alphabet.name(letter);
            const bool pair = symbol == "~" || (symbol == "?" && model_.alphabet.arity(letter) == 0);
            const std::size_t length = pair ? 2 : std::max<std::size_t>(1, turtle_symbol_length(modules, i));
            if (length == 1 && letter != replaced) uses.alone.insert(letter);
            for (std::size_t k = i + 1; k < i + length && !pair; ++k) {
                uses.parts.emplace(modules[k].letter, word(modules, i, length));
            }
            i += length;
        }
    }

    void review_symbol_parts(const std::vector<Production>& productions, const Uses& uses) {
        for (const Production& production : productions) {
            const LetterId letter = production.strict.front().letter;
            const bool plain = production.strict.size() == 1 && production.left.empty();
            if (!plain || !uses.alone.contains(letter) || !uses.parts.contains(letter)) continue;
            warn(production.place, fmt::format("this production replaces the {} in {} too: call the module otherwise",
                                               described(letter), uses.parts.at(letter)));
        }
    }

    std::string word(const std::vector<ModuleTemplate>& modules, std::size_t begin, std::size_t length) const {
        std::string result;
        for (std::size_t i = begin; i < begin + length; ++i) result += model_.alphabet.name(modules[i].letter);
        return result;
    }

    // How many modules from `i` on spell a symbol of the turtle, such as @o or @Gs; the longest counts.
    std::size_t turtle_symbol_length(const std::vector<ModuleTemplate>& modules, std::size_t i) const {
        std::size_t longest = 0;
        for (std::size_t length = 1; length <= std::min<std::size_t>(4, modules.size() - i); ++length) {
            const auto last = turtle_symbols_.end();
            if (std::find(turtle_symbols_.begin(), last, word(modules, i, length)) != last) longest = length;
        }
        return longest;
    }

    bool is_known(const std::string& symbol) const {
        if (mentioned_.contains(*model_.alphabet.find_symbol(symbol)) || symbol.front() == '?') return true;
        if (symbol == "[" || symbol == "]" || symbol == "%") return true;
        if (symbol == "$" && (calls_any_ || !called_.empty())) return true;
        return std::find(turtle_symbols_.begin(), turtle_symbols_.end(), symbol) != turtle_symbols_.end();
    }

    // `?` asks the environment (?E), the turtle (?P ?H ?L ?U ?Q), or a process the model declares.
    void review_question(const std::vector<ModuleTemplate>& modules, std::size_t i) {
        std::string asked;
        for (std::size_t k = i + 1; k < modules.size(); ++k) {
            const std::string& symbol = model_.alphabet.name(modules[k].letter);
            const bool letter = symbol.size() == 1 && ((symbol[0] >= 'a' && symbol[0] <= 'z') ||
                                                       (symbol[0] >= 'A' && symbol[0] <= 'Z') || symbol[0] == '_');
            if (!letter) break;
            asked += symbol;
            if (model_.alphabet.arity(modules[k].letter) > 0) break;
        }
        if (!asked.empty() && std::string_view("EPHLUQ").find(asked.front()) != std::string_view::npos) return;
        if (asked.empty()) {
            warn(modules[i].place, "this query names no process");
        } else {
            warn(modules[i].place, fmt::format("no process answers '?{0}': declare 'environment {0};'{1}", asked,
                                               did_you_mean(asked, model_.processes)));
        }
    }

    void review_processes() {
        for (const std::string& name : model_.processes) {
            const std::optional<SymbolId> symbol = model_.alphabet.find_symbol("?" + name);
            const bool asked = symbol && std::any_of(produced_.begin(), produced_.end(), [&](LetterId letter) {
                                   return model_.alphabet.symbol_of(letter) == *symbol;
                               });
            if (!asked) warn({}, fmt::format("'environment {0};' is declared, but no module '?{0}' asks it", name));
        }
    }

    // --- L-systems ----------------------------------------------------------------------------------------------

    void review_filter(const LSystem& system) {
        if (system.filter != LSystem::Filter::consider) return;
        const auto considered = [&](LetterId letter) {
            return std::find(system.filtered.begin(), system.filtered.end(), model_.alphabet.symbol_of(letter)) !=
                   system.filtered.end();
        };
        if (considered(Alphabet::open_bracket) && considered(Alphabet::close_bracket)) return;
        const Production* first = nullptr;
        for_each_production(system, [&](const Production& production) {
            if (!first && !production.right.empty() && !is_followed(production)) first = &production;
        });
        if (first) {
            warn(first->place,
                 "'consider' does not name the brackets, so that this right context looks into branches as if "
                 "they were the axis: write 'consider: ...[]'");
        }
    }

    /// The right context stands directly behind the predecessor wherever that is written, as ?E(x) behind its apex.
    bool is_followed(const Production& production) const {
        const LetterId predecessor = production.strict.back().letter;
        const auto follows = [&](const std::vector<ModuleTemplate>& modules, std::size_t i) {
            return i + production.right.size() < modules.size() &&
                   std::equal(production.right.begin(), production.right.end(),
                              modules.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                              [](const ModulePattern& pattern, const ModuleTemplate& module) {
                                  return !pattern.skip_branch && pattern.letter == module.letter;
                              });
        };
        bool all = true;
        const auto look_at = [&](const std::vector<ModuleTemplate>& modules) {
            for (std::size_t i = 0; i < modules.size(); ++i)
                all &= modules[i].letter != predecessor || follows(modules, i);
        };
        for (const LSystem& system : model_.systems) {
            look_at(system.axiom);
            for (const Production& each : system.productions) look_at(each.successor);
            for (const Production& each : system.decomposition.productions) look_at(each.successor);
        }
        return all;
    }

    void review_homomorphism(const RuleSet& rules) {
        if (!rules.maximum_depth) return;  // depth 1: nothing is replaced twice
        const std::optional<double> depth = constant_value(*rules.maximum_depth);
        if (depth && *depth <= 1) return;
        std::map<LetterId, std::set<LetterId>> pictures;
        for (const Production& production : rules.productions) {
            if (production.condition) continue;  // which may end it
            for (const ModuleTemplate& module : production.successor) {
                pictures[production.strict.front().letter].insert(module.letter);
            }
        }
        for (const Production& production : rules.productions) {
            if (production.condition || !reaches_itself(pictures, production.strict.front().letter)) continue;
            warn(production.place, fmt::format("the picture of {} contains itself; it ends at the maximum depth only",
                                               described(production.strict.front().letter)));
            return;
        }
    }

    static bool reaches_itself(const std::map<LetterId, std::set<LetterId>>& pictures, LetterId start) {
        std::set<LetterId> seen;
        std::vector<LetterId> waiting{start};
        while (!waiting.empty()) {
            const auto next = pictures.find(waiting.back());
            waiting.pop_back();
            if (next == pictures.end()) continue;
            for (const LetterId letter : next->second) {
                if (letter == start) return true;
                if (seen.insert(letter).second) waiting.push_back(letter);
            }
        }
        return false;
    }

    // --- statements ---------------------------------------------------------------------------------------------

    void review_statements(const Block& block) {
        for (const Statement& statement : block) {
            const bool plain = statement.kind == Statement::Kind::expression;
            if (plain && !acts(*statement.expressions.front())) {
                warn(statement.place, "this statement changes nothing ('=' assigns)");
            }
            const bool conditional = !plain && statement.kind != Statement::Kind::for_loop;
            for (const std::optional<Expression>& expression : statement.expressions) {
                if (conditional && expression) review_condition(*expression);
            }
            for (const Block& body : statement.bodies) review_statements(body);
        }
    }

    void review_condition(const Expression& condition) {
        if (condition.kind != Expression::Kind::assign) return;
        warn(condition.place, "this condition assigns ('==' compares)");
    }

    static bool acts(const Expression& expression) {
        bool found = false;
        language::visit_expression(expression, [&](const Expression& part) {
            found |= part.kind == Expression::Kind::assign || part.kind == Expression::Kind::call;
        });
        return found;
    }

    // --- words --------------------------------------------------------------------------------------------------

    static std::string with_parameters(int arity) {
        if (arity == 0) return "without parameters";
        return fmt::format("with {} parameter{}", arity, arity == 1 ? "" : "s");
    }

    std::string described(LetterId letter) const {
        const int arity = model_.alphabet.arity(letter);
        const std::string& name = model_.alphabet.name(letter);
        return arity == 0 ? fmt::format("'{}'", name) : fmt::format("'{}' {}", name, with_parameters(arity));
    }

    std::string why_not(LetterId letter) const {
        for (const LetterId other : produced_) {
            if (model_.alphabet.symbol_of(other) == model_.alphabet.symbol_of(letter)) {
                return fmt::format(" (only {})", with_parameters(model_.alphabet.arity(other)));
            }
        }
        return "; if it waits for a mouse, --insert puts modules into a string";
    }

    void warn(const Place& place, std::string message) {
        found_.push_back({Diagnostic::Severity::warning, place, std::move(message), source_line(place)});
    }

    std::string source_line(const Place& place) {
        if (!place.known()) return "";
        if (!files_.contains(place.file)) {
            std::vector<std::string> lines;
            // A model that was read from text has no file to show a line of.
            if (std::error_code code; std::filesystem::is_regular_file(place.file, code)) {
                const std::string text = read_text(place.file);
                for (std::size_t start = 0; start < text.size();) {
                    const std::size_t end = std::min(text.find('\n', start), text.size());
                    lines.push_back(text.substr(start, end - start));
                    start = end + 1;
                }
            }
            files_[place.file] = std::move(lines);
        }
        const std::vector<std::string>& lines = files_[place.file];
        const auto line = static_cast<std::size_t>(place.line);
        return line >= 1 && line <= lines.size() ? lines[line - 1] : "";
    }

    const Model& model_;
    const std::vector<std::string>& turtle_symbols_;
    std::set<LetterId> produced_;
    std::set<SymbolId> mentioned_;
    std::set<LetterId> reported_;
    std::set<std::string> words_;  // that productions replace, but that nobody declares
    static constexpr std::size_t shortest_word = 3;
    static constexpr double computed = std::numeric_limits<double>::quiet_NaN();  // a weight that is no number yet
    static constexpr double rounded_weights = 0.02;                               // 0.33, 0.33 and 0.33 sum to one
    std::map<std::string, Place> called_;                                         // labels, and where they are called
    bool calls_any_ = false;                                                      // a label that is computed
    std::map<LetterId, std::vector<const Production*>> unconditional_;            // of the rule set at hand
    std::map<std::string, std::vector<std::string>> files_;
    std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> review(const Model& model, const std::vector<std::string>& turtle_symbols) {
    return Review(model, turtle_symbols).run();
}

}  // namespace espalier::language
