// PNG pictures without a compressor: a page keeps them in memory and hands them to the browser.
#include "base/png_file.h"

#include <algorithm>
#include <string_view>

namespace espalier {
namespace {

void put_big(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xFF);
}

/// The cyclic redundancy check of ISO/IEC 15948, annex D.
std::uint32_t check_sum(std::string_view bytes) {
    std::uint32_t sum = 0xFFFFFFFF;
    for (const char byte : bytes) {
        sum ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0xEDB88320 : sum >> 1;
    }
    return ~sum;
}

void put_chunk(std::string& out, const std::string& type, const std::string& content) {
    put_big(out, static_cast<std::uint32_t>(content.size()));
    out += type + content;
    put_big(out, check_sum(type + content));
}

std::uint32_t adler(std::string_view bytes) {
    std::uint32_t a = 1, b = 0;
    for (const char byte : bytes) {
        a = (a + static_cast<std::uint8_t>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

/// In the form of zlib (RFC 1950), blocks as they are (RFC 1951, section 3.2.4).
std::string stored(std::string_view bytes) {
    constexpr std::size_t most = 65535;
    std::string out = "\x78\x01";
    for (std::size_t at = 0; at < bytes.size(); at += most) {
        const std::string_view part = bytes.substr(at, most);
        const auto size = static_cast<std::uint16_t>(part.size());
        out += static_cast<char>(at + most >= bytes.size());
        for (const unsigned word : {unsigned{size}, ~unsigned{size}}) {
            out += static_cast<char>(word & 0xFF);
            out += static_cast<char>(word >> 8 & 0xFF);
        }
        out += part;
    }
    put_big(out, adler(bytes));
    return out;
}

}  // namespace

std::string png_bytes(const OpacityPicture& picture) {
    std::string head, rows;
    put_big(head, static_cast<std::uint32_t>(picture.width));
    put_big(head, static_cast<std::uint32_t>(picture.height));
    head += {8, 6, 0, 0, 0};  // bits a channel; red, green, blue, opacity; deflate, filters, not interlaced
    for (std::size_t y = 0; y < picture.height; ++y) {
        rows += '\0';  // no filter
        rows.append(reinterpret_cast<const char*>(&picture.pixels[y * picture.width]), 4 * picture.width);
    }
    std::string out("\x89PNG\r\n\x1a\n", 8);
    put_chunk(out, "IHDR", head);
    put_chunk(out, "IDAT", stored(rows));
    put_chunk(out, "IEND", "");
    return out;
}

}  // namespace espalier
