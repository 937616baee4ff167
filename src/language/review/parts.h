// The parts of a review. Each adds what it finds.
#pragma once

#include "language/review/findings.h"
#include "language/review/model_uses.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace espalier::language {

/// Words that are read as modules of one letter each.
void review_words(const ModelUses& uses, Findings& findings);

/// Productions of one set that can never apply, and their weights. `stochastic`: chance decides between them.
void review_rules(const std::vector<Production>& productions, bool stochastic, const ModelUses& uses,
                  Findings& findings);

/// Strings of modules: brackets, polygons, and modules that nothing knows.
class ModuleReview {
public:
    /// `turtle`: its symbols, with the numbers of parameters on which they act.
    using TurtleSymbols = std::map<std::string, std::vector<int>, std::less<>>;
    ModuleReview(const ModelUses& uses, const TurtleSymbols& turtle, Findings& findings)
        : uses_(uses), turtle_(turtle), findings_(findings) {}

    void review_axiom(const std::vector<ModuleTemplate>& axiom);
    void review_successor(const Production& production);
    /// After all strings: branches and polygons that no string of the model closes or opens.
    void review_ends();
    /// After all strings: modules with a number of parameters that neither productions nor the turtle take.
    void review_numbers_of_parameters();
    /// Productions that replace a part of a turtle symbol, too.
    void review_symbol_parts(const LSystem& system);

private:
    /// The letters that stand alone in some strings, and those in symbols of the turtle with the symbol.
    struct SymbolParts {
        std::set<LetterId> alone;
        std::map<LetterId, std::string> parts;
    };

    /// Where strings do not match: each with the kind of string.
    struct Ends {
        std::vector<std::pair<Place, const char*>> unclosed, unopened;
    };

    void review_brackets(const std::vector<ModuleTemplate>& modules, const char* where);
    void review_polygons(const std::vector<ModuleTemplate>& modules, const char* where,
                         const std::vector<ModulePattern>& replaced);
    void review_symbols(const std::vector<ModuleTemplate>& modules);
    void note_use(const std::vector<ModuleTemplate>& modules, std::size_t last, const std::string& symbol);
    std::string why_untaken(LetterId letter, const std::string& symbol) const;
    std::size_t review_question(const std::vector<ModuleTemplate>& modules, std::size_t i);
    std::string meant_process(const std::string& asked) const;
    void review_symbol_parts(const std::vector<Production>& productions, const SymbolParts& parts);
    void collect_parts(const Production& production, SymbolParts& parts) const;
    void collect_parts(const std::vector<ModuleTemplate>& modules, std::optional<LetterId> replaced,
                       SymbolParts& parts) const;
    std::string word(const std::vector<ModuleTemplate>& modules, std::size_t begin, std::size_t length) const;
    std::size_t turtle_symbol_length(const std::vector<ModuleTemplate>& modules, std::size_t i) const;
    bool is_known(const std::string& symbol) const;

    const ModelUses& uses_;
    const TurtleSymbols& turtle_;
    Findings& findings_;
    std::set<LetterId> reported_;
    Ends branches_, polygons_;
    /// The first place of each letter with parameters, and the symbol that it ends: "@R" of R.
    std::map<LetterId, std::pair<Place, std::string>> uses_of_parameters_;
};

/// Which modules contexts consider.
void review_filter(const LSystem& system, const ModelUses& uses, Findings& findings);
/// Pictures of modules that contain themselves.
void review_homomorphism(const RuleSet& rules, const ModelUses& uses, Findings& findings);
/// Statements and conditions with '=' and '==' in each other's place.
void review_statements(const LSystem& system, Findings& findings);

/// Environments that no module asks.
void review_processes(const ModelUses& uses, Findings& findings);
/// L-systems of the file that no production calls, and calls of those that are not there.
void review_calls(const ModelUses& uses, Findings& findings);

}  // namespace espalier::language
