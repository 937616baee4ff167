// Macros of the preprocessor and their expansion.
#pragma once

#include "espalier/base/stop.h"

#include "language/text/source.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace espalier::language {

struct Macro {
    bool function_like = false;
    std::vector<std::string> parameters;
    std::string body;
    Location defined;
    bool overridden = false;  ///< its text comes from the scene or the command line

    bool same_meaning(const Macro& other) const {
        return function_like == other.function_like && parameters == other.parameters && body == other.body;
    }
};

class Macros {
public:
    void define(const std::string& name, Macro macro) { macros_[name] = std::move(macro); }
    void undefine(const std::string& name) { macros_.erase(name); }
    const Macro* find(std::string_view name) const;

    /// Expands the use of macro `name` that ends before `position` of `text`, moving `position` past its arguments.
    /// Nothing if the name is not a macro, or takes arguments and none follow. Throws SyntaxError at `use`.
    std::optional<std::string> expand_use(std::string_view name, std::string_view text, std::size_t& position,
                                          Location use);
    /// Expands every macro in a text, as the condition of an #if.
    std::string expand_all(std::string_view text, Location use);

private:
    using Active = std::vector<const Macro*>;

    std::string expand(std::string_view text, Active& active);
    std::optional<std::string> expand_name(std::string_view name, std::string_view text, std::size_t& position,
                                           Active& active);
    std::optional<std::vector<std::string>> arguments(std::string_view name, const Macro& macro, std::string_view text,
                                                      std::size_t& position) const;
    std::string substitute(const Macro& macro, const std::vector<std::string>& arguments, Active& active);
    std::string_view name_that_waits(std::string_view expansion, std::string_view text, std::size_t position) const;
    static void require_value(std::string_view name, const Macro& macro);
    void limit(std::size_t size);

    std::unordered_map<std::string, Macro> macros_;
    Location use_;
    std::size_t expansions_ = 0;
    StopCheck<256> check_stop_;
};

/// Appends `piece`, with a blank before it where the two would otherwise grow together into one token.
void append_apart(std::string& text, std::string_view piece);
/// Whether a token ending in `left` and one beginning with `right` would grow together.
bool grow_together(char left, char right);
/// The end of the name, number or literal that begins at `start`, or start + 1.
std::size_t end_of_token(std::string_view text, std::size_t start);
/// Without the blanks and line breaks at both ends.
std::string_view stripped(std::string_view text);

}  // namespace espalier::language
