// Binary messages of the studio: little-endian numbers at multiples of their size.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace espalier::studio {

static_assert(std::endian::native == std::endian::little, "the studio's messages are the memory of the machine");

class MessageBytes {
public:
    explicit MessageBytes(std::string_view letters) : bytes_(letters) {}

    template <class... Numbers>
    void put(Numbers... numbers) {
        (append(&numbers, sizeof numbers), ...);
    }
    template <class T>
    void put_all(std::span<const T> values) {
        append(values.data(), values.size_bytes());
    }
    /// Its length and the text, padded with zeros to a multiple of 4.
    void put_text(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size()));
        bytes_ += text;
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    }
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
    std::string take() { return std::move(bytes_); }

private:
    void append(const void* at, std::size_t size) { bytes_.append(static_cast<const char*>(at), size); }

    std::string bytes_;
};

}  // namespace espalier::studio
