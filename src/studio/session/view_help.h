// The settings of view files, for help and forms.
#pragma once

#include "studio/protocol/declaration.h"

#include <string>
#include <vector>

namespace espalier::studio {

struct ViewValueHelp {
    static constexpr TypeName type{"ViewValue", "what stands behind a setting, or behind a letter of its line"};
    std::string kind, help, standard, unit;
    Nullable<double> lowest, highest;
    std::vector<std::string> words;
    std::string letter;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("kind", self.kind,
              "a vector has three numbers, a colour three from 0 to 1, a switch is on or off, a flag is a letter alone",
              one_of("number whole switch word vector colour file flag letters other"));
        field("help", self.help, "one phrase");
        field("standard", self.standard, "what holds without it; may be empty");
        field("unit", self.unit, "empty for a pure number");
        field("lowest", self.lowest, "null if there is no bound");
        field("highest", self.highest, "null if there is no bound");
        field("words", self.words, "of kind `word`: what it can be");
        field("letter", self.letter, "that stands before it; may be empty");
    }
};

struct ViewSettingHelp : ViewValueHelp {
    static constexpr TypeName type{"ViewSetting", "a setting of view files"};
    std::string name, values, group;
    std::vector<ViewValueHelp> letters;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        ViewValueHelp::declare(self, field);
        field("name", self.name, "with its colon");
        field("values", self.values, "what follows it, in words");
        field("group", self.group, "`window`: without meaning outside a window", one_of("growth shape picture window"));
        field("letters", self.letters, "values of a line of letters");
    }
};

std::vector<ViewSettingHelp> view_settings_help();

}  // namespace espalier::studio
