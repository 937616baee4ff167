// Measure, prefix sum, write. Every chunk of the old string knows where its part of the new one begins. Where a letter
// alone decides what replaces a module, the step that wrote the string has measured it already.
#include "lsystem/compile/foreseeing.h"
#include "lsystem/derive/measuring.h"
#include "lsystem/derive/writing.h"

#include <atomic>

namespace espalier {
namespace {

/// A string of so few modules is measured in no time, and what is certain is written faster than what is foreseen.
constexpr std::size_t small = 256;

std::vector<std::uint64_t> count_uses(const StepInput& input, const Scratch& scratch) {
    const Plans& plans = input.model.plans;
    const std::vector<CompiledProduction>& productions = input.model.rules.productions;
    std::vector<std::uint64_t> uses(productions.size());
    const auto use = [&](const Plan& plan) {
        if (plan.production) ++uses[static_cast<std::size_t>(plan.production - productions.data())];
    };
    for (const Chunk& chunk : scratch.chunks) {
        if (plans.all_known) {
            const LetterId* const end = input.from.letters.data() + input.from.size();
            for (std::size_t i = chunk.begin; i < chunk.end;) {
                const LetterId* const at = input.from.letters.data() + i;
                const Plan& plan = spelled_plan(plans.of_letter[*at], at, end);
                use(plan);
                i += plan.width;
            }
            continue;
        }
        if (keeps_places(input)) {
            for (std::size_t i = chunk.begin; i < chunk.end; ++i) use(*input.model.choosing.plans[scratch.told[i]]);
            continue;
        }
        std::size_t replaced = chunk.begin;  // modules before this one
        for (const Change& change : std::span(chunk.changes, chunk.change_count)) {
            if (change.module < replaced) continue;
            use(plans.choices[change.plan]);
            replaced = change.module + plans.choices[change.plan].width;
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
    Extent extent;
    std::size_t changes = 0;
    for (Chunk& chunk : scratch.chunks) {
        chunk.out = extent.modules;
        chunk.out_parameters = extent.parameters;
        chunk.out_drawers = extent.drawers;
        chunk.out_end = extent.modules += chunk.out_end;
        chunk.out_parameters_end = extent.parameters += chunk.out_parameters_end;
        chunk.out_drawers_end = extent.drawers += chunk.out_drawers_end;
        chunk.out_changes = changes;
        chunk.out_changes_end = changes += chunk.out_changes_end;
    }
    const std::size_t bytes = bytes_before(input) + bytes_needed(extent, input.ancestry);
    if (bytes > input.memory || extent.modules >= BranchLinks::none) {
        if (measure == Measure::foreseen) return false;
        refuse_memory(input, extent.modules, bytes, count_uses(input, scratch));
    }
    resize(to, extent, input.ancestry);
    // What is foreseen of a string may be larger than the string: there must be memory for it, too.
    scratch.foresees = input.model.plans.foresees && !keeps_places(input) && extent.modules > small &&
                       (changes + 1) * sizeof(Change) <= input.memory - bytes;
    if (scratch.foresees) {
        scratch.foreseen.clear();
        scratch.foreseen.resize(changes + 1);
        scratch.foreseen.back() = {std::uint64_t{extent.parameters} << 32 | extent.drawers,
                                   static_cast<std::uint32_t>(extent.modules), 0};
    } else {
        Column<Change>().swap(scratch.foreseen);
    }
    if (measure == Measure::taken && !scratch.chunks.empty()) {
        // A column without elements has no room behind them either.
        const bool roomy = extent.modules > 0 && (extent.parameters > 0 || !input.model.plans.valued()) &&
                           (extent.drawers > 0 || input.ancestry != Ancestry::drawers);
        scratch.chunks.back().in_blocks = roomy && has_spare(input, input.from);
    }
    return true;
}

/// Measures what was foreseen to change; false if the string is not the one that was written.
bool measure_foreseen(const StepInput& input, Scratch& scratch, Machines& machines) {
    std::atomic<bool> fits = true;
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine&) {
        if (!is_as_written(input, chunk)) fits = false;
    });
    if (!fits) return false;
    for_each_chunk(scratch.chunks, machines,
                   [&](Chunk& chunk, Machine& machine) { measure_changes(input, chunk, machine); });
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
            write_lineage(input, chunk, to);
        if (scratch.foresees) foresee(input, scratch, chunk, to);
    });
    return fits;
}

bool write_foreseen(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to) {
    try {
        if (!input.model.plans.looks_ahead) {
            return measure_foreseen(input, scratch, machines) && place(input, scratch, Measure::taken, to) &&
                   write_all(input, scratch, machines, to);
        }
        return place(input, scratch, Measure::foreseen, to) && write_all(input, scratch, machines, to);
    } catch (const RunError&) {
        return false;  // who measures first meets it too, if it is one
    }
}

}  // namespace

void rewrite_in_two_passes(const StepInput& input, Scratch& scratch, Forecast& forecast, Machines& machines,
                           ModuleString& to) {
    if (input.from.size() > small && recall_chunks(input, forecast, scratch)) {
        forecast.letters = nullptr;  // it serves once: choices are written over what was foreseen
        if (write_foreseen(input, scratch, machines, to)) return remember_chunks(input, to, scratch, forecast);
        ++forecast.misses;
    }
    make_chunks(input, scratch);
    if (!input.model.plans.all_known) {
        scratch.told.resize(input.from.size());
        scratch.changes.resize(input.from.size() + scratch.chunks.size());
        for_each_chunk(scratch.chunks, machines,
                       [&](Chunk& chunk, Machine& machine) { measure(input, scratch, chunk, machine); });
    }
    place(input, scratch, Measure::taken, to);
    write_all(input, scratch, machines, to);
    remember_chunks(input, to, scratch, forecast);
}

}  // namespace espalier
