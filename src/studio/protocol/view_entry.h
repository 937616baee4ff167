// Settings of view files as pages see and change them.
#pragma once

#include "studio/protocol/declaration.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::studio {

struct ViewEntry {
    static constexpr TypeName type{"ViewEntry", "a place where a view file says a setting"};
    std::string path, name;
    std::vector<std::string> values;
    std::map<std::string, std::vector<std::string>> letters;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("path", self.path, "path of its text");
        field("name", self.name, "with its colon");
        field("values", self.values, "the words behind it, as the text writes them");
        field("letters", self.letters, "of a line of letters: the words behind each");
    }
};

struct ViewEdit {
    static constexpr TypeName type{"ViewEdit", "another value for a setting of a view file"};
    std::string name;
    int number = 0;
    std::optional<std::string> letter;
    Nullable<std::string> values;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "with its colon");
        field("number", self.number,
              "of the place among those that say this setting, from 0 on; their count: a new one", at_least(0));
        field("letter", self.letter, "of a line of letters: which one is changed");
        field("values", self.values, "words that stand behind it then; null: it is taken out");
    }
};

}  // namespace espalier::studio
