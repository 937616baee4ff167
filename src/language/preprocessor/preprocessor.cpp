#include "language/preprocessor/preprocessor.h"

#include "espalier/base/file.h"
#include "espalier/base/stop.h"

#include "base/characters.h"
#include "base/number.h"
#include "base/text.h"
#include "language/preprocessor/comments.h"
#include "language/preprocessor/macros.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace espalier::language {
namespace {

constexpr std::string_view dashes = "---";

/// What the first comment of a line says; "" if there is none.
std::string_view comment_of(std::string_view line) {
    const std::size_t block = line.find("/*"), rest = line.find("//");
    if (block == line.npos && rest == line.npos) return {};
    if (rest < block) return stripped(line.substr(rest + 2));
    const std::string_view inside = line.substr(block + 2);
    return stripped(inside.substr(0, inside.find("*/")));
}

std::vector<std::string_view> parts_of(std::string_view comment) {
    std::vector<std::string_view> parts;
    for (std::size_t end; (end = comment.find(';')) != comment.npos; comment.remove_prefix(end + 1)) {
        parts.push_back(stripped(comment.substr(0, end)));
    }
    parts.push_back(stripped(comment));
    return parts;
}

/// An end of a range that is left out stays as it is; false if something else than a number stands there.
bool read_end(std::string_view text, double& end) {
    text = stripped(text);
    if (text.empty()) return true;
    const std::optional<double> number = finite_number(text);
    end = number.value_or(end);
    return number.has_value();
}

/// "0..1", "0..", "1..400 whole".
bool read_range(std::string_view text, SettingComment& comment) {
    constexpr std::string_view whole = " whole";
    comment.whole = text.ends_with(whole);
    if (comment.whole) text = stripped(text.substr(0, text.size() - whole.size()));
    const std::size_t dots = text.find("..");
    return dots != text.npos && text.size() > 2 && read_end(text.substr(0, dots), comment.lowest) &&
           read_end(text.substr(dots + 2), comment.highest);
}

constexpr std::array<std::string_view, 12> directive_words{"define", "undef", "include", "if",    "ifdef", "ifndef",
                                                           "elif",   "else",  "endif",   "error", "line",  "pragma"};
constexpr std::size_t deepest_inclusion = 64;
constexpr std::size_t most_inclusions = 10'000;
constexpr std::size_t longest_text = std::size_t{256} << 20, longest_expansions = std::size_t{64} << 20;

/// One #if and what follows it.
struct Conditional {
    Location begin;
    bool outer_active;
    bool active;
    bool taken;  // one of its branches was
    bool else_seen = false;
};

class Preprocessor {
public:
    Preprocessor(Sources& sources, const ReadOptions& options, Mistakes& mistakes)
        : sources_(sources), options_(options), mistakes_(mistakes) {
        for (const auto& [name, text] : options.predefined) define_from_outside(name, text, false);
        for (const auto& [name, text] : options.defines) define_from_outside(name, text, true);
    }

    Preprocessed run(std::uint32_t file, const std::filesystem::path& folder, Overrides overrides) {
        read_file(file, folder);
        if (overrides == Overrides::must_be_known) reject_unknown_overrides(file);
        result_.macros = std::move(macros_);
        return std::move(result_);
    }

private:
    void define_from_outside(const std::string& name, const std::string& text, bool overridden) {
        Macro macro;
        macro.body = stripped(text);
        macro.overridden = overridden;
        macros_.define(name, std::move(macro));
    }

    void reject_unknown_overrides(std::uint32_t file) {
        const std::vector<std::string> known(result_.macro_names.begin(), result_.macro_names.end());
        for (const auto& [name, text] : options_.defines) {
            if (result_.macro_names.contains(name)) continue;
            mistakes_.error({file, 0, 0}, fmt::format("'{}' cannot be overridden: the model never defines it{}", name,
                                                      did_you_mean(name, known)));
        }
    }

    void read_file(std::uint32_t file, const std::filesystem::path& folder) {
        const MappedText clean = without_comments(sources_, file, mistakes_);
        const std::size_t outer_conditionals = conditionals_.size();
        files_.push_back(sources_.name(file));
        for (std::size_t position = 0; position < clean.size();) {
            end_if_asked();
            limit_text(clean.location(position));
            const std::size_t end = std::min(clean.text().find('\n', position), clean.size());
            if (directive(clean, position, end, folder, outer_conditionals)) {
                result_.text.append_at("\n", clean.location(end == clean.size() ? position : end));
                position = end + 1;
            } else if (!active()) {
                position = end + 1;
            } else {
                position = copy_line(clean, position);
            }
        }
        files_.pop_back();
        while (conditionals_.size() > outer_conditionals) {
            mistakes_.error(conditionals_.back().begin, "this condition is never closed: '#endif' is missing");
            conditionals_.pop_back();
        }
        if (result_.text.size() > 0 && result_.text.text().back() != '\n') {
            result_.text.append('\n', clean.location(clean.size()));
        }
    }

    void limit_text(Location at) {
        if (result_.text.size() <= longest_text && expanded_ <= longest_expansions) return;
        mistakes_.error(
            at, fmt::format("up to here the text takes {} MiB, {} MiB of them by macros; there is room for "
                            "{} MiB and {} MiB",
                            result_.text.size() >> 20, expanded_ >> 20, longest_text >> 20, longest_expansions >> 20));
        throw TooManyMistakes();
    }

    bool active() const { return conditionals_.empty() || conditionals_.back().active; }

    // Copies up to and including the end of the line, or further where the arguments of a macro do.
    std::size_t copy_line(const MappedText& clean, std::size_t position) {
        const std::string_view text = clean.text();
        std::size_t copied = position;
        while (position < text.size() && text[position] != '\n') {
            const std::size_t start = position;
            position = end_of_token(text, position);
            if (text[start] == '\'' && position == start + 1) {
                // A quote that its line never closes: nothing after it is expanded.
                position = std::min(text.find('\n', position), text.size());
                break;
            }
            if (is_digit(text[start]) || text[start] == '"' || text[start] == '\'') continue;
            const std::optional<std::string> expansion = expand(clean, start, position);
            if (!expansion) continue;
            result_.text.append(clean, copied, start);
            append_expansion(*expansion, clean.location(start), position < text.size() ? text[position] : '\n');
            copied = position;
        }
        if (position < text.size()) ++position;
        result_.text.append(clean, copied, position);
        return position;
    }

    std::optional<std::string> expand(const MappedText& clean, std::size_t start, std::size_t& position) {
        const std::string_view name = std::string_view(clean.text()).substr(start, position - start);
        if (!macros_.find(name)) return expand_builtin(name, clean, start);
        const std::size_t after_name = position;
        try {
            return macros_.expand_use(name, clean.text(), position, clean.location(start));
        } catch (const SyntaxError& mistake) {
            mistakes_.error(mistake);
            position = std::max(position, after_name);
            return "0";
        }
    }

    std::optional<std::string> expand_builtin(std::string_view name, const MappedText& clean, std::size_t start) {
        if (name == "__LINE__") return std::to_string(clean.location(start).line);
        if (name == "__FILE__") return '"' + files_.back() + '"';
        return std::nullopt;
    }

    void append_expansion(const std::string& expansion, Location use, char next) {
        const std::string& so_far = result_.text.text();
        if (expansion.empty()) return;
        expanded_ += expansion.size();
        limit_text(use);
        if (!so_far.empty() && grow_together(so_far.back(), expansion.front())) result_.text.append_at(" ", use);
        result_.text.append_at(expansion, use);
        if (grow_together(expansion.back(), next)) result_.text.append_at(" ", use);
    }

    // --- directives ---------------------------------------------------------------------------------------------

    /// Obeys the directive of a line, if it is one. A `#` before anything else is the turtle's symbol.
    bool directive(const MappedText& clean, std::size_t begin, std::size_t end, const std::filesystem::path& folder,
                   std::size_t outer_conditionals) {
        const std::string_view line = std::string_view(clean.text()).substr(begin, end - begin);
        std::size_t i = skip_blanks(line, 0);
        if (i >= line.size() || line[i] != '#') return false;
        const std::size_t hash = i;
        i = skip_blanks(line, i + 1);
        const std::string_view word = name_at(line, i);
        if (std::find(directive_words.begin(), directive_words.end(), word) == directive_words.end()) return false;
        at_ = clean.location(begin + hash);
        const std::string_view rest = line.substr(i + word.size());
        try {
            if (!conditional(word, rest, outer_conditionals) && active()) {
                if (word == "define") define(rest);
                if (word == "undef") macros_.undefine(std::string(required_name(rest, "undef")));
                if (word == "include") include(rest, folder);
                if (word == "error") throw SyntaxError{at_, fmt::format("#error {}", stripped(rest))};
            }
        } catch (const SyntaxError& mistake) {
            mistakes_.error(mistake);
        }
        return true;
    }

    static std::size_t skip_blanks(std::string_view text, std::size_t i) {
        while (i < text.size() && is_blank(text[i])) ++i;
        return i;
    }

    static std::string_view name_at(std::string_view text, std::size_t start) {
        std::size_t end = start;
        while (end < text.size() && (is_name_part(text[end]) || text[end] == '$')) ++end;
        if (end > start && is_digit(text[start])) end = start;
        return text.substr(start, end - start);
    }

    std::string_view required_name(std::string_view rest, std::string_view directive) {
        const std::string_view name = name_at(rest, skip_blanks(rest, 0));
        if (name.empty()) throw SyntaxError{at_, fmt::format("#{} needs the name of a macro", directive)};
        result_.macro_names.emplace(name);
        return name;
    }

    bool conditional(std::string_view word, std::string_view rest, std::size_t outer_conditionals) {
        if (word == "if" || word == "ifdef" || word == "ifndef") {
            conditionals_.push_back({at_, active(), false, false});
            Conditional& opened = conditionals_.back();
            if (!opened.outer_active) return true;
            opened.taken = true;  // should the condition be faulty, no branch is read
            const bool holds = word == "if" ? condition(rest)
                                            : (macros_.find(required_name(rest, word)) != nullptr) == (word == "ifdef");
            opened.active = opened.taken = holds;
            return true;
        }
        if (word != "elif" && word != "else" && word != "endif") return false;
        if (conditionals_.size() <= outer_conditionals) throw SyntaxError{at_, fmt::format("#{} without #if", word)};
        Conditional& current = conditionals_.back();
        if (word == "endif") {
            conditionals_.pop_back();
            return true;
        }
        if (current.else_seen) throw SyntaxError{at_, fmt::format("#{} after #else", word)};
        current.else_seen = word == "else";
        const bool may_be_read = current.outer_active && !current.taken;
        current.active = false;
        current.active = may_be_read && (word == "else" || condition(rest));
        current.taken = current.taken || current.active;
        return true;
    }

    bool condition(std::string_view rest) {
        return condition_value(macros_.expand_all(without_defined(rest), at_), at_) != 0;
    }

    // Replaces `defined NAME` and `defined(NAME)` by 0 or 1, before macros are expanded.
    std::string without_defined(std::string_view text) {
        std::string result;
        for (std::size_t i = 0; i < text.size();) {
            const std::size_t start = i;
            i = end_of_token(text, i);
            const std::string_view token = text.substr(start, i - start);
            if (is_name_start(token.front()) && token != "defined") result_.macro_names.emplace(token);
            if (token != "defined") {
                result += token;
                continue;
            }
            i = skip_blanks(text, i);
            const bool parenthesis = i < text.size() && text[i] == '(';
            if (parenthesis) i = skip_blanks(text, i + 1);
            const std::string_view name = required_name(text.substr(i), "if defined");
            i = skip_blanks(text, i + name.size());
            if (parenthesis && (i >= text.size() || text[i++] != ')')) {
                throw SyntaxError{at_, "expected ')' after 'defined(" + std::string(name) + "'"};
            }
            result += macros_.find(name) ? " 1 " : " 0 ";
        }
        return result;
    }

    void define(std::string_view rest) {
        const std::string name(required_name(rest, "define"));
        if (name == "defined") throw SyntaxError{at_, "'defined' cannot be the name of a macro"};
        std::size_t i = skip_blanks(rest, 0) + name.size();
        Macro macro;
        macro.defined = at_;
        if (i < rest.size() && rest[i] == '(') {
            macro.function_like = true;
            macro.parameters = parameters(name, rest, i);
        }
        macro.body = stripped(rest.substr(i));
        if (!macro.function_like) document(name);
        const Macro* before = macros_.find(name);
        if (before && before->overridden) {
            if (!macro.function_like) return;
            throw SyntaxError{at_, fmt::format("'{}' takes arguments here and cannot be overridden", name)};
        }
        if (before && !before->same_meaning(macro)) {
            const Place first = sources_.place(before->defined);
            const std::string where = first.line > 0 ? to_string(first) : "the view file, as the name of a function";
            mistakes_.warning(at_,
                              fmt::format("'{}' is defined a second time, differently (first in {})", name, where));
        }
        macros_.define(name, std::move(macro));
    }

    void document(const std::string& name) {
        std::optional<SettingComment> comment = setting_comment(sources_.line(at_));
        if (!comment) return;
        std::string group;
        for (Location above = at_; group.empty() && above.line > 1;) {
            --above.line;
            group = heading_of(sources_.line(above));
        }
        std::erase_if(result_.documented, [&](const DocumentedMacro& other) { return other.name == name; });
        result_.documented.push_back({name, at_, std::move(*comment), std::move(group)});
    }

    std::vector<std::string> parameters(const std::string& name, std::string_view rest, std::size_t& i) {
        std::vector<std::string> found;
        i = skip_blanks(rest, i + 1);
        if (i < rest.size() && rest[i] == ')') {
            ++i;
            return found;
        }
        while (true) {
            const std::string_view parameter = name_at(rest, i);
            if (parameter.empty()) {
                throw SyntaxError{at_, fmt::format("expected the name of a parameter of macro '{}'", name)};
            }
            if (std::find(found.begin(), found.end(), parameter) != found.end()) {
                throw SyntaxError{at_, fmt::format("macro '{}' has two parameters '{}'", name, parameter)};
            }
            found.emplace_back(parameter);
            i = skip_blanks(rest, i + parameter.size());
            const char next = i < rest.size() ? rest[i] : '\0';
            if (next != ',' && next != ')') {
                throw SyntaxError{at_, fmt::format("expected ',' or ')' among the parameters of macro '{}'", name)};
            }
            i = next == ',' ? skip_blanks(rest, i + 1) : i + 1;
            if (next == ')') return found;
        }
    }

    void include(std::string_view rest, const std::filesystem::path& folder) {
        const std::string_view argument = stripped(rest);
        const char close = argument.starts_with('"') ? '"' : argument.starts_with('<') ? '>' : '\0';
        if (!close || argument.size() < 3 || argument.back() != close) {
            throw SyntaxError{at_, "#include needs a file name: #include \"file\""};
        }
        const std::filesystem::path path = folder / std::string(argument.substr(1, argument.size() - 2));
        const Location place = at_;
        if (files_.size() >= deepest_inclusion) {
            throw SyntaxError{place,
                              fmt::format("files include one another more than {} deep; does '{}' include itself?",
                                          deepest_inclusion, path.string())};
        }
        if (++inclusions_ > most_inclusions) throw SyntaxError{place, "more than 10,000 files are included"};
        std::string text;
        try {
            text = read_text(path);
        } catch (const UserError& error) {
            throw SyntaxError{place, error.what()};
        }
        read_file(sources_.add(path.string(), std::move(text)), path.parent_path());
    }

    Sources& sources_;
    const ReadOptions& options_;
    Mistakes& mistakes_;
    Macros macros_;
    Preprocessed result_;
    std::vector<Conditional> conditionals_;
    std::vector<std::string> files_;  // being read, outermost first
    std::size_t inclusions_ = 0;
    std::size_t expanded_ = 0;  ///< bytes that macros stand for
    Location at_;               // place of the directive at hand
};

}  // namespace

Preprocessed preprocess(Sources& sources, std::uint32_t file, const std::filesystem::path& folder,
                        const ReadOptions& options, Mistakes& mistakes, Overrides overrides) {
    return Preprocessor(sources, options, mistakes).run(file, folder, overrides);
}

std::optional<SettingComment> setting_comment(std::string_view line) {
    const std::string_view comment = comment_of(line);
    const std::vector<std::string_view> parts = parts_of(comment);
    SettingComment result;
    // The range is the last part, or the unit stands behind it; the summary may have semicolons of its own.
    for (const std::size_t behind : {0, 1}) {
        if (parts.size() < behind + 2) break;
        const std::string_view range = parts[parts.size() - 1 - behind];
        if (!read_range(range, result = {})) continue;
        const auto length = static_cast<std::size_t>(range.data() - comment.data());
        result.summary = stripped(comment.substr(0, comment.rfind(';', length)));
        if (behind == 1) result.unit = parts.back();
        return result;
    }
    return std::nullopt;
}

std::string_view heading_of(std::string_view line) {
    line = stripped(line);
    if (!line.starts_with("/*") && !line.starts_with("//")) return {};
    const std::string_view comment = comment_of(line);
    const bool framed = comment.size() > 2 * dashes.size() && comment.starts_with(dashes) && comment.ends_with(dashes);
    return framed ? stripped(comment.substr(dashes.size(), comment.size() - 2 * dashes.size())) : std::string_view();
}

}  // namespace espalier::language
