// The parts of a review. Each adds what it finds.
#pragma once

#include "language/review/findings.h"
#include "language/review/model_uses.h"

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
    ModuleReview(const ModelUses& uses, const std::vector<std::string>& turtle_symbols, Findings& findings)
        : uses_(uses), turtle_symbols_(turtle_symbols), findings_(findings) {}

    void review_axiom(const std::vector<ModuleTemplate>& axiom);
    void review_successor(const Production& production);
    /// After all strings: polygons that no string of the model closes or opens.
    void review_ends_of_polygons();
    /// Productions that replace a part of a turtle symbol, too.
    void review_symbol_parts(const LSystem& system);

private:
    /// The letters that stand alone in some strings, and those in symbols of the turtle with the symbol.
    struct SymbolParts {
        std::set<LetterId> alone;
        std::map<LetterId, std::string> parts;
    };

    void review_brackets(const std::vector<ModuleTemplate>& modules, const char* where);
    void review_polygons(const std::vector<ModuleTemplate>& modules, const char* where,
                         const std::vector<ModulePattern>& replaced);
    void review_symbols(const std::vector<ModuleTemplate>& modules);
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
    const std::vector<std::string>& turtle_symbols_;
    Findings& findings_;
    std::set<LetterId> reported_;
    /// Where a string has no '}' for a '{', or no '{' for a '}', with the kind of string.
    std::vector<std::pair<Place, const char*>> unclosed_, unopened_;
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
