// All that the models of a growth print: one note, as long as it can be read.
#pragma once

#include "studio/session/pages.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace espalier::studio {

class PrintedNote {
public:
    explicit PrintedNote(Pages& pages) : pages_(pages) {}

    /// Another growth begins; what the last one printed stays until this one prints.
    void clear() { text_.clear(); }

    void add(const std::string& text) {
        if (text_.size() > most_shown) return;
        text_ += text;
        const bool is_cut = text_.size() > most_shown;
        number_ = pages_.replace_note(number_, "note",
                                      "Printed by the model:\n" + text_.substr(0, most_shown) +
                                          (is_cut ? "\nMore is left out here; `espalier derive` prints it." : ""));
    }

private:
    static constexpr std::size_t most_shown = 4000;

    Pages& pages_;
    std::string text_;
    std::uint32_t number_ = 0;  ///< of its note; 0: none so far
};

}  // namespace espalier::studio
