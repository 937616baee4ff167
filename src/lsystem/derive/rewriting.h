// One derivation step of a string: what both ways of doing it share.
#pragma once

#include "lsystem/compile/compiled_model.h"
#include "lsystem/contexts/matching.h"
#include "lsystem/derive/workplace.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace espalier {

/// What is kept of who the modules are: nothing, or identities of those that come to draw (CompiledSystem::drawers),
/// side by side, or of all, or who bore them and when, too.
enum class Ancestry : std::uint8_t { none, drawers, identities, whole };

/// Everything a step reads.
struct StepInput {
    const CompiledSystem& model;
    const ModuleString& from;
    StringView view;
    RandomKey key;
    std::uint32_t step = 0;
    Ancestry ancestry = Ancestry::none;
    std::size_t memory = 0;
    /// Ranges of modules that live on: the whole string but for what a `%` cuts off.
    const std::vector<std::pair<std::size_t, std::size_t>>& kept;
};

/// What was written in one go, and what the next step will make of it (Plan::next).
struct Stretch {
    std::size_t modules = 0, parameters = 0;
    std::uint64_t next = 0;
    std::uint64_t checksum = 0;  ///< of its letters, where changes are foreseen
};

/// A range of the string that one thread rewrites.
struct Chunk {
    std::size_t begin = 0, end = 0;
    std::size_t parameters_at = 0, parameters_end = 0;
    std::size_t drawers_at = 0, drawers_end = 0;
    std::size_t out = 0, out_end = 0;  ///< in the new string
    std::size_t out_parameters = 0, out_parameters_end = 0;
    std::size_t out_drawers = 0, out_drawers_end = 0;
    // Where not all is known by the letters: what changes, and one more that stands for the chunk's end or beyond.
    Change* changes = nullptr;
    std::size_t change_count = 0;
    std::size_t out_changes = 0, out_changes_end = 0;  ///< that are foreseen in the new string
    std::span<const Stretch> stretches;                ///< that it is made of, where its changes were foreseen
    /// Its measure is that of its modules, and behind it there is room for whole blocks, in the old string and the new.
    bool in_blocks = false;
    std::string error;
};

/// What the writing of a string has found out about it: the chunks of the next step.
struct Forecast {
    static constexpr int most_misses = 3;
    int misses = 0;  ///< what was foreseen was wrong so many times: looking ahead does not pay for this model

    // Which string it was.
    const LetterId* letters = nullptr;
    std::size_t modules = 0, parameters = 0;
    std::vector<Stretch> stretches;
    Column<Change> changes;  ///< in order, and one more that stands for the end
};

/// Memory that steps reuse.
struct Scratch {
    BranchLinks links;
    Neighbours neighbours;
    ParameterPlaces places;
    std::vector<std::pair<std::size_t, std::size_t>> kept;
    std::vector<Chunk> chunks;
    std::vector<std::vector<Stretch>> stretches;  ///< what each chunk wrote
    Column<LetterId> told;                        ///< each module's place in the table of choices
    Column<Change> changes;                       ///< of all chunks, each with room for one more than its modules
    Column<Change> foreseen;                      ///< changes of the new string
    bool foresees = false;                        ///< they are
    std::vector<ModuleString> pieces;             ///< of chunks whose length is not known before they are written
};

/// The table of choices tells all, and nothing but letters is written: no changes are looked for.
inline bool keeps_places(const StepInput& input) {
    return input.model.choosing.tells_all && !input.model.plans.valued() && input.ancestry == Ancestry::none;
}

/// Adds a module to those that wait, with its neighbours if productions may read their parameters.
inline void add_to(Batch& batch, const StepInput& input, std::size_t module, const double* values) {
    using enum ColumnProgram::Whose;
    batch.modules[own][batch.count] = values;
    if (!input.view.places) return;
    const double* const parameters = input.from.parameters.data();
    const auto look = [&](ColumnProgram::Whose whose, const Gaze& gaze, const Column<std::uint32_t>& positions) {
        if (!gaze.wanted || positions[module] == Neighbours::none) return;  // then no production asks
        batch.modules[whose][batch.count] = parameters + (*input.view.places)[positions[module]];
    };
    look(left, input.model.choosing.gazes.left, input.view.neighbours->left);
    look(right, input.model.choosing.gazes.right, input.view.neighbours->right);
}

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

/// The same from the forecast, without reading the string; false if there is none for it. Somebody may have changed
/// the string's letters since: who relies on these chunks must see whether they fit.
bool recall_chunks(const StepInput& input, Forecast& forecast, Scratch& scratch);
/// Keeps what the chunks say of the string that they were written to.
void remember_chunks(const StepInput& input, const ModuleString& to, Scratch& scratch, Forecast& forecast);

/// Calls work(chunk, machine) for all chunks, in parallel if there are several. If several fail, the first in string
/// order is reported.
template <class Work>
void for_each_chunk(std::vector<Chunk>& chunks, Machines& machines, Work&& work) {
    if (chunks.size() == 1) return work(chunks[0], machines.local());
    std::atomic<std::size_t> failed = chunks.size();
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t k) {
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

/// What a string holds; drawers count where they alone have identities.
struct Extent {
    std::size_t modules = 0, parameters = 0, drawers = 0;
};

/// Makes room for a string, giving memory back first if it is too small.
void resize(ModuleString& string, const Extent& extent, Ancestry ancestry);
std::size_t bytes_needed(const Extent& extent, Ancestry ancestry);

/// Bytes of the old string, without the room that its memory has besides: that may have been another plant's.
inline std::size_t bytes_before(const StepInput& input) {
    return bytes_needed({input.from.size(), input.from.parameters.size(), input.from.identities.size()},
                        input.ancestry);
}

/// Throws RunError: the step would outgrow its memory. `uses` counts the uses of each production.
[[noreturn]] void refuse_memory(const StepInput& input, std::size_t modules, std::size_t bytes,
                                const std::vector<std::uint64_t>& uses);

/// Match and measure, prefix sum, write: for productions that can be applied in any order, without decomposition.
void rewrite_in_two_passes(const StepInput& input, Scratch& scratch, Forecast& forecast, Machines& machines,
                           ModuleString& to);

/// One pass, with decomposition; in string order if the model asks for it, else by chunks that are then joined.
/// `limit` is set if decomposition stopped at its maximum depth though it could have gone on.
void rewrite_in_one_pass(const StepInput& input, Scratch& scratch, Machines& machines, Services& services,
                         ModuleString& to, std::atomic<bool>& limit);

}  // namespace espalier
