#include "base/unit_text.h"

#include "base/text.h"

#include <utility>
#include <vector>

namespace espalier {

std::string plain_unit(std::string_view unit) {
    static const std::vector<std::pair<std::string, std::string>> letters{
        {"\xC2\xB5", "u"}, {"\xCE\xBC", "u"}, {"\xE2\x81\xBB", "-"}, {"\xC2\xB2", "2"}, {"\xC2\xB9", "1"},
        {"\xC2\xB7", " "}, {"\xC2\xB0", ""},  {"\xE2\x88\x92", "-"}, {"^", ""},         {"\xB5", "u"},
        {"\xB2", "2"},     {"\xB9", "1"},     {"\xB7", " "},         {"\xB0", ""}};  // the last five are Latin-1
    std::string plain(trimmed(unit));
    for (const auto& [from, to] : letters) {
        for (std::size_t at = plain.find(from); at != std::string::npos; at = plain.find(from, at)) {
            plain.replace(at, from.size(), to);
        }
    }
    return plain;
}

NameAndUnit name_and_unit(std::string_view cell) {
    const std::size_t open = cell.find_first_of("(["), close = cell.find_last_of(")]");
    if (open == std::string::npos || close == std::string::npos || close < open)
        return {std::string(trimmed(cell)), ""};
    return {std::string(trimmed(cell.substr(0, open))), std::string(trimmed(cell.substr(open + 1, close - open - 1)))};
}

}  // namespace espalier
