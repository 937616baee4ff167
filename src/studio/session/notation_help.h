// Help for the words of the languages that the editor knows.
#pragma once

#include "studio/protocol/declaration.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::studio {

struct HelpEntry {
    static constexpr TypeName type{"HelpEntry", "a name and what the manual says of it"};
    std::string name, summary, help;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "as texts write it");
        field("summary", self.summary, "one phrase; may be empty");
        field("help", self.help, "more; may be empty");
    }
};

/// The words of `cpfg`, `sdl` and `species`.
std::map<std::string, std::vector<HelpEntry>> words_of_languages();

}  // namespace espalier::studio
