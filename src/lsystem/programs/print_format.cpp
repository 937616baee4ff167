#include "lsystem/programs/print_format.h"

#include "espalier/base/stop.h"

#include "lsystem/programs/limits.h"

#include <cmath>
#include <cstdio>

namespace espalier::lsystem {
namespace {

constexpr std::string_view floating = "fFeEgGaA";
constexpr std::string_view whole = "diuxXoc";
constexpr std::size_t longest_specification = 8;

bool one_of(std::string_view set, char letter) {
    return set.find(letter) != std::string_view::npos;
}

template <class T>
std::string print_one(const std::string& specification, T value) {
    const int length = std::snprintf(nullptr, 0, specification.c_str(), value);
    if (length <= 0) return "";
    std::string text(static_cast<std::size_t>(length) + 1, '\0');
    std::snprintf(text.data(), text.size(), specification.c_str(), value);
    text.pop_back();
    return text;
}

long long to_whole(double value) {
    constexpr double largest = 9.2e18;
    if (!(std::fabs(value) < largest)) return 0;
    return static_cast<long long>(value);
}

}  // namespace

PrintFormat::PrintFormat(std::string_view format) {
    std::string literal;
    for (std::size_t i = 0; i < format.size(); ++i) {
        if (format[i] != '%') {
            literal += format[i];
            continue;
        }
        if (i + 1 < format.size() && format[i + 1] == '%') {
            literal += '%';
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        while (end < format.size() && one_of("-+ 0#123456789.", format[end])) ++end;
        std::string specification(format.substr(i, end - i));
        while (end < format.size() && one_of("hlLqjzt", format[end])) ++end;
        const char conversion = end < format.size() ? format[end] : '\0';
        const bool known = one_of(floating, conversion) || one_of(whole, conversion) || conversion == 's';
        if (conversion == '\0' || !known || specification.size() > longest_specification) {
            literal += '%';
            continue;
        }
        if (one_of(whole, conversion) && conversion != 'c') specification += "ll";
        specification += conversion;
        pieces_.push_back({std::move(literal), std::move(specification), conversion});
        literal.clear();
        i = end;
    }
    after_ = std::move(literal);
}

std::string PrintFormat::fill(const std::vector<Value>& values) const {
    std::string text;
    for (std::size_t k = 0; k < pieces_.size() && text.size() <= most_printed_at_once; ++k) {
        end_if_asked();
        const Piece& piece = pieces_[k];
        text += piece.before;
        const Value value = k < values.size() ? values[k] : Value();
        if (piece.conversion == 's') {
            text += print_one(piece.specification, value.text ? value.text->c_str() : "");
        } else if (piece.conversion == 'c') {
            text += print_one(piece.specification, static_cast<int>(to_whole(value.number) & 0xFF));
        } else if (one_of(whole, piece.conversion)) {
            text += print_one(piece.specification, to_whole(value.number));
        } else {
            text += print_one(piece.specification, value.number);
        }
    }
    return text + after_;
}

}  // namespace espalier::lsystem
