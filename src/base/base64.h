// Bytes as text (RFC 4648).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// Returns the length of the text for so many bytes.
constexpr std::size_t base64_length(std::size_t bytes) {
    return (bytes + 2) / 3 * 4;
}

/// Writes whole triplets of bytes, and returns where the text ends.
char* write_base64(const unsigned char* bytes, std::size_t count, char* out);
/// The last one or two bytes, if any.
char* write_base64_end(const unsigned char* bytes, std::size_t count, char* out);
std::string base64(std::string_view bytes);

/// Returns false if `text` is not base64, whole quadruples with padding at the end only.
bool decode_base64(std::string_view text, std::vector<char>& bytes);

}  // namespace espalier
