#include "view/script.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace espalier::view {
namespace {

struct Command {
    ScriptLine::Kind kind;
    int numbers;
    bool has_word;
    const char* usage;
};

const std::map<std::string, Command>& commands() {
    using Kind = ScriptLine::Kind;
    static const std::map<std::string, Command> all{
        {"key", {Kind::key, 0, true, "key NAME"}},
        {"click", {Kind::click, 2, false, "click X Y"}},
        {"drag", {Kind::drag, 4, false, "drag X Y TO_X TO_Y"}},
        {"wheel", {Kind::wheel, 3, false, "wheel X Y NOTCHES"}},
        {"size", {Kind::size, 2, false, "size WIDTH HEIGHT"}},
        {"screenshot", {Kind::screenshot, 0, true, "screenshot FILE.png"}},
        {"print", {Kind::print, 0, false, "print"}},
        {"wait", {Kind::wait, 0, false, "wait"}},
    };
    return all;
}

ScriptLine parse_line(const Place& place, const std::string& name, std::istringstream& words) {
    const auto found = commands().find(name);
    if (found == commands().end()) {
        std::vector<std::string> names;
        for (const auto& [known, command] : commands()) names.push_back(known);
        throw UserError(place, fmt::format("'{}' is nothing a script can do{}", name, did_you_mean(name, names)));
    }
    const Command& command = found->second;
    ScriptLine line;
    line.kind = command.kind;
    bool is_good = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(command.numbers); ++i)
        is_good = is_good && words >> line.numbers[i];
    if (command.has_word) is_good = is_good && words >> line.word;
    std::string rest;
    if (is_good && words >> rest) {
        line.shift = rest == "shift" && (line.kind == ScriptLine::Kind::key || line.kind == ScriptLine::Kind::drag);
        is_good = line.shift && !(words >> rest);
    }
    if (!is_good) throw UserError(place, fmt::format("'{}' is expected", command.usage));
    return line;
}

}  // namespace

std::vector<ScriptLine> parse_script(const std::string& text) {
    std::vector<ScriptLine> lines;
    std::istringstream in(text);
    Place place{"script", 0, 0};
    for (std::string line; std::getline(in, line);) {
        ++place.line;
        std::istringstream words(line.substr(0, line.find('#')));
        std::string name;
        if (words >> name) lines.push_back(parse_line(place, name, words));
    }
    return lines;
}

}  // namespace espalier::view
