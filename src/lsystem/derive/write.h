// Writes what replaces a chunk, once it is known: the pass that decides how fast a plant grows.
#pragma once

#include "lsystem/derive/step.h"

#include <cstring>

namespace espalier::lsystem {

/// Writes letters and values of what replaces a chunk to `to`, whose columns have their final size.
void write(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements, Machine& machine,
           ModuleString& to);

/// The same where letters alone decide and no module has parameters.
void write_letters(const StepInput& input, const Chunk& chunk, ModuleString& to);

/// Writes the births, and the rows of siblings.
void write_births(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements,
                  ModuleString& to);

/// Copies in whole blocks what runs of modules that live on have, which is seldom more than one block.
template <std::size_t block, class T>
inline void copy_run(const T* from, T* to, std::size_t count) {
    std::memcpy(to, from, block * sizeof(T));
    for (std::size_t k = block; k < count; k += block) std::memcpy(to + k, from + k, block * sizeof(T));
}

template <class T>
inline void copy_exactly(const T* from, T* to, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count * sizeof(T));
}

/// How far blocks may reach that are read or written up to the element `end` of a column; behind its last element, as
/// far as it has room.
template <class T>
inline std::ptrdiff_t reach(const Column<T>& column, std::size_t end, std::size_t spare, bool is_last) {
    const bool has_spare = is_last && column.capacity() - column.size() >= spare;
    return static_cast<std::ptrdiff_t>(end + (has_spare ? spare : 0));
}

}  // namespace espalier::lsystem
