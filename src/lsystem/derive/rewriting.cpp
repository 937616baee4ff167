#include "lsystem/derive/rewriting.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier {
namespace {

template <class T>
void resize_column(Column<T>& column, std::size_t size, std::size_t spare) {
    const std::size_t room = column.capacity();
    if (column.size() == size && (size == 0 || room - size >= spare)) return;
    column.clear();
    if (size > 0 && room < size + spare) {
        Column<T>().swap(column);
        column.reserve(size + size / 8 + spare);
    }
    column.resize(size);
}

/// Whether so many modules more make one chunk with the one before them: without that, a string that shrinks would fall
/// to pieces.
bool joins(std::size_t modules, const Chunk& before) {
    const std::size_t size = before.end - before.begin;
    return std::min(modules, size) < grain / 2 && modules + size <= 2 * grain;
}

/// No production reaches across the borders of the chunk.
void count_spelled(const StepInput& input, Chunk& chunk) {
    const Plan* const plans = input.model.plans.of_letter.data();
    const LetterId* const end = input.from.letters.data() + chunk.end;
    for (const LetterId* at = input.from.letters.data() + chunk.begin; at < end;) {
        const Plan& plan = spelled_plan(plans[*at], at, end);
        chunk.parameters_at += plan.reads;
        chunk.out_end += plan.length;
        chunk.out_parameters_end += plan.parameters;
        at += plan.width;
    }
}

void count(const StepInput& input, Chunk& chunk) {
    const std::uint16_t* const arities = input.model.source->alphabet.arities().data();
    const std::uint32_t* const lengths = input.model.plans.lengths.data();
    const std::uint32_t* const counts = input.model.plans.parameters.data();
    const LetterId* const letters = input.from.letters.data();
    if (input.model.plans.draws && !input.model.plans.all_known) {
        const std::uint8_t* const drawers = input.model.drawers.data();
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) chunk.drawers_at += drawers[letters[i]];
    }
    if (!input.model.plans.all_known) {
        // Measuring will say how long they become.
        if (input.from.parameters.empty()) return;
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) chunk.parameters_at += arities[letters[i]];
        return;
    }
    if (input.model.plans.spelled) return count_spelled(input, chunk);
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        chunk.parameters_at += arities[letters[i]];
        chunk.out_end += lengths[letters[i]];
        chunk.out_parameters_end += counts[letters[i]];
    }
}

void count(const StepInput& input, std::vector<Chunk>& chunks) {
    if (chunks.size() == 1) return count(input, chunks[0]);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t k) { count(input, chunks[k]); });
}

void require_columns(const StepInput& input, std::size_t parameters, std::size_t drawers) {
    if (input.ancestry == Ancestry::drawers && drawers != input.from.identities.size()) {
        throw RunError("the string's identities do not fit it: derive from a string that start() or step() made");
    }
    if (parameters == input.from.parameters.size()) return;
    throw RunError(fmt::format("the string holds {} parameters, but its modules have {}", input.from.parameters.size(),
                               parameters));
}

/// The first place from `at` on that no production reaches across.
std::size_t border(const StepInput& input, std::size_t at, std::size_t end) {
    const LetterId* const letters = input.from.letters.data();
    while (at < end && input.model.rules.joins(letters[at - 1], letters[at])) ++at;
    return at;
}

}  // namespace

void make_chunks(const StepInput& input, Scratch& scratch) {
    const std::size_t size = input.from.size();
    if (size <= grain && input.kept.size() == 1 && input.kept[0] == std::pair(std::size_t{0}, size)) {
        scratch.chunks.resize(1);
        Chunk& chunk = scratch.chunks[0] = {};
        chunk.end = size;
        count(input, chunk);
        chunk.parameters_end = std::exchange(chunk.parameters_at, 0);
        chunk.drawers_end = std::exchange(chunk.drawers_at, 0);
        return require_columns(input, chunk.parameters_end, chunk.drawers_end);
    }
    // Only the starts of chunks need the place of their parameters, so everything is counted, also what is cut off.
    scratch.chunks.clear();
    const auto split = [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; at = scratch.chunks.back().end) {
            Chunk chunk;
            chunk.begin = at;
            chunk.end = border(input, std::min(end, at + grain), end);
            scratch.chunks.push_back(chunk);
        }
    };
    std::size_t cut_from = 0;
    std::vector<std::size_t> cut;  // chunks that are not kept
    const auto split_cut = [&](std::size_t begin, std::size_t end) {
        const std::size_t first = scratch.chunks.size();
        split(begin, end);
        for (std::size_t k = first; k < scratch.chunks.size(); ++k) cut.push_back(k);
    };
    for (const auto& [begin, end] : input.kept) {
        split_cut(cut_from, begin);
        split(begin, end);
        cut_from = end;
    }
    split_cut(cut_from, input.from.size());

    count(input, scratch.chunks);
    std::size_t at = 0, drawers = 0;
    for (Chunk& chunk : scratch.chunks) {
        at += std::exchange(chunk.parameters_at, at);
        chunk.parameters_end = at;
        drawers += std::exchange(chunk.drawers_at, drawers);
        chunk.drawers_end = drawers;
    }
    require_columns(input, at, drawers);
    for (const std::size_t k : cut) {
        Chunk& chunk = scratch.chunks[k];
        chunk.end = chunk.begin;
        chunk.parameters_end = chunk.parameters_at;
        chunk.drawers_end = chunk.drawers_at;
        chunk.out_end = chunk.out_parameters_end = 0;
    }
}

namespace {

/// Finds the chunks' parts of what was foreseen to change; false if the string's identities do not fit it.
bool recall_changes(const StepInput& input, Forecast& forecast, std::vector<Chunk>& chunks) {
    const auto before = [](const Change& change, std::size_t module) { return change.module < module; };
    Change* at = forecast.changes.data();
    Change* const end = at + forecast.changes.size() - 1;
    for (Chunk& chunk : chunks) {
        // All who come to draw are changes.
        chunk.changes = at;
        chunk.drawers_at = at->drawers();
        at = std::lower_bound(at, end, chunk.end, before);
        chunk.change_count = static_cast<std::size_t>(at - chunk.changes);
        chunk.drawers_end = at->drawers();
    }
    return input.ancestry != Ancestry::drawers || input.from.identities.size() == end->drawers();
}

}  // namespace

bool recall_chunks(const StepInput& input, Forecast& forecast, Scratch& scratch) {
    const bool whole = input.kept.size() == 1 && input.kept[0] == std::pair(std::size_t{0}, forecast.modules);
    if (forecast.misses >= Forecast::most_misses || !whole || input.from.letters.data() != forecast.letters ||
        input.from.parameters.size() != forecast.parameters) {
        return false;
    }
    scratch.chunks.clear();
    std::size_t modules = 0, parameters = 0;
    for (const Stretch& stretch : forecast.stretches) {
        if (scratch.chunks.empty() || !joins(stretch.modules, scratch.chunks.back())) {
            scratch.chunks.emplace_back();
            scratch.chunks.back().begin = modules;
            scratch.chunks.back().parameters_at = parameters;
            scratch.chunks.back().stretches = {&stretch, 0};
        }
        Chunk& chunk = scratch.chunks.back();
        chunk.end = modules += stretch.modules;
        chunk.parameters_end = parameters += stretch.parameters;
        chunk.out_end += static_cast<std::uint32_t>(stretch.next);
        chunk.out_parameters_end += stretch.next >> 32;
        chunk.stretches = {chunk.stretches.data(), chunk.stretches.size() + 1};
    }
    return input.model.plans.looks_ahead || recall_changes(input, forecast, scratch.chunks);
}

void remember_chunks(const StepInput& input, const ModuleString& to, Scratch& scratch, Forecast& forecast) {
    if (!input.model.plans.looks_ahead && !scratch.foresees) {
        forecast.letters = nullptr;
        return Column<Change>().swap(forecast.changes);
    }
    forecast.letters = to.letters.data();
    forecast.modules = to.size();
    forecast.parameters = to.parameters.size();
    forecast.stretches.clear();
    for (std::size_t k = 0; k < scratch.chunks.size(); ++k) {
        const std::vector<Stretch>& written = scratch.stretches[k];
        forecast.stretches.insert(forecast.stretches.end(), written.begin(), written.end());
    }
    if (scratch.foresees) std::swap(forecast.changes, scratch.foreseen);
}

namespace {

std::size_t identities(const Extent& extent, Ancestry ancestry) {
    if (ancestry == Ancestry::none) return 0;
    return ancestry == Ancestry::drawers ? extent.drawers : extent.modules;
}

}  // namespace

void resize(ModuleString& string, const Extent& extent, Ancestry ancestry) {
    const bool whole = ancestry == Ancestry::whole;
    resize_column(string.letters, extent.modules, spare_letters);
    resize_column(string.parameters, extent.parameters, spare_values);
    resize_column(string.identities, identities(extent, ancestry), spare_lineage);
    resize_column(string.parents, whole ? extent.modules : 0, spare_lineage);
    resize_column(string.births, whole ? extent.modules : 0, spare_lineage);
}

std::size_t bytes_needed(const Extent& extent, Ancestry ancestry) {
    std::size_t columns = sizeof(LetterId);
    if (ancestry == Ancestry::whole) columns += sizeof(Identity) + sizeof(std::uint32_t);
    return extent.modules * columns + identities(extent, ancestry) * sizeof(Identity) +
           extent.parameters * sizeof(double);
}

void refuse_memory(const StepInput& input, std::size_t modules, std::size_t bytes,
                   const std::vector<std::uint64_t>& uses) {
    const CompiledProduction* fastest = nullptr;
    std::uint64_t most = 0;
    for (std::size_t p = 0; p < uses.size(); ++p) {
        const CompiledProduction& production = input.model.rules.productions[p];
        if (production.length <= production.strict.size()) continue;
        const std::uint64_t added = uses[p] * (production.length - production.strict.size());
        if (added <= most) continue;
        most = added;
        fastest = &production;
    }
    std::string message =
        fmt::format("step {}: the string would grow to {} modules and {} MiB, more than its memory of {} MiB",
                    input.step, modules, bytes >> 20, input.memory >> 20);
    if (fastest) {
        const Place& place = fastest->source->place;
        message += fmt::format("; the production{}{} for {} adds the most, {} modules", place.known() ? " at " : "",
                               to_string(place), input.model.source->alphabet.name(fastest->strict[0].letter), most);
    }
    throw RunError(message);
}

}  // namespace espalier
