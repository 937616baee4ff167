// The words and signs of a skeleton description, each with its place.
#pragma once

#include "language/text/source.h"

#include <string>
#include <vector>

namespace espalier::language::sdl {

struct Token {
    enum class Kind { name, directive, number, sign, end };
    Kind kind = Kind::end;
    std::string text;
    Location at;

    /// "'->'", or "the end of the file"
    std::string shown() const;
};

/// The last token is the end. Characters that belong to no token are mistakes.
std::vector<Token> tokens_of(const std::string& text, std::uint32_t file, Mistakes& mistakes);

}  // namespace espalier::language::sdl
