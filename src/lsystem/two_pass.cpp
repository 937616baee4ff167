// Measure, prefix sum, write. Every chunk of the old string knows where its part of the new one begins. Where a letter
// alone decides what replaces a module, the step that wrote the string has measured it already.
#include "measuring.h"
#include "writing.h"

#include <atomic>

namespace espalier {
namespace {

std::vector<std::uint64_t> count_uses(const StepInput& input, const Scratch& scratch) {
    const std::vector<CompiledProduction>& productions = input.model.rules.productions;
    std::vector<std::uint64_t> uses(productions.size());
    for (const Chunk& chunk : scratch.chunks) {
        for (std::size_t i = chunk.begin; i < chunk.end;) {
            const Plan& used = plan_of(input, scratch, i);
            if (used.production) ++uses[static_cast<std::size_t>(used.production - productions.data())];
            i += used.width;
        }
    }
    return uses;
}

bool has_spare(const StepInput& input, const ModuleString& string) {
    const auto has = [](const auto& column, std::size_t spare) { return column.capacity() - column.size() >= spare; };
    const bool whole = input.ancestry == Ancestry::whole;
    return has(string.letters, spare_letters) &&
           (!input.model.plans.valued() || has(string.parameters, spare_values)) &&
           (input.ancestry == Ancestry::none || has(string.identities, spare_lineage)) &&
           (!whole || (has(string.parents, spare_lineage) && has(string.births, spare_lineage)));
}

enum class Measure { foreseen, taken };

/// Turns the chunks' lengths into places and makes room for the new string; false if a measure that is only foreseen
/// asks for too much.
bool place(const StepInput& input, Scratch& scratch, Measure measure, ModuleString& to) {
    std::size_t modules = 0, parameters = 0;
    for (Chunk& chunk : scratch.chunks) {
        chunk.out = modules;
        chunk.out_parameters = parameters;
        modules += chunk.out_end;
        parameters += chunk.out_parameters_end;
        chunk.out_end = modules;
        chunk.out_parameters_end = parameters;
    }
    const std::size_t bytes = bytes_before(input) + bytes_needed(modules, parameters, input.ancestry);
    if (bytes > input.memory || modules >= BranchLinks::none) {
        if (measure == Measure::foreseen) return false;
        refuse_memory(input, modules, bytes, count_uses(input, scratch));
    }
    resize(to, modules, parameters, input.ancestry);
    if (measure == Measure::taken && !scratch.chunks.empty()) {
        // A column without elements has no room behind them either.
        const bool roomy = modules > 0 && (parameters > 0 || !input.model.plans.valued());
        scratch.chunks.back().in_blocks = roomy && has_spare(input, input.from);
    }
    return true;
}

/// False if the chunks' measures do not fit the string.
bool write_all(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to) {
    if (scratch.stretches.size() < scratch.chunks.size()) scratch.stretches.resize(scratch.chunks.size());
    std::atomic<bool> fits = true;
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine& machine) {
        if (!write(input, scratch, chunk, machine, to))
            fits = false;
        else if (input.ancestry != Ancestry::none)
            write_lineage(input, scratch, chunk, to);
    });
    return fits;
}

bool write_foreseen(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to) {
    try {
        return place(input, scratch, Measure::foreseen, to) && write_all(input, scratch, machines, to);
    } catch (const RunError&) {
        return false;  // who measures first meets it too, if it is one
    }
}

}  // namespace

void rewrite_in_two_passes(const StepInput& input, Scratch& scratch, Forecast& forecast, Machines& machines,
                           ModuleString& to) {
    // A small string is measured in no time, and what is certain is written faster than what is foreseen.
    constexpr std::size_t small = 256;
    if (input.from.size() > small && recall_chunks(input, forecast, scratch)) {
        if (write_foreseen(input, scratch, machines, to)) return remember_chunks(input, to, scratch, forecast);
        ++forecast.misses;
    }
    make_chunks(input, scratch);
    if (!input.model.plans.all_known) {
        scratch.choices.resize(input.from.size());
        scratch.changes.resize(input.from.size() + scratch.chunks.size());
        for_each_chunk(scratch.chunks, machines,
                       [&](Chunk& chunk, Machine& machine) { measure(input, scratch, chunk, machine); });
    }
    place(input, scratch, Measure::taken, to);
    write_all(input, scratch, machines, to);
    remember_chunks(input, to, scratch, forecast);
}

}  // namespace espalier
