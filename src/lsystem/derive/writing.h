// Writes what measuring found: the pass that decides how fast a plant grows.
#pragma once

#include "lsystem/derive/rewriting.h"

#include <cstring>

namespace espalier {

/// Copies in whole blocks what runs of modules that live on have, which is seldom more than one block.
template <std::size_t block, class T>
inline void copy_run(const T* from, T* to, std::size_t count) {
    std::memcpy(to, from, block * sizeof(T));
    for (std::size_t k = block; k < count; k += block) std::memcpy(to + k, from + k, block * sizeof(T));
}

/// Writes the part of `to` that replaces a chunk; the columns have their final size.
/// False if the chunk's measure does not fit its modules: then nothing outside the chunk's part was written.
bool write(const StepInput& input, Scratch& scratch, const Chunk& chunk, Machine& machine, ModuleString& to);

/// Writes identities and, if they are kept, parents and births of what replaces a chunk.
void write_lineage(const StepInput& input, const Chunk& chunk, ModuleString& to);

/// The same of a whole string, in columns with room for a block behind their ends.
void write_lineage(const Plans& plans, std::span<const Change> changes, const ModuleString& from, std::uint32_t step,
                   ModuleString& to);

}  // namespace espalier
