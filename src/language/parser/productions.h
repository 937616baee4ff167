// Reads strings of modules and productions.
#pragma once

#include "espalier/lsystem/lsystem.h"

#include "language/parser/expressions.h"
#include "language/parser/names.h"
#include "language/parser/scanner.h"
#include "language/parser/symbols.h"

#include <optional>
#include <set>
#include <string>
#include <unordered_map>

namespace espalier::language {

class ProductionParser {
public:
    ProductionParser(Scanner& in, Names& names, Mistakes& mistakes, Symbols& symbols, ExpressionParser& expressions)
        : in_(in), names_(names), mistakes_(mistakes), symbols_(symbols), expressions_(expressions) {}

    /// Where letters and texts are entered.
    void set_model(Model& model) { model_ = &model; }

    /// left < strict > right : {before} condition {after} --> successor : weight
    Production production();
    /// Modules up to the end of the statement; brackets must match.
    std::vector<ModuleTemplate> axiom();
    /// The symbols of an ignore or consider list.
    std::vector<SymbolId> symbol_list();
    /// Where a ' stands in a string of modules, if no production and no list names that module.
    std::optional<Location> unread_quote() const { return names_quote_ ? std::nullopt : first_quote_; }
    /// Weights that were read since the last call, for the L-system to allow or not.
    std::optional<Location> take_first_weight();

private:
    void parts(Production& production);
    void conditions(Production& production);
    std::vector<ModulePattern> patterns(Production& production, bool right_context);
    ModulePattern pattern(Production& production, bool right_context);
    bool at_end_of_patterns();
    bool looking_at_block();
    void expect_arrow();
    std::vector<ModuleTemplate> successor();
    ModuleTemplate module();
    bool without_parameters(std::string_view symbol);
    std::string_view symbol();
    void tell_lookalike(std::string_view symbol, Location at);
    LetterId letter(std::string_view symbol, std::size_t arity, Location at);
    std::uint32_t text_index(const std::string& text);

    Scanner& in_;
    Names& names_;
    Mistakes& mistakes_;
    Symbols& symbols_;
    ExpressionParser& expressions_;
    Model* model_ = nullptr;
    std::unordered_map<std::string, std::uint32_t> texts_;  // their places in Model::texts
    std::optional<Location> first_weight_;
    std::optional<Location> first_quote_;
    bool names_quote_ = false;
    std::set<std::string> lookalikes_;  // that were told of
};

}  // namespace espalier::language
