#include "language/parser/model.h"

#include "base/number.h"
#include "base/text.h"
#include "language/parser/constant.h"
#include "language/parser/declarations.h"
#include "language/parser/expressions.h"
#include "language/parser/keywords.h"
#include "language/parser/label.h"
#include "language/parser/names.h"
#include "language/parser/productions.h"
#include "language/parser/scanner.h"
#include "language/parser/symbols.h"
#include "language/parser/timed.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace espalier::language {
namespace {

// Shorter keywords may be the modules of a predecessor before a condition.
constexpr std::size_t longest_plain_word = 6;

class ModelParser {
public:
    ModelParser(const Preprocessed& source, const Sources& sources, Mistakes& mistakes, Model& model)
        : in_(source.text),
          names_(sources, mistakes, source.macro_names),
          mistakes_(mistakes),
          expressions_(in_, names_, mistakes, model.arithmetic),
          productions_(in_, names_, mistakes, symbols_, expressions_),
          declarations_(in_, names_, mistakes, symbols_, expressions_, model),
          model_(model),
          complete_(mistakes.none()) {
        productions_.set_model(model);
    }

    void run() {
        // Declarations before the first L-system are read with the names of none.
        LSystem before;
        names_.begin(before);
        while (next_statement()) {
            statement([&] { outside(); });
        }
        statement([&] { names_.finish_model(model_); });
        if (const std::optional<Location> quote = productions_.unread_quote()) {
            mistakes_.insist(*quote,
                             "nothing reads this module ': in older notation it takes the next colour, in cpfg ; does");
        }
        if (model_.systems.empty() && complete_ && !outside_reported_) {
            mistakes_.error(in_.here(), "there is no L-system here: 'lsystem: 1' ... 'endlsystem' is missing");
        }
    }

private:
    bool next_statement() {
        in_.skip_lines();
        return !in_.at_end_of_text();
    }

    // Runs one statement's reading; after a mistake goes on with the next statement.
    template <class Reading>
    void statement(Reading&& reading) {
        const std::size_t start = in_.position();
        try {
            reading();
        } catch (const SyntaxError& mistake) {
            mistakes_.error(mistake);
            expressions_.reset();
            names_.set_constants_only(false);
            names_.set_formals(nullptr);
            in_.recover(start);
            names_.note_skipped(in_.text(start, in_.position()));
        }
    }

    void outside() {
        if (declarations_.declaration()) return;
        if (!accept_lsystem()) {
            const std::string keyword = nearest_keyword();
            const bool fits = keyword == "lsystem" || keyword == "module" || keyword == "environment" ||
                              keyword == "const" || keyword == "field" || keyword.starts_with('#');
            if (keyword.empty() && !model_.systems.empty()) {
                if (!std::exchange(outside_reported_, true)) {
                    const bool has_productions = in_.rest().find("-->") != Scanner::npos;
                    const char* const message = "text after 'endlsystem' is ignored";
                    has_productions ? mistakes_.insist(in_.here(), message) : mistakes_.warning(in_.here(), message);
                }
                in_.recover(in_.position());
                return;
            }
            // Without its head every line of an L-system is outside: the first is reported.
            if (fits || model_.systems.size() > 0 || !std::exchange(outside_reported_, true)) {
                mistakes_.error(in_.here(), fmt::format("expected 'lsystem:', found '{}'{}{}", words_of_line(),
                                                        fits ? hint(keyword) : "", fits ? "" : whole_model()));
            }
            if (keyword != "lsystem") {
                in_.recover(in_.position());
                return;
            }
            in_.accept_name();
        }
        if (!in_.accept(":"))
            mistakes_.error({in_.missing_at(), fmt::format("expected ':' after 'lsystem', found {}", in_.found())});
        lsystem();
    }

    /// What stands around a line that belongs in an L-system; empty for all others.
    const char* whole_model() {
        if (!in_.statement_has_arrow() && !begins_item()) return "";
        return ": this is a part of a model, which begins with lines 'lsystem: 1', 'derivation length: 5' and 'axiom: "
               "...' "
               "and ends with 'endlsystem'";
    }

    bool accept_lsystem() { return in_.accept_keyword("lsystem") || in_.accept_keyword("l-system"); }

    // --- one L-system -------------------------------------------------------------------------------------------

    void lsystem() {
        model_.systems.emplace_back();
        system_ = &model_.systems.back();
        axiom_read_ = false;
        looked_ahead_ = false;
        names_.begin(*system_, model_.systems.size() - 1);
        productions_.take_first_weight();
        timed_ = {};
        const Location begin = in_.here();
        label();
        rules_ = nullptr;
        weight_reported_ = false;
        bool ended = false;
        while (!ended && next_statement()) {
            statement([&] { ended = line(); });
        }
        if (!ended && complete_) mistakes_.warning(in_.here(), "'endlsystem' is missing at the end of the file");
        // A sub-L-system's axiom is never used.
        if (!axiom_read_ && model_.systems.size() == 1)
            mistakes_.error(begin, "this L-system has no axiom: 'axiom: ...' is missing");
        timed_.add_to(*system_, model_.alphabet);
        names_.finish();
    }

    // Only sub-L-systems are called by their labels; the first L-system's may be anything.
    void label() {
        in_.skip();
        const Location at = in_.here();
        const std::size_t begin = in_.position();
        in_.take(in_.end_of_line(begin) - begin);
        std::string_view text = in_.text(begin, in_.position());
        while (!text.empty() && (is_blank(text.back()) || text.back() == ';')) text.remove_suffix(1);
        system_->label = text;
        if (const std::optional<int> number = whole_text_as<int>(text)) {
            system_->label = std::to_string(*number);
            const auto [first, is_new] = labels_.try_emplace(*number, at);
            if (is_new) return;
            mistakes_.error(at, fmt::format("an L-system with the label {} is in {} already", *number,
                                            to_string(names_.place(first->second))));
        } else if (model_.systems.size() > 1) {
            mistakes_.error(
                at, fmt::format("expected the number by which ?(number) calls this L-system, found '{}'", text));
        }
    }

    /// One line of an L-system; true at its end.
    bool line() {
        if (begins_item()) {
            if (in_.looking_at_keyword("lsystem")) {
                mistakes_.warning(in_.here(), "'endlsystem' is missing before this L-system");
                return true;
            }
            if (in_.accept_keyword("endlsystem")) {
                in_.end_statement("'endlsystem'");
                return true;
            }
            if (section_line() || header_item() || declarations_.declaration()) return false;
        }
        if (!in_.statement_has_arrow()) return not_a_line();
        production();
        return false;
    }

    // A word such as "axiom" begins an item unless the line is plainly a production: "end --> F", and, behind the
    // axiom, "end : x > 1 --> F".
    bool begins_item() {
        const auto is_here = [&](const std::string& keyword) {
            const std::size_t length = keyword_length(in_.rest(), keyword);
            if (length == 0) return false;
            const std::size_t after = in_.rest().find_first_not_of(" \t", length);
            const char next = after == Scanner::npos ? '\n' : in_.rest()[after];
            const bool production = in_.line_has_arrow(in_.position());
            return next == '{' || !production || (next == ':' && (!axiom_read_ || keyword.size() > longest_plain_word));
        };
        const auto headers = header_keywords();
        const auto sections = section_keywords();
        return std::any_of(headers.begin(), headers.end(), is_here) ||
               std::any_of(sections.begin(), sections.end(), is_here);
    }

    void production() {
        if (!std::exchange(axiom_read_, true) && model_.systems.size() == 1) {  // said once
            mistakes_.error(in_.here(), "a production before the axiom: 'axiom: ...' is missing");
        }
        const Location at = in_.here();
        if (const std::size_t length = label_length(in_.rest())) {
            mistakes_.error(at, fmt::format("productions have no labels: leave '{}' away",
                                            in_.text(in_.position(), in_.position() + length)));
            in_.take(length);
        }
        Production read = productions_.production();
        if (rules_ == &timed_.rules) TimedRules::require_terminal_age(read, at);
        const std::optional<Location> weight = productions_.take_first_weight();
        const bool stochastic = system_->seed || (rules_ && rules_->seed);
        if (weight && !stochastic && !std::exchange(weight_reported_, true)) {
            mistakes_.error(*weight, "a weight needs a 'seed: number' line in the header of the L-system");
        }
        (rules_ ? rules_->productions : system_->productions).push_back(std::move(read));
    }

    /// Says what is wrong with a line that is no item and has no arrow. A misspelt keyword is taken as what it was
    /// meant to be, so that it begets no other mistakes; true if it ends the L-system.
    bool not_a_line() {
        const Location at = in_.here();
        const std::string keyword = nearest_keyword();
        if (axiom_read_ && keyword.empty()) {
            const std::string_view line = in_.text(in_.position(), in_.end_of_line(in_.position()));
            if (const auto [other, length] = other_arrow(line); length > 0) {
                throw SyntaxError{
                    in_.location(in_.position() + other),
                    fmt::format("the arrow of a production is '-->', not '{}'", line.substr(other, length))};
            }
            // Reads it as a production to say what keeps it from being one.
            productions_.production();
        }
        mistakes_.error(at, fmt::format("expected {}, found '{}'{}",
                                        axiom_read_ ? "a production, a section or 'endlsystem'"
                                                    : "an item of the header or 'axiom:'",
                                        words_of_line(), hint(keyword)));
        in_.recover(in_.position());
        if (keyword == "axiom") axiom_read_ = true;
        if (keyword == "decomposition") rules_ = &system_->decomposition;
        if (keyword == "homomorphism") rules_ = &system_->homomorphism;
        return keyword == "endlsystem";
    }

    /// Where the first arrow of other notations begins, and its bytes; none if there is none.
    static std::pair<std::size_t, std::size_t> other_arrow(std::string_view line) {
        std::pair<std::size_t, std::size_t> first{Scanner::npos, 0};
        for (const std::string_view arrow : {"->", "=>", "\u2192", "\u21D2", "\u27F6", "\u2794"}) {
            if (const std::size_t at = line.find(arrow); at < first.first) first = {at, arrow.size()};
        }
        return first;
    }

    static std::string hint(const std::string& keyword) {
        return keyword.empty() ? "" : fmt::format(" (did you mean '{}'?)", keyword);
    }

    std::string words_of_line() const {
        const std::string_view line = in_.text(in_.position(), in_.end_of_line(in_.position()));
        std::string words(line.substr(0, std::min({line.find_first_of(":({"), line.size(), std::size_t{40}})));
        while (!words.empty() && is_blank(words.back())) words.pop_back();
        return words.empty() ? std::string(line.substr(0, 1)) : words;
    }

    /// The keyword this line was probably meant to begin with, or "".
    std::string nearest_keyword() const {
        std::vector<std::string> known(header_keywords().begin(), header_keywords().end());
        known.insert(known.end(), section_keywords().begin(), section_keywords().end());
        std::string words = words_of_line();
        for (char& c : words) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const std::string first = words.substr(0, words.find(' '));
        if (words.starts_with('#')) {
            const std::vector<std::string> directives{"#define", "#undef", "#include", "#ifdef", "#ifndef", "#endif"};
            return nearest_name(first, directives);
        }
        std::string nearest = words.size() > 2 ? nearest_name(words, known) : "";
        if (nearest.empty() && first.size() > 2) nearest = nearest_name(first, known);
        return nearest;
    }

    // --- sections -----------------------------------------------------------------------------------------------

    bool section_line() {
        if (in_.accept_keyword("decomposition")) return begin_section(system_->decomposition, "decomposition");
        if (in_.accept_keyword("homomorphism")) return begin_section(system_->homomorphism, "homomorphism");
        if (in_.accept_keyword("timed")) return begin_section(timed_.rules, "timed");
        if (!rules_) return false;
        if (rules_ == &timed_.rules && timed_line()) return true;
        if (in_.accept_keyword("maximum depth")) {
            rules_->maximum_depth = value_of("maximum depth");
        } else if (in_.accept_keyword("seed")) {
            rules_->seed = value_of("seed");
        } else if (in_.accept_keyword("no warnings")) {
            rules_->warnings = false;
            in_.end_statement("'no warnings'");
        } else if (in_.accept_keyword("warnings")) {
            rules_->warnings = true;
            in_.end_statement("'warnings'");
        } else {
            return false;
        }
        return true;
    }

    bool timed_line() {
        const Location at = in_.here();
        if (in_.accept_keyword("time step")) {
            timed_.time_step = value_of("time step");
            const std::optional<double> value = constant_value(*timed_.time_step);
            if (value && *value <= 0)
                throw SyntaxError{at, fmt::format("a time step must be greater than 0, not {}", *value)};
        } else if (in_.accept_keyword("ageing")) {
            in_.expect(":", "after 'ageing'");
            timed_.ageing = productions_.symbol_list();
        } else {
            return false;
        }
        return true;
    }

    bool begin_section(RuleSet& rules, const char* name) {
        if (rules.present) mistakes_.error(in_.here(), fmt::format("a second '{}' in one L-system", name));
        rules.present = true;
        if (system_->decomposition.present && timed_.rules.present) {
            mistakes_.error(in_.here(), "an L-system has timed productions or a decomposition, not both");
        }
        rules_ = &rules;
        in_.accept(":");
        // "warnings" and "no warnings" may stand on the keyword's own line.
        if (in_.accept_keyword("no warnings")) rules.warnings = false;
        in_.accept_keyword("warnings");
        in_.end_statement(fmt::format("'{}'", name));
        return true;
    }

    Expression value_of(std::string_view item) {
        in_.expect(":", fmt::format("after '{}'", item));
        Expression value = expressions_.expression();
        in_.end_statement(fmt::format("the value of '{}'", item));
        return value;
    }

    // --- the header ---------------------------------------------------------------------------------------------

    bool header_item() {
        const Location at = in_.here();
        if (in_.accept_keyword("axiom")) {
            in_.expect(":", "after 'axiom'");
            if (axiom_read_) throw SyntaxError{at, "a second axiom in one L-system"};
            axiom_read_ = true;
            system_->axiom = productions_.axiom();
        } else if (in_.accept_keyword("ring")) {
            system_->ring = true;
            accept_lsystem();
            in_.accept(":");
            in_.end_statement("'ring lsystem'");
        } else if (in_.accept_keyword("seed")) {
            system_->seed = value_of("seed");
        } else if (in_.accept_keyword("derivation length")) {
            system_->derivation_length = value_of("derivation length");
        } else if (in_.accept_keyword("ignore")) {
            filter(LSystem::Filter::ignore, "ignore");
        } else if (in_.accept_keyword("consider")) {
            filter(LSystem::Filter::consider, "consider");
        } else if (const auto read = definitions_.find(in_.position()); read != definitions_.end()) {
            in_.seek(read->second);
        } else if (in_.accept_keyword("define")) {
            in_.accept(":");
            declarations_.definitions();
        } else {
            return block_item();
        }
        return true;
    }

    bool block_item() {
        const auto accept_block = [&](const char* keyword, Block& block) {
            const Location at = in_.here();
            if (!in_.accept_keyword(keyword)) return false;
            if (!block.empty()) mistakes_.insist(at, fmt::format("a second '{}' takes the first one's place", keyword));
            definitions_ahead();
            const Scanner::Inside inside(in_, Scanner::Inside::braces);
            in_.accept(":");
            block = expressions_.block();
            return true;
        };
        const bool found = accept_block("start each", system_->start_each) || accept_block("start", system_->start) ||
                           accept_block("end each", system_->end_each) || accept_block("end", system_->end);
        if (found) in_.end_statement("the block");
        return found;
    }

    // The header's items stand in any order, so that a block may use arrays declared below it.
    void definitions_ahead() {
        if (std::exchange(looked_ahead_, true)) return;
        const std::size_t here = in_.position();
        for (std::size_t line = in_.next_line(here); line < in_.text_size(); line = in_.next_line(line)) {
            in_.seek(line);
            in_.skip_lines();
            const std::size_t start = in_.position();
            if (in_.looking_at_keyword("endlsystem") || in_.looking_at_keyword("lsystem")) break;
            if (!in_.accept_keyword("define") || definitions_.contains(start)) continue;
            in_.accept(":");
            if (!in_.looking_at("{")) continue;
            statement([&] { declarations_.definitions(); });
            definitions_[start] = in_.position();
        }
        in_.seek(here);
    }

    void filter(LSystem::Filter kind, std::string_view keyword) {
        const Location at = in_.here();
        in_.expect(":", fmt::format("after '{}'", keyword));
        if (system_->filter != LSystem::Filter::none && system_->filter != kind) {
            throw SyntaxError{at, "'ignore' and 'consider' exclude each other"};
        }
        system_->filter = kind;
        const std::vector<SymbolId> symbols = productions_.symbol_list();
        system_->filtered.insert(system_->filtered.end(), symbols.begin(), symbols.end());
    }

    Scanner in_;
    Names names_;
    Mistakes& mistakes_;
    Symbols symbols_;
    ExpressionParser expressions_;
    ProductionParser productions_;
    DeclarationParser declarations_;
    Model& model_;
    LSystem* system_ = nullptr;
    TimedRules timed_;           // timed rules of the L-system at hand
    RuleSet* rules_ = nullptr;   // null among the productions proper
    bool complete_;              // nothing was wrong before parsing that may have hidden a part
    bool looked_ahead_ = false;  // for definitions, in the L-system at hand
    std::map<int, Location> labels_;
    std::map<std::size_t, std::size_t> definitions_;  // read ahead: where they begin and end
    bool axiom_read_ = false;
    bool weight_reported_ = false;
    bool outside_reported_ = false;
};

}  // namespace

void parse_model(const Preprocessed& source, const Sources& sources, Mistakes& mistakes, Model& model) {
    ModelParser(source, sources, mistakes, model).run();
}

}  // namespace espalier::language
