#include "base/number.h"

#include "base/characters.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <string>

namespace espalier {
namespace {

const char* behind_digits(const char* at, const char* end) {
    while (at != end && is_digit(*at)) ++at;
    return at;
}

/// Where the exponent that begins here ends; without digits it is none.
const char* behind_exponent(const char* at, const char* end) {
    if (at == end || (*at != 'e' && *at != 'E')) return at;
    const char* digits = at + 1;
    if (digits != end && (*digits == '+' || *digits == '-')) ++digits;
    const char* const behind = behind_digits(digits, end);
    return behind == digits ? at : behind;
}

bool begins_with_word(const char* at, const char* end, std::string_view word) {
    for (const char c : word) {
        if (at == end || (*at | 0x20) != c) return false;
        ++at;
    }
    return true;
}

}  // namespace

std::from_chars_result read_real(const char* begin, const char* end, double& number) {
    const bool negative = begin != end && *begin == '-';
    const char* const first = begin + (negative ? 1 : 0);
    for (const std::string_view word : {"infinity", "inf", "nan"}) {
        if (!begins_with_word(first, end, word)) continue;
        const double value = word == "nan" ? std::nan("") : HUGE_VAL;
        number = negative ? -value : value;
        return {first + word.size(), std::errc()};
    }
    const char* behind = behind_digits(first, end);
    const char* fraction = behind;
    if (behind != end && *behind == '.') fraction = behind_digits(behind + 1, end);
    const bool has_digits = behind != first || fraction > behind + 1;
    if (!has_digits) return {begin, std::errc::invalid_argument};
    behind = behind_exponent(fraction, end);
    std::istringstream in(std::string(begin, behind));
    in.imbue(std::locale::classic());
    double value = 0;
    const bool is_zero = std::none_of(first, fraction, [](char c) { return c >= '1' && c <= '9'; });
    if (!(in >> value) || (value == 0 && !is_zero)) return {behind, std::errc::result_out_of_range};
    number = value;
    return {behind, std::errc()};
}

}  // namespace espalier
