#include "lsystem/programs/scan_format.h"

#include "base/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace espalier::lsystem {
namespace {

constexpr std::size_t widest = 1'000'000;

bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

void skip_blanks(std::string_view text, std::size_t& position) {
    while (position < text.size() && is_blank(text[position])) ++position;
}

/// A sign is read apart: from_chars takes '-' only.
double accept_sign(std::string_view& text) {
    if (text.empty() || (text[0] != '-' && text[0] != '+')) return 1;
    const double sign = text[0] == '-' ? -1 : 1;
    text.remove_prefix(1);
    return sign;
}

std::size_t read_number(std::string_view text, double& value) {
    std::string_view rest = text;
    const double sign = accept_sign(rest);
    if (!rest.empty() && (rest[0] == '-' || rest[0] == '+')) return 0;
    const auto [end, error] = espalier::read_number(rest.data(), rest.data() + rest.size(), value);
    if (end == rest.data()) return 0;
    if (error == std::errc::result_out_of_range) value = 0;
    value *= sign;
    return static_cast<std::size_t>(end - text.data());
}

std::size_t read_whole(std::string_view text, int base, double& value) {
    std::string_view rest = text;
    const double sign = accept_sign(rest);
    if (!rest.empty() && (rest[0] == '-' || rest[0] == '+')) return 0;
    const bool hexadecimal = rest.size() > 2 && rest[0] == '0' && (rest[1] == 'x' || rest[1] == 'X');
    if (base == 0) base = hexadecimal ? 16 : rest.size() > 1 && rest[0] == '0' && is_digit(rest[1]) ? 8 : 10;
    if (base == 16 && hexadecimal) rest.remove_prefix(2);
    unsigned long long whole = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), whole, base);
    if (end == rest.data()) return 0;
    value = sign * static_cast<double>(error == std::errc() ? whole : ~0ull);
    return static_cast<std::size_t>(end - text.data());
}

}  // namespace

ScanFormat::ScanFormat(std::string_view format, const Place& place) {
    for (std::size_t i = 0; i < format.size();) {
        Piece piece;
        if (is_blank(format[i])) {
            while (i < format.size() && is_blank(format[i])) ++i;
            pieces_.push_back(piece);
        } else if (format[i] != '%') {
            piece.kind = Piece::Kind::literal;
            piece.literal = format[i++];
            pieces_.push_back(piece);
        } else {
            i = conversion(format, i + 1, place);
        }
    }
}

/// Takes apart the conversion whose '%' stands before `at`; returns where it ends.
std::size_t ScanFormat::conversion(std::string_view format, std::size_t at, const Place& place) {
    const std::size_t begin = at - 1;
    const auto refuse = [&](const char* why) {
        const std::string_view what = format.substr(begin, std::min(at + 1, format.size()) - begin);
        throw UserError(place, fmt::format("'{}' {}", what, why));
    };
    Piece piece;
    piece.stored = !(at < format.size() && format[at] == '*');
    if (!piece.stored) ++at;
    for (; at < format.size() && is_digit(format[at]); ++at) {
        piece.width = std::min(widest, piece.width * 10 + static_cast<std::size_t>(format[at] - '0'));
    }
    while (at < format.size() && std::string_view("hlLqjzt").find(format[at]) != std::string_view::npos) ++at;
    const char letter = at < format.size() ? format[at] : '\0';
    if (letter == '%') {
        piece.kind = Piece::Kind::literal;
        piece.literal = '%';
        pieces_.push_back(piece);
        return at + 1;
    }
    if (letter != '\0' && std::string_view("fFeEgGaA").find(letter) != std::string_view::npos) {
        piece.kind = Piece::Kind::number;
    } else if (letter != '\0' && std::string_view("diuxXo").find(letter) != std::string_view::npos) {
        piece.kind = Piece::Kind::whole;
        piece.base = letter == 'i' ? 0 : letter == 'o' ? 8 : letter == 'x' || letter == 'X' ? 16 : 10;
    } else if (letter == 'c') {
        piece.kind = Piece::Kind::character;
    } else if (letter == 's') {
        piece.kind = Piece::Kind::word;
    } else if (letter == '[') {
        piece.kind = Piece::Kind::set;
        std::size_t end = at + 1;
        if (end < format.size() && format[end] == '^') ++end;
        end = format.find(']', end + 1);
        if (end == std::string_view::npos) refuse("is never closed by ']'");
        piece.excluded = format[at + 1] == '^';
        const std::size_t first = at + (piece.excluded ? 2 : 1);
        piece.set = format.substr(first, end - first);
        at = end;
    } else {
        refuse("is not a conversion that fscanf knows");
    }
    const bool text = piece.kind == Piece::Kind::word || piece.kind == Piece::Kind::set;
    if (text && piece.stored) refuse("gives a text, and variables hold numbers: skip it with '%*s' or '%*[...]'");
    if (piece.stored) ++conversions_;
    pieces_.push_back(std::move(piece));
    return at + 1;
}

/// One conversion; false if what stands there does not fit it.
bool ScanFormat::read(const Piece& piece, std::string_view text, std::size_t& position, double& value) {
    const std::string_view rest = text.substr(position, piece.width > 0 ? piece.width : std::string_view::npos);
    std::size_t length = 0;
    switch (piece.kind) {
        case Piece::Kind::number:
            length = read_number(rest, value);
            break;
        case Piece::Kind::whole:
            length = read_whole(rest, piece.base, value);
            break;
        case Piece::Kind::character:
            length = std::min(std::max<std::size_t>(piece.width, 1), text.size() - position);
            if (length > 0) value = static_cast<unsigned char>(text[position]);
            break;
        case Piece::Kind::word:
            while (length < rest.size() && !is_blank(rest[length])) ++length;
            break;
        default:
            while (length < rest.size() && (piece.set.find(rest[length]) != std::string::npos) != piece.excluded) {
                ++length;
            }
            break;
    }
    position += length;
    return length > 0;
}

int ScanFormat::scan(std::string_view text, std::size_t& position, double* values) const {
    int stored = 0;
    bool converted = false;
    for (const Piece& piece : pieces_) {
        const bool exact = piece.kind == Piece::Kind::character || piece.kind == Piece::Kind::set ||
                           piece.kind == Piece::Kind::literal;
        if (!exact) skip_blanks(text, position);
        if (piece.kind == Piece::Kind::blank) continue;
        if (position >= text.size()) return stored == 0 && !converted ? -1 : stored;
        if (piece.kind == Piece::Kind::literal) {
            if (text[position] != piece.literal) return stored;
            ++position;
            continue;
        }
        double value = 0;
        if (!read(piece, text, position, value)) return stored;
        converted = true;
        if (piece.stored) values[stored++] = value;
    }
    return stored;
}

}  // namespace espalier::lsystem
