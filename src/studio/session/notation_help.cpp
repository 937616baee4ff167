#include "studio/session/notation_help.h"

#include "espalier/language/notation.h"

#include "base/part_help.h"
#include "base/text.h"
#include "language/parser/keywords.h"
#include "language/sdl/parser.h"
#include "language/weber_penn/species.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::studio {
namespace {

using Entries = std::vector<HelpEntry>;

Entries keywords() {
    Entries list;
    for (const auto& names : {language::header_keywords(), language::section_keywords()}) {
        for (const std::string& name : names) list.push_back({name, "", ""});
    }
    return list;
}

// "0.3 by default; from 0 to 1 metres".
std::string limits_of(const language::weber_penn::Parameter& parameter, double standard) {
    std::string text = fmt::format("{} by default", format_general(standard));
    if (std::isfinite(parameter.lowest)) text += fmt::format("; at least {}", format_general(parameter.lowest));
    if (std::isfinite(parameter.highest)) text += fmt::format("; at most {}", format_general(parameter.highest));
    return parameter.unit.empty() ? text : fmt::format("{} ({})", text, parameter.unit);
}

Entries species() {
    Entries list;
    for (const language::weber_penn::Parameter& parameter : language::weber_penn::parameters()) {
        if (!parameter.has_levels()) {
            list.push_back({parameter.name, parameter.summary, limits_of(parameter, parameter.standard.front())});
            continue;
        }
        for (std::size_t i = 0; i < parameter.standard.size(); ++i) {
            const int level = parameter.first_level + static_cast<int>(i);
            list.push_back({language::weber_penn::written_name(parameter, level),
                            fmt::format("level {}: {}", level, parameter.summary),
                            limits_of(parameter, parameter.standard[i])});
        }
    }
    return list;
}

// What the help of the notation says of a word: the line that it begins.
std::string phrase_of(const std::string& word, const std::string& help) {
    const std::size_t begin = help.find(word);
    if (begin == std::string::npos) return "";
    return help.substr(begin, help.find('\n', begin) - begin);
}

std::string meaning_of(const std::string& setting, const std::string& help) {
    for (const HelpRow& row : parameters_of(help)) {
        if (row.name == setting) return row.meaning;
    }
    return "";
}

Entries skeletons() {
    Entries list;
    const std::string& help = registered<NotationType>().at("sdl")->help;
    for (const char* block : {"define", "rules", "fibres", "generations"}) {
        list.push_back({block, phrase_of(block, help), ""});
    }
    for (const std::string& name : language::sdl::fibre_settings()) {
        list.push_back({name, meaning_of(name, help), ""});
    }
    return list;
}

}  // namespace

std::map<std::string, std::vector<HelpEntry>> words_of_languages() {
    return {{"cpfg", keywords()}, {"sdl", skeletons()}, {"species", species()}};
}

}  // namespace espalier::studio
