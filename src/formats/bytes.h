// Binary files are put together as text of bytes, the least significant first.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace espalier::formats {

static_assert(std::endian::native == std::endian::little, "binary exports copy numbers as they lie in memory");

template <class T>
void append_bytes(std::string& bytes, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(bytes.data() + at, &value, sizeof(T));
}

}  // namespace espalier::formats
