#include "base/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace espalier {
namespace {

// The two characters of every twelve bits.
constexpr std::array<char, 8192> base64_pairs = [] {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<char, 8192> pairs{};
    for (std::size_t i = 0; i < 4096; ++i) {
        pairs[2 * i] = digits[i >> 6];
        pairs[2 * i + 1] = digits[i & 63];
    }
    return pairs;
}();

std::array<std::int8_t, 256> base64_values() {
    std::array<std::int8_t, 256> values;
    values.fill(-1);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
    }
    return values;
}

}  // namespace

char* write_base64(const unsigned char* bytes, std::size_t count, char* out) {
    for (std::size_t i = 0; i < count; i += 3, out += 4) {
        const std::uint32_t bits =
            std::uint32_t{bytes[i]} << 16 | std::uint32_t{bytes[i + 1]} << 8 | std::uint32_t{bytes[i + 2]};
        std::memcpy(out, &base64_pairs[2 * std::size_t{bits >> 12}], 2);
        std::memcpy(out + 2, &base64_pairs[2 * std::size_t{bits & 4095}], 2);
    }
    return out;
}

char* write_base64_end(const unsigned char* bytes, std::size_t count, char* out) {
    if (count == 0) return out;
    const unsigned char triplet[3] = {bytes[0], count > 1 ? bytes[1] : static_cast<unsigned char>(0), 0};
    out = write_base64(triplet, 3, out);
    std::fill(out - (count > 1 ? 1 : 2), out, '=');
    return out;
}

std::string base64(std::string_view bytes) {
    std::string text(base64_length(bytes.size()), '\0');
    const auto* at = reinterpret_cast<const unsigned char*>(bytes.data());
    const std::size_t whole = bytes.size() / 3 * 3;
    write_base64_end(at + whole, bytes.size() - whole, write_base64(at, whole, text.data()));
    return text;
}

bool decode_base64(std::string_view text, std::vector<char>& bytes) {
    static const std::array<std::int8_t, 256> value_of = base64_values();
    if (text.size() % 4 != 0) return false;
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
    bytes.clear();
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int value = i >= text.size() - padding ? 0 : value_of[static_cast<unsigned char>(text[i])];
        if (value < 0) return false;
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        if (i % 4 != 3) continue;
        for (const int shift : {16, 8, 0}) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
    }
    bytes.resize(bytes.size() - padding);
    return true;
}

}  // namespace espalier
