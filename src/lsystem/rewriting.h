// One derivation step of a string: what both ways of doing it share.
#pragma once

#include "compiled_model.h"
#include "matching.h"

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace espalier {

/// Everything a step reads.
struct StepInput {
    const CompiledSystem& model;
    const ModuleString& from;
    StringView view;
    RandomKey key;
    std::uint32_t step = 0;
    bool lineage = false;
    std::size_t memory = 0;
    /// Ranges of modules that live on: the whole string but for what a `%` cuts off.
    const std::vector<std::pair<std::size_t, std::size_t>>& kept;
};

using Machines = tbb::enumerable_thread_specific<Machine>;

/// A range of the string that one thread rewrites.
struct Chunk {
    std::size_t begin = 0, end = 0;
    std::size_t parameters_at = 0;     ///< of `begin` in the string
    std::size_t out = 0, out_end = 0;  ///< in the new string
    std::size_t out_parameters = 0, out_parameters_end = 0;
    std::string error;
};

/// Memory that steps reuse.
struct Scratch {
    BranchLinks links;
    Column<std::size_t> offsets;
    std::vector<std::pair<std::size_t, std::size_t>> kept;
    std::vector<Chunk> chunks;
    Column<LetterId> choices;          ///< which of its letter's Plan::choices each module takes
    std::vector<ModuleString> pieces;  ///< of chunks whose length is not known before they are written
};

/// The modules born of one parent in one step.
class Brood {
public:
    Brood(Identity parent, std::uint32_t step) : origin_(mix(parent, step)) {}
    /// `depth` tells apart those born when the parent itself was decomposed.
    Identity born(std::uint32_t place, std::uint32_t depth = 0) const {
        return mix(origin_ ^ ((std::uint64_t{depth} << 32) | place));
    }

private:
    std::uint64_t origin_;
};

/// Splits what is kept into chunks, finds where their parameters begin, and adds up the lengths of letters' plans:
/// the measure of the new string where every letter's plan is known.
/// Throws RunError if the string has not as many parameters as its letters say.
void make_chunks(const StepInput& input, Scratch& scratch);

/// Calls work(chunk, machine) for all chunks in parallel. If several fail, the first in string order is reported.
void for_each_chunk(std::vector<Chunk>& chunks, Machines& machines, const std::function<void(Chunk&, Machine&)>& work);

/// Makes room for a string, giving memory back first if it is too small.
void resize(ModuleString& string, std::size_t modules, std::size_t parameters, bool lineage);
std::size_t bytes_needed(std::size_t modules, std::size_t parameters, bool lineage);

/// Throws RunError: the step would outgrow its memory. `uses` counts the uses of each production.
[[noreturn]] void refuse_memory(const StepInput& input, std::size_t modules, std::size_t bytes,
                                const std::vector<std::uint64_t>& uses);

/// Match and measure, prefix sum, write: for productions that can be applied in any order, without decomposition.
void rewrite_in_two_passes(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to);

/// One pass, with decomposition; in string order if the model asks for it, else by chunks that are then joined.
/// `limit` is set if decomposition stopped at its maximum depth though it could have gone on.
void rewrite_in_one_pass(const StepInput& input, Scratch& scratch, Machines& machines, Services& services,
                         ModuleString& to, std::atomic<bool>& limit);

}  // namespace espalier
