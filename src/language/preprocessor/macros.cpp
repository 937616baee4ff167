#include "language/preprocessor/macros.h"

#include "base/characters.h"
#include "base/text.h"
#include "language/preprocessor/comments.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language {
namespace {

// `$` belongs to names here, as it does for the preprocessor of the reference.
bool starts_macro_name(char c) {
    return is_name_start(c) || c == '$';
}

std::size_t end_of_name(std::string_view text, std::size_t start) {
    while (start < text.size() && (is_name_part(text[start]) || text[start] == '$')) ++start;
    return start;
}

std::size_t skip_white(std::string_view text, std::size_t position) {
    while (position < text.size() && (is_blank(text[position]) || text[position] == '\n')) ++position;
    return position;
}

// A preprocessing number: digits, letters, points, and a sign after an exponent's e.
std::size_t end_of_number(std::string_view text, std::size_t start) {
    std::size_t i = start + 1;
    for (; i < text.size(); ++i) {
        const bool sign = (text[i] == '+' || text[i] == '-') && (text[i - 1] == 'e' || text[i - 1] == 'E');
        if (!is_name_part(text[i]) && text[i] != '.' && !sign) break;
    }
    return i;
}

std::string as_string_literal(std::string_view text) {
    std::string literal = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') literal += '\\';
        literal += c;
    }
    return literal + '"';
}

// Marks a name that must not be expanded again: it came out of its own expansion.
constexpr char painted = '\x01';
constexpr std::size_t deepest = 200;
constexpr std::size_t longest_expansion = std::size_t{64} << 20;
constexpr std::size_t most_expansions = 1'000'000;

}  // namespace

std::string_view stripped(std::string_view text) {
    return trimmed(text, " \t\f\v\r\n");
}

std::size_t end_of_token(std::string_view text, std::size_t start) {
    const char c = text[start];
    if (starts_macro_name(c)) return end_of_name(text, start);
    if (is_digit(c) || (c == '.' && start + 1 < text.size() && is_digit(text[start + 1]))) {
        return end_of_number(text, start);
    }
    if (c == '"' || c == '\'') return std::max(end_of_literal(text, start), start + 1);
    return start + 1;
}

bool grow_together(char left, char right) {
    if (is_name_part(left) || left == '.') return is_name_part(right) || right == '.';
    if (left == right) return std::string_view("+-&|=<>").find(left) != std::string_view::npos;
    if (right == '=') return std::string_view("+-*/<>!").find(left) != std::string_view::npos;
    return (left == '-' && right == '>') || (left == '<' && right == '>');
}

void append_apart(std::string& text, std::string_view piece) {
    if (text.empty() || piece.empty()) {
        text += piece;
        return;
    }
    const char first = piece.front() == painted ? 'a' : piece.front();
    if (grow_together(text.back(), first)) text += ' ';
    text += piece;
}

const Macro* Macros::find(std::string_view name) const {
    const auto found = macros_.find(std::string(name));
    return found == macros_.end() ? nullptr : &found->second;
}

// #define MAX = 5 is C's mistake of every beginner; its consequences would be reported far from it.
void Macros::require_value(std::string_view name, const Macro& macro) {
    const std::string_view body = macro.body;
    if (macro.function_like || body.size() < 2 || body[0] != '=' || body[1] == '=') return;
    throw SyntaxError{macro.defined, fmt::format("'{0}' stands for '{1}' here: write '#define {0} {2}', without '='",
                                                 name, body, stripped(body.substr(1)))};
}

void Macros::limit(std::size_t size) {
    check_stop_();
    if (size > longest_expansion) throw SyntaxError{use_, "this macro expands to more than 64 MiB"};
    if (expansions_ > most_expansions) {
        throw SyntaxError{use_, "this macro expands without end: more than 1,000,000 macros inside one use"};
    }
}

std::optional<std::string> Macros::expand_use(std::string_view name, std::string_view text, std::size_t& position,
                                              Location use) {
    const Macro* const macro = find(name);
    if (!macro) return std::nullopt;
    require_value(name, *macro);
    use_ = use;
    expansions_ = 0;
    Active active;
    std::optional<std::string> expansion = expand_name(name, text, position, active);
    if (expansion) std::erase(*expansion, painted);
    return expansion;
}

std::string Macros::expand_all(std::string_view text, Location use) {
    use_ = use;
    expansions_ = 0;
    Active active;
    std::string expansion = expand(text, active);
    std::erase(expansion, painted);
    return expansion;
}

std::string Macros::expand(std::string_view text, Active& active) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t start = i;
        if (text[i] == painted) {
            i = end_of_name(text, i + 1);
            result += text.substr(start, i - start);
            continue;
        }
        i = end_of_token(text, i);
        const std::string_view token = text.substr(start, i - start);
        const std::optional<std::string> expansion =
            starts_macro_name(token.front()) ? expand_name(token, text, i, active) : std::nullopt;
        if (expansion) {
            append_apart(result, *expansion);
            if (i < text.size() && !result.empty() && grow_together(result.back(), text[i])) result += ' ';
        } else {
            result += token;
        }
        limit(result.size());
    }
    return result;
}

std::optional<std::string> Macros::expand_name(std::string_view name, std::string_view text, std::size_t& position,
                                               Active& active) {
    std::string result;
    std::string current(name);
    for (bool first = true;; first = false) {
        const Macro* macro = find(current);
        if (!macro) return std::nullopt;
        if (std::find(active.begin(), active.end(), macro) != active.end()) return painted + current;
        if (active.size() >= deepest) throw SyntaxError{use_, "macros are nested more than 200 deep here"};
        ++expansions_;
        std::optional<std::vector<std::string>> given;
        if (macro->function_like) {
            given = arguments(current, *macro, text, position);
            if (!given && first) return std::nullopt;
        }
        const std::string replaced = given ? substitute(*macro, *given, active) : macro->body;
        active.push_back(macro);
        std::string expansion = expand(replaced, active);
        active.pop_back();

        // A name at the end of an expansion may take its arguments from the text that follows.
        const std::string waits(name_that_waits(expansion, text, position));
        expansion.resize(expansion.size() - waits.size());
        append_apart(result, expansion);
        limit(result.size());
        if (waits.empty()) return result;
        current = waits;
    }
}

std::string_view Macros::name_that_waits(std::string_view expansion, std::string_view text,
                                         std::size_t position) const {
    const std::size_t next = skip_white(text, position);
    if (next >= text.size() || text[next] != '(') return {};
    std::size_t start = expansion.size();
    while (start > 0 && (is_name_part(expansion[start - 1]) || expansion[start - 1] == '$')) --start;
    const std::string_view name = expansion.substr(start);
    if (name.empty() || (start > 0 && expansion[start - 1] == painted)) return {};
    const Macro* macro = find(name);
    return macro && macro->function_like ? name : std::string_view{};
}

std::optional<std::vector<std::string>> Macros::arguments(std::string_view name, const Macro& macro,
                                                          std::string_view text, std::size_t& position) const {
    std::size_t i = skip_white(text, position);
    if (i >= text.size() || text[i] != '(') return std::nullopt;
    std::vector<std::string> found;
    std::size_t start = ++i;
    for (int depth = 0;; i = end_of_token(text, i)) {
        if (i >= text.size()) {
            throw SyntaxError{use_, fmt::format("the arguments of macro '{}' never end: ')' is missing", name)};
        }
        const bool closes = text[i] == ')' && depth == 0;
        if (closes || (text[i] == ',' && depth == 0)) {
            found.emplace_back(stripped(text.substr(start, i - start)));
            start = i + 1;
        }
        if (closes) break;
        depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    }
    position = i + 1;
    if (macro.parameters.empty() && found.size() == 1 && found.front().empty()) found.clear();
    if (found.size() != macro.parameters.size()) {
        throw SyntaxError{use_, fmt::format("macro '{}' takes {} argument{}, not {}", name, macro.parameters.size(),
                                            macro.parameters.size() == 1 ? "" : "s", found.size())};
    }
    return found;
}

// Puts the arguments in: expanded, except beside # (as a string) and ## (as they are).
std::string Macros::substitute(const Macro& macro, const std::vector<std::string>& arguments, Active& active) {
    const std::string_view body = macro.body;
    std::vector<std::optional<std::string>> expanded(arguments.size());
    const auto argument_at = [&](std::size_t from, std::size_t to) -> std::size_t {
        const auto found = std::find(macro.parameters.begin(), macro.parameters.end(), body.substr(from, to - from));
        return static_cast<std::size_t>(found - macro.parameters.begin());
    };
    std::string result;
    bool glue = false;
    for (std::size_t i = 0; i < body.size();) {
        const std::size_t start = i;
        i = end_of_token(body, i);
        if (body.substr(start, 2) == "##") {
            while (!result.empty() && is_blank(result.back())) result.pop_back();
            i = skip_white(body, start + 2);
            glue = true;
            continue;
        }
        if (body[start] == '#') {
            const std::size_t from = skip_white(body, start + 1);
            const std::size_t to = end_of_name(body, from);
            const std::size_t index = argument_at(from, to);
            if (to > from && index < arguments.size()) {
                append_apart(result, as_string_literal(arguments[index]));
                i = to;
                continue;
            }
        }
        const std::size_t index = argument_at(start, i);
        if (index >= arguments.size()) {
            result += body.substr(start, i - start);
        } else if (glue || body.substr(skip_white(body, i)).starts_with("##")) {
            result += arguments[index];
        } else {
            if (!expanded[index]) {
                active.push_back(nullptr);  // counts towards the depth
                expanded[index] = expand(arguments[index], active);
                active.pop_back();
            }
            append_apart(result, *expanded[index]);
            if (i < body.size() && !result.empty() && grow_together(result.back(), body[i])) result += ' ';
        }
        glue = false;
        limit(result.size());
    }
    return result;
}

}  // namespace espalier::language
