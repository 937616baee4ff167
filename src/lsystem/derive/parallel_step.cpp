// Match and choose, prefix sum, write: every chunk of the old string knows where its part of the new one begins.
#include "lsystem/derive/choose.h"
#include "lsystem/derive/write.h"

namespace espalier::lsystem {
namespace {

/// Resizes a column whose elements are no longer needed, so that they are not copied to larger memory. A string that
/// grows takes new memory every few steps only: what is reserved and not touched costs nothing.
template <class T>
void renew(Column<T>& column, std::size_t size) {
    constexpr std::size_t room = 4;
    column.clear();
    if (size > column.capacity()) {
        Column<T>().swap(column);
        column.reserve(room * size);
    }
    column.resize(size);
}

/// What a chunk's modules are replaced by; where letters alone decide, in the thread's memory.
std::span<const Replacement> replacements_of(const StepInput& input, const Chunk& chunk) {
    if (!input.system.plans.all_known) return chunk.replacements;
    static thread_local Column<Replacement> known;
    const std::size_t count = list_known_replacements(input, chunk, known);
    return {known.data(), count};
}

std::vector<std::uint64_t> count_uses(const StepInput& input, const std::vector<Chunk>& chunks) {
    const std::vector<CompiledProduction>& productions = input.system.rules.productions;
    std::vector<std::uint64_t> uses(productions.size());
    for (const Chunk& chunk : chunks) {
        std::size_t replaced = chunk.begin;  // modules before this one
        for (const Replacement& replacement : replacements_of(input, chunk)) {
            if (replacement.module < replaced) continue;
            const Plan& plan = input.system.plans.choices[replacement.plan];
            if (plan.production) ++uses[static_cast<std::size_t>(plan.production - productions.data())];
            replaced = replacement.module + plan.width;
        }
    }
    return uses;
}

/// Turns what the chunks become into places, and makes room for the new string.
void place(const StepInput& input, std::vector<Chunk>& chunks, ModuleString& to) {
    Extent all;
    for (Chunk& chunk : chunks) {
        chunk.at = all;
        all += chunk.becomes;
    }
    make_room(input, all, bytes_before(input), to, [&] { return count_uses(input, chunks); });
}

void write_chunk(const StepInput& input, const Chunk& chunk, Machine& machine, ModuleString& to) {
    const Plans& plans = input.system.plans;
    const bool bare = plans.all_known && !plans.valued();
    if (bare) write_letters(input, chunk, to);
    if (bare && !input.lineage) return;
    const std::span<const Replacement> replacements = replacements_of(input, chunk);
    if (!bare) write(input, chunk, replacements, machine, to);
    if (input.lineage) write_births(input, chunk, replacements, to);
}

}  // namespace

void rewrite_in_parallel(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to) {
    make_chunks(input, scratch);
    if (!input.system.plans.all_known) {
        renew(scratch.outcomes, input.system.choosing.places() > 1 ? input.from.size() : 0);
        if (!scratch.chunks.empty())
            renew(scratch.replacements, scratch.chunks.back().room + scratch.chunks.back().candidates + 1);
        for_each_chunk(scratch.chunks, machines,
                       [&](Chunk& chunk, Machine& machine) { choose_replacements(input, scratch, chunk, machine); });
    }
    place(input, scratch.chunks, to);
    for_each_chunk(scratch.chunks, machines,
                   [&](const Chunk& chunk, Machine& machine) { write_chunk(input, chunk, machine, to); });
    if (input.lineage) drop_unused_siblings(to);
}

}  // namespace espalier::lsystem
