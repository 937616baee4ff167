// Arrays as the bytes of NumPy's files: np.load() and torch.from_numpy() read them.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>

namespace espalier {

/// Version 1.0 of the format (Kern 2007, NumPy Enhancement Proposal 1): rows of the last axis follow each other.
template <class Value>
std::string npy_bytes(std::span<const std::size_t> shape, std::span<const std::type_identity_t<Value>> values) {
    static_assert(std::endian::native == std::endian::little);
    const char kind = std::is_floating_point_v<Value> ? 'f' : std::is_signed_v<Value> ? 'i' : 'u';
    std::string head = fmt::format("{{'descr': '<{}{}', 'fortran_order': False, 'shape': ({},), }}", kind,
                                   sizeof(Value), fmt::join(shape, ", "));
    constexpr std::size_t before = 10, multiple = 64;
    while ((before + head.size() + 1) % multiple != 0) head += ' ';
    head += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(head.size() & 255);
    bytes += static_cast<char>(head.size() >> 8);
    bytes += head;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return bytes;
}

}  // namespace espalier
