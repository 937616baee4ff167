// What a user at the window would do, written down line by line: for pictures of documents and for tests.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace espalier::view {

struct ScriptLine {
    enum class Kind { key, click, drag, wheel, size, screenshot, print, wait };

    Kind kind;
    std::array<int, 4> numbers{0, 0, 0, 0};  ///< pixels from the upper left corner
    std::string word;                        ///< a key, or a file
    bool shift = false;
};

/// Lines as docs/view.md describes them; what follows a # is a comment. Throws UserError with line and nearest name.
std::vector<ScriptLine> parse_script(const std::string& text);

}  // namespace espalier::view
