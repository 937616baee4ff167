#include "studio/session/view_help.h"

#include "espalier/turtle/view_setting.h"

#include <cmath>
#include <sstream>
#include <string_view>

namespace espalier::studio {
namespace {

constexpr std::string_view name_of(ViewKind kind) {
    switch (kind) {
        case ViewKind::number:
            return "number";
        case ViewKind::whole:
            return "whole";
        case ViewKind::on_off:
            return "switch";
        case ViewKind::word:
            return "word";
        case ViewKind::vector:
            return "vector";
        case ViewKind::colour:
            return "colour";
        case ViewKind::file:
            return "file";
        case ViewKind::flag:
            return "flag";
        case ViewKind::letters:
            return "letters";
        case ViewKind::other:
            break;
    }
    return "other";
}

void fill(ViewValueHelp& help, const ViewValue& value) {
    const auto bound = [](double number) {
        return std::isfinite(number) ? Nullable<double>(number) : Nullable<double>();
    };
    help.kind = name_of(value.kind);
    help.help = value.help;
    help.standard = value.standard;
    help.unit = value.unit;
    help.lowest = bound(value.lowest);
    help.highest = bound(value.highest);
    std::istringstream words{std::string(value.words)};
    for (std::string word; words >> word;) help.words.push_back(word);
    if (value.letter) help.letter = std::string(1, value.letter);
}

}  // namespace

std::vector<ViewSettingHelp> view_settings_help() {
    std::vector<ViewSettingHelp> all;
    for (const ViewSetting& setting : view_settings()) {
        ViewSettingHelp& help = all.emplace_back();
        fill(help, setting.value);
        help.name = setting.label;
        help.values = setting.values;
        help.group = setting.group;
        for (const ViewValue& letter : setting.letters) fill(help.letters.emplace_back(), letter);
    }
    return all;
}

}  // namespace espalier::studio
