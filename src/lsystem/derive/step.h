// One derivation step of a string: what the ways of doing it share.
#pragma once

#include "base/parallel.h"
#include "lsystem/compile/compiled_model.h"
#include "lsystem/derive/matching.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace espalier::lsystem {

// Memory and machines that steps need only while they run: a stand of ten thousand small plants has no more of them
// than threads.
struct Scratch;

/// The machines of an L-system as one plant uses them.
class Machines {
public:
    Machines(const CompiledSystem& system, Variables& variables, Services& services)
        : system_(system), variables_(variables), services_(services) {}

    /// The calling thread's machine, which works for this plant until the thread turns to another.
    Machine& local() const;

private:
    const CompiledSystem& system_;
    Variables& variables_;
    Services& services_;
};

/// Lends a scratch for one step: of a small string the thread's, else the plant's own, which is made if there is none.
/// For large strings the thread's would not do: while it waits for others it may begin another plant's step.
class ScratchLease {
public:
    ScratchLease(std::size_t modules, std::unique_ptr<Scratch>& own);
    ~ScratchLease();
    ScratchLease(const ScratchLease&) = delete;
    ScratchLease& operator=(const ScratchLease&) = delete;

    Scratch& scratch() const { return *scratch_; }

private:
    Scratch* scratch_;
    bool of_thread_ = false;
};

/// Everything a step reads.
struct StepInput {
    const CompiledSystem& system;
    const ModuleString& from;
    StringView view;
    RandomKey key;
    std::uint32_t step = 0;
    bool lineage = false;  ///< births are kept
    std::size_t memory = 0;
    /// Ranges of modules that live on: the whole string but for what a `%` cuts off.
    const std::vector<std::pair<std::size_t, std::size_t>>& kept;

    /// For random numbers; 0 where none are taken.
    Identity identity(std::size_t module) const { return lineage && system.samples() ? from.identity(module) : 0; }
};

/// A module that is replaced, or may be.
struct Replacement {
    std::size_t parameters_at;  ///< where the module's parameters begin in the old string
    std::uint32_t module;
    std::uint32_t plan;  ///< among Plans::choices; the module's place in the table of outcomes until that is known
};

/// A range of the string that one thread rewrites.
struct Chunk {
    std::size_t begin = 0, end = 0;
    std::size_t parameters_begin = 0, parameters_end = 0;
    Extent becomes;  ///< what replaces it
    Extent at;       ///< where that begins in the new string
    // Where letters alone do not decide: how many modules productions may replace, where these have room among those of
    // all chunks, and what is replaced.
    std::size_t candidates = 0, room = 0;
    std::span<const Replacement> replacements;
    bool is_last = false;  ///< behind it columns may have room for whole blocks
    std::string error;
};

/// Memory that steps reuse.
struct Scratch {
    BranchLinks links;
    Neighbours neighbours;
    ParameterPlaces places;
    std::vector<std::pair<std::size_t, std::size_t>> kept;
    std::vector<Chunk> chunks;
    Column<LetterId> outcomes;         ///< each module's place in the table of outcomes
    Column<Replacement> replacements;  ///< replacements of all chunks
    std::vector<ModuleString> pieces;  ///< parts of the new string whose length is not known before they are written
};

/// Splits what is kept into chunks, finds where their parameters begin and, where letters alone decide, what they
/// become. Throws RunError if the string has not as many parameters as its letters say.
void make_chunks(const StepInput& input, Scratch& scratch);

/// Calls work(chunk, machine) for all chunks, in parallel if there are several. If several fail, the first in string
/// order is reported.
template <class Work>
void for_each_chunk(std::vector<Chunk>& chunks, Machines& machines, Work&& work) {
    if (chunks.size() == 1) return work(chunks[0], machines.local());
    std::atomic<std::size_t> failed = chunks.size();
    for_in_parallel(std::size_t{0}, chunks.size(), [&](std::size_t k) {
        if (k > failed.load()) return;  // an earlier chunk's error will be reported
        try {
            work(chunks[k], machines.local());
        } catch (const RunError& error) {
            chunks[k].error = error.what();
            std::size_t first = failed.load();
            while (k < first && !failed.compare_exchange_weak(first, k)) {
            }
        }
    });
    if (failed < chunks.size()) throw RunError(chunks[failed].error);
}

/// Bytes of a string, without the room that its memory has besides: that may have been another plant's.
std::size_t bytes_needed(const Extent& extent, bool lineage);
inline std::size_t bytes_before(const StepInput& input) {
    return bytes_needed({input.from.size(), input.from.parameters.size(), input.from.siblings.size()}, input.lineage);
}

/// Makes the columns of a string so large, giving memory back first if they are too small.
void resize(ModuleString& string, const Extent& extent, bool lineage);

/// Makes `to` as large as what the step from `input` writes, whose siblings come behind those of the old string. Throws
/// RunError if the step would outgrow its memory with the `held` bytes of the old string and of parts; `uses` then
/// counts the uses of each production.
void make_room(const StepInput& input, const Extent& added, std::size_t held, ModuleString& to,
               const std::function<std::vector<std::uint64_t>()>& uses);
[[noreturn]] void refuse_memory(const StepInput& input, std::size_t modules, std::size_t bytes,
                                const std::vector<std::uint64_t>& uses);

/// Forgets rows of siblings that none of the string's modules belong to, once they are most of the table.
void drop_unused_siblings(ModuleString& string);

// The ways of doing a step of any string; small_step.h is the short one of some. All write the same string.

/// Match and choose, prefix sum, write, in parallel: for productions that can be applied in any order, without
/// decomposition.
void rewrite_in_parallel(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to);

/// Chunks are rewritten and decomposed apart, and then joined. `limit` is set if decomposition stopped at its maximum
/// depth though it could have gone on.
void rewrite_and_decompose(const StepInput& input, Scratch& scratch, Machines& machines, Services& services,
                           ModuleString& to, std::atomic<bool>& limit);

}  // namespace espalier::lsystem
