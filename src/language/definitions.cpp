#include "language/definitions.h"

#include "language/parser/constant.h"
#include "language/parser/expressions.h"
#include "language/parser/names.h"
#include "language/parser/scanner.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::language {
namespace {

Expression read_expression(const MappedText& text, const Preprocessed& source) {
    Sources sources;
    sources.add("", "");
    Mistakes mistakes(sources);
    LSystem system;
    Names names(sources, mistakes, source.macro_names);
    names.begin(system);
    names.set_constants_only(true);
    Scanner in(text);
    ExpressionParser parser(in, names, mistakes, Arithmetic::double_precision);
    Expression expression = parser.expression();
    if (!in.at_end()) in.expected("the end of the expression");
    if (!mistakes.none()) throw SyntaxError{{}, mistakes.errors().front().message};
    return expression;
}

}  // namespace

double value_of(std::string_view expression, const Preprocessed& source) {
    Macros macros = source.macros;
    MappedText text;
    text.append_at(macros.expand_all(expression, {}), {});
    const std::optional<double> value = constant_value(read_expression(text, source));
    if (value) return *value;
    throw SyntaxError{{}, "it has no finite value that is known before anything grows"};
}

std::vector<std::string> macros_read_by(std::string_view expression, const Preprocessed& source) {
    std::vector<std::string> found;
    std::vector<std::string> texts{std::string(expression)};
    for (std::size_t t = 0; t < texts.size(); ++t) {
        for (std::size_t begin = 0, end = 0; begin < texts[t].size(); begin = end) {
            end = end_of_token(texts[t], begin);
            const std::string name = texts[t].substr(begin, end - begin);
            const Macro* macro = source.macros.find(name);
            if (!macro || std::find(found.begin(), found.end(), name) != found.end()) continue;
            found.push_back(name);
            texts.push_back(macro->body);
        }
    }
    return found;
}

std::vector<ModelSetting> settings_of(const Preprocessed& source, const Sources& sources, Mistakes& mistakes,
                                      const std::set<std::string>& in_time) {
    std::vector<ModelSetting> settings;
    for (const DocumentedMacro& documented : source.documented) {
        const Macro* macro = source.macros.find(documented.name);
        if (!macro) continue;  // undefined again
        const auto& [summary, lowest, highest, whole, unit] = documented.comment;
        ModelSetting setting{documented.name, macro->body, 0,    summary,          lowest,
                             highest,         whole,       unit, documented.group, sources.place(documented.at)};
        bool allowed = in_time.contains(setting.name);
        try {
            if (!allowed) setting.value = value_of(setting.text, source);
            allowed = allowed || setting.allows(setting.value);
        } catch (const SyntaxError&) {
            // Not a number, whatever else it is.
        }
        if (!allowed) {
            mistakes.error(documented.at, fmt::format("the setting '{}' ({}) must be {}, not {}", setting.name, summary,
                                                      setting.what_is_allowed(), setting.text));
        }
        settings.push_back(std::move(setting));
    }
    return settings;
}

}  // namespace espalier::language
