#include "language/parser/lookalikes.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace espalier::language {
namespace {

struct Lookalike {
    std::uint32_t first, last;  ///< code points
    const char *name, *key;
};

constexpr std::array lookalikes{
    Lookalike{0x00A0, 0x00A0, "no-break space", "a blank"},
    Lookalike{0x00A6, 0x00A6, "broken bar", "'|'"},
    Lookalike{0x00AB, 0x00AB, "quotation mark", "'\"'"},
    Lookalike{0x00AD, 0x00AD, "soft hyphen", "nothing, or '-'"},
    Lookalike{0x00B4, 0x00B4, "acute accent", "\"'\""},
    Lookalike{0x00B7, 0x00B7, "middle dot", "'*' or '.'"},
    Lookalike{0x00BB, 0x00BB, "quotation mark", "'\"'"},
    Lookalike{0x00D7, 0x00D7, "multiplication sign", "'*'"},
    Lookalike{0x00F7, 0x00F7, "division sign", "'/'"},
    Lookalike{0x02C6, 0x02C6, "circumflex accent", "'^'"},
    Lookalike{0x02DC, 0x02DC, "small tilde", "'~'"},
    Lookalike{0x2002, 0x200A, "wide or narrow space", "a blank"},
    Lookalike{0x200B, 0x200F, "character without width", "nothing"},
    Lookalike{0x2010, 0x2015, "dash", "'-'"},
    Lookalike{0x2018, 0x201B, "quotation mark", "\"'\""},
    Lookalike{0x201C, 0x201F, "quotation mark", "'\"'"},
    Lookalike{0x2026, 0x2026, "ellipsis", "'...'"},
    Lookalike{0x202F, 0x202F, "narrow space", "a blank"},
    Lookalike{0x2032, 0x2032, "prime", "\"'\""},
    Lookalike{0x2033, 0x2033, "double prime", "'\"'"},
    Lookalike{0x2044, 0x2044, "fraction slash", "'/'"},
    Lookalike{0x2060, 0x2060, "character without width", "nothing"},
    Lookalike{0x2190, 0x2190, "arrow", "'<--'"},
    Lookalike{0x2192, 0x2192, "arrow", "'-->'"},
    Lookalike{0x21D2, 0x21D2, "arrow", "'-->'"},
    Lookalike{0x2212, 0x2212, "minus sign", "'-'"},
    Lookalike{0x2215, 0x2215, "division slash", "'/'"},
    Lookalike{0x2216, 0x2216, "set minus", "'\\'"},
    Lookalike{0x2217, 0x2217, "asterisk operator", "'*'"},
    Lookalike{0x2219, 0x2219, "bullet operator", "'*'"},
    Lookalike{0x2223, 0x2223, "vertical line", "'|'"},
    Lookalike{0x223C, 0x223C, "tilde operator", "'~'"},
    Lookalike{0x2260, 0x2260, "not-equal sign", "'!='"},
    Lookalike{0x2264, 0x2264, "less-or-equal sign", "'<='"},
    Lookalike{0x2265, 0x2265, "greater-or-equal sign", "'>='"},
    Lookalike{0x22C5, 0x22C5, "dot operator", "'*'"},
    Lookalike{0x2794, 0x2794, "arrow", "'-->'"},
    Lookalike{0x27E8, 0x27E8, "angle bracket", "'<'"},
    Lookalike{0x27E9, 0x27E9, "angle bracket", "'>'"},
    Lookalike{0x27F6, 0x27F6, "arrow", "'-->'"},
    Lookalike{0x3000, 0x3000, "wide space", "a blank"},
    Lookalike{0xFEFF, 0xFEFF, "byte-order mark", "nothing"},
};

/// Letters of other alphabets that look like these, one for one.
constexpr std::u32string_view other_letters =
    U"\u0391\u0392\u0395\u0396\u0397\u0399\u039A\u039C\u039D\u039F\u03A1\u03A4\u03A5\u03A7\u03BF"  // Greek
    U"\u0410\u0412\u0415\u041A\u041C\u041D\u041E\u0420\u0421\u0422\u0425\u0430\u0435\u043E\u0440\u0441\u0443"
    U"\u0445";  // Cyrillic
constexpr std::string_view latin_letters = "ABEZHIKMNOPTYXoABEKMHOPCTXaeopcyx";
static_assert(other_letters.size() == latin_letters.size());

constexpr std::uint32_t first_wide = 0xFF01, last_wide = 0xFF5E;  // of ! to ~

/// The code point of a character in UTF-8.
std::uint32_t code_of(std::string_view character) {
    std::uint32_t code = static_cast<unsigned char>(character.front()) & (0x7Fu >> character.size());
    for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3Fu);
    return code;
}

std::string message(std::string_view character, std::uint32_t code, std::string_view name, std::string_view key) {
    const char* const article = name.front() == 'a' || name.front() == 'e' ? "an" : "a";
    return fmt::format("'{}', {} {} (U+{:04X}): type {}", character, article, name, code, key);
}

/// What the code page of Windows for western Europe has in this place, which is no UTF-8.
std::string lone_byte(unsigned char byte) {
    const char* const key = byte == 0x96 || byte == 0x97   ? "'-'"
                            : byte == 0x91 || byte == 0x92 ? "\"'\""
                            : byte == 0x93 || byte == 0x94 ? "'\"'"
                            : byte == 0xA0                 ? "a blank"
                                                           : "";
    return fmt::format("the byte {:#04x}, which is no text in UTF-8: {}save the file in UTF-8", byte,
                       *key ? fmt::format("type {}, or ", key) : "");
}

}  // namespace

std::string lookalike(std::string_view text) {
    if (text.empty() || static_cast<unsigned char>(text.front()) < 0x80) return "";
    const std::size_t length = shown_length(text, 0);
    if (length == 0) return lone_byte(static_cast<unsigned char>(text.front()));
    const std::string_view character = text.substr(0, length);
    const std::uint32_t code = code_of(character);
    const auto found = std::find_if(lookalikes.begin(), lookalikes.end(),
                                    [&](const Lookalike& each) { return code >= each.first && code <= each.last; });
    if (found != lookalikes.end()) return message(character, code, found->name, found->key);
    if (code >= first_wide && code <= last_wide) {
        const char key = static_cast<char>('!' + (code - first_wide));
        return message(character, code, "wide character", fmt::format("'{}'", key));
    }
    const std::size_t letter = other_letters.find(static_cast<char32_t>(code));
    if (letter == std::u32string_view::npos) return "";
    return message(character, code, "letter of another alphabet", fmt::format("'{}'", latin_letters[letter]));
}

}  // namespace espalier::language
