#include "lsystem/derive/step.h"

#include "base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace espalier::lsystem {
namespace {

constexpr std::size_t most_kept = std::size_t{1} << 22;  // bytes of pieces that a thread keeps for the next plant

struct ThreadScratch {
    Scratch scratch;
    bool lent = false;
};

ThreadScratch& of_this_thread() {
    static thread_local ThreadScratch scratch;
    return scratch;
}

template <class T>
void resize_column(Column<T>& column, std::size_t size, std::size_t spare) {
    const std::size_t room = column.capacity();
    if (column.size() == size && (size == 0 || room - size >= spare)) return;
    column.clear();
    if (size > 0 && room < size + spare) {
        Column<T>().swap(column);
        column.reserve(size + size / 16 + spare);
    }
    column.resize(size);
}

/// Adds up what letters alone say of a chunk.
void count_known(const StepInput& input, Chunk& chunk) {
    const PackedSizes& sizes = input.system.plans.sizes;
    const LetterId* const letters = input.from.letters.data();
    for (std::size_t i = chunk.begin; i < chunk.end; i += sizes.at_once) {
        const PackedSizes::Sum sum = sizes.add_up(letters + i, std::min(sizes.at_once, chunk.end - i));
        chunk.becomes += sum.becomes;
        chunk.parameters_end += sum.reads;
    }
}

/// The same for plans that are too large to be added up together.
void count_one_by_one(const StepInput& input, Chunk& chunk) {
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        const Plan& plan = input.system.plans.of_letter(input.from.letters[i]);
        chunk.becomes += {plan.length, plan.parameters, plan.bears};
        chunk.parameters_end += plan.reads;
    }
}

/// Adds up parameters, and modules that productions may replace: both in one number.
void count_candidates(const StepInput& input, Chunk& chunk) {
    const Lookup* const lookups = input.system.plans.lookups.data();
    const LetterId* const letters = input.from.letters.data();
    for (std::size_t begin = chunk.begin; begin < chunk.end; begin += grain) {
        std::uint64_t sum = 0;
        for (std::size_t i = begin, end = std::min(begin + grain, chunk.end); i < end; ++i) {
            sum += std::bit_cast<std::uint64_t>(lookups[letters[i]]);
        }
        const auto both = std::bit_cast<Lookup>(sum);
        chunk.parameters_end += both.arity;
        chunk.candidates += both.replaced;
    }
}

void count(const StepInput& input, Chunk& chunk) {
    const Plans& plans = input.system.plans;
    if (!plans.all_known) return count_candidates(input, chunk);
    plans.sizes.at_once > 0 ? count_known(input, chunk) : count_one_by_one(input, chunk);
}

void require_parameters(const StepInput& input, std::size_t parameters) {
    if (parameters == input.from.parameters.size()) return;
    throw RunError(fmt::format("the string holds {} parameters, but its modules have {}", input.from.parameters.size(),
                               parameters));
}

/// The first place from `at` on that no production reaches across.
std::size_t border(const StepInput& input, std::size_t at, std::size_t end) {
    const LetterId* const letters = input.from.letters.data();
    while (at < end && input.system.joins(letters[at - 1], letters[at])) ++at;
    return at;
}

void split(const StepInput& input, std::size_t begin, std::size_t end, std::vector<Chunk>& chunks) {
    for (std::size_t at = begin; at < end; at = chunks.back().end) {
        chunks.emplace_back();
        chunks.back().begin = at;
        chunks.back().end = border(input, std::min(end, at + grain), end);
    }
}

}  // namespace

void make_chunks(const StepInput& input, Scratch& scratch) {
    std::vector<Chunk>& chunks = scratch.chunks;
    chunks.clear();
    std::vector<std::size_t> cut;  // chunks that are not kept; counted, too, so that others know where they begin
    std::size_t at = 0;
    const auto split_cut = [&](std::size_t end) {
        const std::size_t first = chunks.size();
        split(input, at, end, chunks);
        for (std::size_t k = first; k < chunks.size(); ++k) cut.push_back(k);
    };
    for (const auto& [begin, end] : input.kept) {
        split_cut(begin);
        split(input, begin, end, chunks);
        at = end;
    }
    split_cut(input.from.size());

    if (chunks.size() == 1)
        count(input, chunks[0]);
    else
        for_in_parallel(std::size_t{0}, chunks.size(), [&](std::size_t k) { count(input, chunks[k]); });
    std::size_t parameters = 0, room = 0;
    for (Chunk& chunk : chunks) {
        chunk.room = room;
        room += chunk.candidates + 1;  // one more is written than counts
        chunk.parameters_begin = parameters;
        chunk.parameters_end = parameters += chunk.parameters_end;
    }
    require_parameters(input, parameters);
    for (const std::size_t k : cut) {
        chunks[k].end = chunks[k].begin;
        chunks[k].parameters_end = chunks[k].parameters_begin;
        chunks[k].becomes = {};
    }
    if (!chunks.empty()) chunks.back().is_last = true;
}

std::size_t bytes_needed(const Extent& extent, bool lineage) {
    const std::size_t bytes = extent.modules * sizeof(LetterId) + extent.parameters * sizeof(double);
    return lineage ? bytes + extent.modules * sizeof(Birth) + extent.siblings * sizeof(Siblings) : bytes;
}

void resize(ModuleString& string, const Extent& extent, bool lineage) {
    resize_column(string.letters, extent.modules, spare_letters);
    resize_column(string.parameters, extent.parameters, spare_values);
    resize_column(string.births, lineage ? extent.modules : 0, spare_births);
    string.siblings.clear();
}

void make_room(const StepInput& input, const Extent& added, std::size_t held, ModuleString& to,
               const std::function<std::vector<std::uint64_t>()>& uses) {
    const std::size_t siblings = input.from.siblings.size() + added.siblings;
    const std::size_t bytes = held + bytes_needed({added.modules, added.parameters, siblings}, input.lineage);
    const bool is_countable = added.modules < BranchLinks::none && siblings < BranchLinks::none;
    if (bytes > input.memory || !is_countable) refuse_memory(input, added.modules, bytes, uses());
    resize(to, added, input.lineage);
    if (input.lineage) to.siblings = input.from.siblings.grown(added.siblings);
}

void refuse_memory(const StepInput& input, std::size_t modules, std::size_t bytes,
                   const std::vector<std::uint64_t>& uses) {
    const CompiledProduction* fastest = nullptr;
    std::uint64_t most = 0;
    for (std::size_t p = 0; p < uses.size(); ++p) {
        const CompiledProduction& production = input.system.rules.productions[p];
        if (production.length <= production.strict.size()) continue;
        const std::uint64_t added = uses[p] * (production.length - production.strict.size());
        if (added <= most) continue;
        most = added;
        fastest = &production;
    }
    std::string message = fmt::format(
        "step {}: the string would grow to {} modules and {} MiB, more than the {} MiB of memory left to it",
        input.step, modules, bytes >> 20, input.memory >> 20);
    if (fastest) {
        const Place& place = fastest->source->place;
        message += fmt::format("; the production{}{} for {} adds the most, {} modules", place.known() ? " at " : "",
                               to_string(place), input.system.source->alphabet.name(fastest->strict[0].letter), most);
    }
    throw RunError(message);
}

void drop_unused_siblings(ModuleString& string) {
    constexpr std::size_t few = 8;
    if (string.siblings.size() <= string.size() + string.size() / 2 + few) return;
    const SiblingTable old = string.siblings;
    Column<std::uint32_t> rows(old.size());  // where each goes
    std::fill(rows.begin(), rows.end(), 0u);
    for (const Birth& birth : string.births) rows[birth.siblings] = 1;
    std::uint32_t kept = 0;
    for (std::uint32_t& row : rows) kept += std::exchange(row, row ? kept : BranchLinks::none) != 0;
    string.siblings = SiblingTable().grown(kept);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k] != BranchLinks::none) string.siblings.added(rows[k]) = old[k];
    }
    for (Birth& birth : string.births) birth.siblings = rows[birth.siblings];
}

Machine& Machines::local() const {
    // Among many small plants the next mostly has the same L-system. A machine ends with its system, so that another
    // system in the same place is not mistaken for it.
    struct Last {
        const CompiledSystem* system = nullptr;
        std::weak_ptr<Machine> owned;
        Machine* machine = nullptr;
    };
    static thread_local Last last;
    if (last.system != &system_ || last.owned.expired()) {
        std::shared_ptr<Machine>& machine = system_.machines.local();
        if (!machine) machine = std::make_shared<Machine>(system_.machine());
        last = {&system_, machine, machine.get()};
    }
    last.machine->attach(&variables_, &services_, Stream::derivation);
    return *last.machine;
}

ScratchLease::ScratchLease(std::size_t modules, std::unique_ptr<Scratch>& own) {
    ThreadScratch& thread = of_this_thread();
    of_thread_ = modules <= grain && !thread.lent;
    if (!of_thread_ && !own) own = std::make_unique<Scratch>();
    scratch_ = of_thread_ ? &thread.scratch : own.get();
    thread.lent = thread.lent || of_thread_;
}

ScratchLease::~ScratchLease() {
    if (!of_thread_) return;
    of_this_thread().lent = false;
    const auto large = [](const ModuleString& piece) { return piece.bytes() > most_kept; };
    if (std::any_of(scratch_->pieces.begin(), scratch_->pieces.end(), large)) scratch_->pieces.clear();
}

}  // namespace espalier::lsystem
