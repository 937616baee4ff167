// How much a model may ask for before it is stopped: seconds, where others would hang.
#pragma once

#include <cstddef>
#include <cstdint>

namespace espalier::lsystem {

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr std::uint64_t most_turns = 1'000;
inline constexpr double most_tosses = 1e3;
inline constexpr double most_elements = 1e5;
inline constexpr std::size_t most_file_bytes = 1 << 16;
inline constexpr std::size_t most_printed_at_once = 1 << 16;
#else
inline constexpr std::uint64_t most_turns = 100'000'000;              ///< most turns of all loops of one block
inline constexpr double most_tosses = 1e8;                            ///< most tosses of one biran()
inline constexpr double most_elements = 1e9;                          ///< most elements of one array
inline constexpr std::size_t most_file_bytes = std::size_t{1} << 30;  ///< most bytes of all files a model writes
inline constexpr std::size_t most_printed_at_once =
    std::size_t{1} << 26;  ///< of one printf() or fprintf(), which is left unfinished behind
#endif

inline constexpr std::size_t most_open_files = 1000;

}  // namespace espalier::lsystem
