#include "rewriting.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>

namespace espalier {
namespace {

constexpr std::size_t chunk_size = 8192;

template <class T>
void resize_column(Column<T>& column, std::size_t size) {
    column.clear();
    if (column.capacity() < size) {
        Column<T>().swap(column);
        column.reserve(size + size / 8);
    }
    column.resize(size);
}

}  // namespace

void make_chunks(const StepInput& input, Scratch& scratch) {
    // Only the starts of chunks need the place of their parameters, so everything is counted, also what is cut off.
    scratch.chunks.clear();
    const auto split = [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; at += chunk_size) {
            Chunk chunk;
            chunk.begin = at;
            chunk.end = std::min(end, at + chunk_size);
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

    const std::uint16_t* const arities = input.model.source->alphabet.arities().data();
    const std::uint32_t* const lengths = input.model.plans.lengths.data();
    const std::uint32_t* const counts = input.model.plans.parameters.data();
    const LetterId* const letters = input.from.letters.data();
    tbb::parallel_for(std::size_t{0}, scratch.chunks.size(), [&](std::size_t k) {
        Chunk& chunk = scratch.chunks[k];
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
            chunk.parameters_at += arities[letters[i]];
            chunk.out_end += lengths[letters[i]];
            chunk.out_parameters_end += counts[letters[i]];
        }
    });
    std::size_t at = 0;
    for (Chunk& chunk : scratch.chunks) at += std::exchange(chunk.parameters_at, at);
    if (at != input.from.parameters.size()) {
        throw RunError(
            fmt::format("the string holds {} parameters, but its modules have {}", input.from.parameters.size(), at));
    }
    for (const std::size_t k : cut) {
        Chunk& chunk = scratch.chunks[k];
        chunk.end = chunk.begin;
        chunk.out_end = chunk.out_parameters_end = 0;
    }
}

void for_each_chunk(std::vector<Chunk>& chunks, Machines& machines, const std::function<void(Chunk&, Machine&)>& work) {
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

void resize(ModuleString& string, std::size_t modules, std::size_t parameters, bool lineage) {
    resize_column(string.letters, modules);
    resize_column(string.parameters, parameters);
    resize_column(string.identities, lineage ? modules : 0);
    resize_column(string.parents, lineage ? modules : 0);
    resize_column(string.births, lineage ? modules : 0);
}

std::size_t bytes_needed(std::size_t modules, std::size_t parameters, bool lineage) {
    const std::size_t columns = sizeof(LetterId) + (lineage ? 2 * sizeof(Identity) + sizeof(std::uint32_t) : 0);
    return modules * columns + parameters * sizeof(double);
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
