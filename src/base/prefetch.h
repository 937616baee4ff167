// Asking for memory some time before it is needed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace espalier {

/// A hint: the `bytes` from `at` on will be read or written soon. They need not be anyone's memory. They come as near
/// as the second level of caches: the first has room for few requests, and would be waited for.
inline void prefetch(const void* at, std::size_t bytes) {
    constexpr std::uintptr_t line = 64;
    const auto first = reinterpret_cast<std::uintptr_t>(at);
    for (std::uintptr_t next = first / line * line; next < first + bytes; next += line) {
        __builtin_prefetch(reinterpret_cast<const void*>(next), /*rw=*/0, /*locality=*/2);
    }
}

/// The same for one line, which comes as near as it can.
inline void prefetch(const void* at) {
    __builtin_prefetch(at);
}

}  // namespace espalier
