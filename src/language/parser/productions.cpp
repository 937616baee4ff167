#include "language/parser/productions.h"

#include "language/parser/lookalikes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace espalier::language {

Production ProductionParser::production() {
    Production result;
    in_.skip();
    result.place = names_.place(in_.here());
    names_.set_formals(&result.formals);
    try {
        parts(result);
    } catch (...) {
        names_.set_formals(nullptr);
        throw;
    }
    names_.set_formals(nullptr);
    return result;
}

void ProductionParser::parts(Production& production) {
    const Location begin = in_.here();
    production.strict = patterns(production, false);
    if (in_.accept("<")) {
        production.left = std::move(production.strict);
        production.strict = patterns(production, false);
    }
    if (production.strict.empty()) throw SyntaxError{begin, "the predecessor is empty: no module to be replaced"};
    if (in_.accept(">")) production.right = patterns(production, true);
    if (in_.looking_at("<")) {
        throw SyntaxError{in_.here(), "a left context comes before the predecessor: left < strict > right"};
    }
    if (in_.accept(":")) conditions(production);
    expect_arrow();
    production.successor = successor();
    if (in_.accept(":")) {
        in_.skip();
        if (!first_weight_) first_weight_ = in_.here();
        production.weight = expressions_.expression();
    }
    if (!in_.at_end()) in_.expected("the end of the line after the production");
}

void ProductionParser::conditions(Production& production) {
    if (in_.looking_at("{")) production.before = expressions_.block();
    in_.skip();
    const bool none = in_.arrow() > 0 || in_.peek() == '{' || in_.accept("*");
    if (!none) production.condition = expressions_.condition();
    if (in_.looking_at("{")) production.after = expressions_.block();
}

void ProductionParser::expect_arrow() {
    in_.skip();
    if (const std::size_t length = in_.arrow()) {
        in_.take(length);
        return;
    }
    in_.expected("'-->'");
}

bool ProductionParser::at_end_of_patterns() {
    if (in_.at_end() || in_.arrow() > 0) return true;
    const char c = in_.peek();
    return c == '<' || c == '>' || c == ':';
}

std::vector<ModulePattern> ProductionParser::patterns(Production& production, bool right_context) {
    std::vector<ModulePattern> result;
    if (in_.accept("*")) {
        if (!at_end_of_patterns()) in_.expected("nothing beside '*', which means no module");
        return result;
    }
    while (!at_end_of_patterns()) result.push_back(pattern(production, right_context));
    return result;
}

// `{ x = 1; }` among the modules of the predecessor.
bool ProductionParser::looking_at_block() {
    if (in_.peek() != '{') return false;
    const std::string_view line = in_.text(in_.position(), in_.end_of_line(in_.position()));
    const std::size_t assignment = line.find('=');
    const std::size_t semicolon = line.find(';', std::min(assignment, line.size()));
    return semicolon < line.find('}') && line.find('}') < line.size();
}

ModulePattern ProductionParser::pattern(Production& production, bool right_context) {
    ModulePattern result;
    const Location at = in_.here();
    if (looking_at_block()) {
        mistakes_.warning(at,
                          "this is read as modules of the predecessor; a block comes after a ':', as in "
                          "A : { x = 1; } --> B");
    }
    const std::string_view name = symbol();
    names_quote_ |= name == "'";
    result.place = names_.place(at);
    result.first_formal = static_cast<std::uint32_t>(production.formals.size());
    if (!without_parameters(name) && in_.accept("(")) {
        const Scanner::Inside inside(in_);
        do {
            in_.skip();
            const Location formal_at = in_.here();
            const std::string formal(in_.accept_name());
            if (formal.empty()) in_.expected("the name of a parameter (values are compared in the condition)");
            const std::vector<std::string>& known = production.formals;
            if (std::find(known.begin(), known.end(), formal) != known.end()) {
                mistakes_.error(formal_at, fmt::format("two parameters of this production are called '{}'", formal));
            }
            production.formals.push_back(formal);
        } while (in_.accept(","));
        if (!in_.accept(")")) in_.expected(fmt::format("')' after the parameters of '{}'", name));
    }
    const std::size_t arity = production.formals.size() - result.first_formal;
    result.skip_branch = right_context && name == "=" && arity == 0;
    if (!result.skip_branch) result.letter = letter(name, arity, at);
    return result;
}

std::vector<ModuleTemplate> ProductionParser::successor() {
    std::vector<ModuleTemplate> result;
    const auto ended = [&] { return in_.at_end() || in_.peek() == ':'; };
    if (ended()) {
        mistakes_.warning(in_.missing_at(),
                          "this successor is empty, as if '*' stood here (a line that goes on begins with a TAB)");
    }
    if (in_.accept("*")) {
        if (!ended()) in_.expected("nothing beside '*', which means no module");
        return result;
    }
    while (!ended()) result.push_back(module());
    return result;
}

std::vector<ModuleTemplate> ProductionParser::axiom() {
    std::vector<ModuleTemplate> result;
    if (in_.at_end()) in_.expected("the modules of the axiom");
    if (in_.accept("*") && in_.at_end()) return result;
    while (!in_.at_end()) result.push_back(module());
    return result;
}

ModuleTemplate ProductionParser::module() {
    ModuleTemplate result;
    const Location at = in_.here();
    const std::string_view name = symbol();
    if (name == "'" && !first_quote_) first_quote_ = at;
    result.place = names_.place(at);
    if (!without_parameters(name) && in_.accept("(")) {
        const Scanner::Inside inside(in_);
        do {
            Expression argument = expressions_.argument(true);
            if (argument.kind == Expression::Kind::text) argument.index = text_index(argument.text);
            result.arguments.push_back(std::move(argument));
        } while (in_.accept(","));
        if (!in_.accept(")")) in_.expected(fmt::format("')' after the parameters of '{}'", name));
    }
    result.letter = letter(name, result.arguments.size(), at);
    return result;
}

// `Seed()`, of a module that is declared without parameters, is `Seed`.
bool ProductionParser::without_parameters(std::string_view symbol) {
    const std::vector<std::size_t>* const declared = symbols_.declared_arities(symbol);
    if (!declared || std::find(declared->begin(), declared->end(), 0) == declared->end()) return false;
    const std::string_view rest = in_.rest();
    const std::size_t close = rest.starts_with('(') ? rest.find_first_not_of(" \t", 1) : std::string_view::npos;
    if (close == std::string_view::npos || rest[close] != ')') return false;
    in_.take(close + 1);
    return true;
}

std::string_view ProductionParser::symbol() {
    const Location at = in_.here();
    if (in_.arrow() > 0) throw SyntaxError{at, "'-->' cannot stand here: is the end of a line missing?"};
    const std::string_view name = symbols_.at(in_.rest());
    if (name.empty()) {
        const char c = in_.peek();
        if (c == '(') throw SyntaxError{at, "these parameters belong to no module"};
        if (c == ')') throw SyntaxError{at, "this ')' closes nothing"};
        if (c == '*') throw SyntaxError{at, "'*' means no module and must be alone"};
        in_.expected("a module");
    }
    if (name == "\"") throw SyntaxError{at, "text may be only among the parameters of a module"};
    tell_lookalike(name, at);
    in_.take(name.size());
    return name;
}

// Any character may be a module, and yet these are seldom meant to be one.
void ProductionParser::tell_lookalike(std::string_view symbol, Location at) {
    if (static_cast<unsigned char>(symbol.front()) < 0x80 || symbols_.declared_arities(symbol)) return;
    const std::string found = lookalike(symbol);
    if (found.empty() || !lookalikes_.insert(std::string(symbol)).second) return;
    mistakes_.insist(at, fmt::format("this is a module of its own: {}", found));
}

LetterId ProductionParser::letter(std::string_view symbol, std::size_t arity, Location at) {
    if (const std::vector<std::size_t>* declared = symbols_.declared_arities(symbol)) {
        if (std::find(declared->begin(), declared->end(), arity) == declared->end()) {
            mistakes_.error(at, fmt::format("'{}' is declared with {} parameter{}, not {}", symbol, declared->front(),
                                            declared->front() == 1 ? "" : "s", arity));
        }
    }
    if (arity > 60'000) throw SyntaxError{at, "a module has at most 60,000 parameters"};
    try {
        return model_->alphabet.letter(symbol, static_cast<int>(arity));
    } catch (const UserError& error) {
        throw SyntaxError{at, error.what()};
    }
}

std::uint32_t ProductionParser::text_index(const std::string& text) {
    const auto [found, is_new] = texts_.try_emplace(text, static_cast<std::uint32_t>(model_->texts.size()));
    if (is_new) model_->texts.push_back(text);
    return found->second;
}

std::vector<SymbolId> ProductionParser::symbol_list() {
    std::vector<SymbolId> result;
    if (in_.accept("*")) {
        if (!in_.at_end()) in_.expected("nothing beside '*', which means no module");
        return result;
    }
    while (!in_.at_end()) {
        const std::string_view name = symbol();
        names_quote_ |= name == "'";
        result.push_back(model_->alphabet.symbol(name));
    }
    return result;
}

std::optional<Location> ProductionParser::take_first_weight() {
    return std::exchange(first_weight_, std::nullopt);
}

}  // namespace espalier::language
