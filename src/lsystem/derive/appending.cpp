#include "lsystem/derive/appending.h"

#include "base/parallel.h"

#include <algorithm>
#include <cstring>

namespace espalier::lsystem {

// Only the used memory of the string counts: how much there is depends on who had it before.
GrowingPart::GrowingPart(ModuleString& string, const StepInput& input, std::atomic<std::size_t>& bytes, Runs runs)
    : siblings(input.from.siblings.size()),
      string_(string),
      input_(input),
      bytes_(bytes),
      joins_runs_(runs == Runs::joined) {
    string_.clear();
}

void GrowingPart::grow(std::size_t more_modules, std::size_t more_parameters) {
    const std::size_t modules = string_.letters.size() + more_modules;
    const std::size_t parameters = string_.parameters.size() + more_parameters;
    if (modules > modules_) modules_ = std::max<std::size_t>(1024, (modules - 1) * 2);
    if (parameters > parameters_) parameters_ = std::max<std::size_t>(1024, parameters * 2);
    const std::size_t needed = bytes_needed({modules_, parameters_, siblings.rows().size()}, input_.lineage);
    const std::size_t total = bytes_ += needed > held_ ? needed - held_ : 0;
    held_ = std::max(held_, needed);
    if (total > input_.memory || modules_ >= BranchLinks::none) refuse_memory(input_, modules_, total, uses);
    string_.letters.reserve(modules_);
    string_.parameters.reserve(parameters_);
    if (input_.lineage) string_.births.reserve(modules_);
}

void GrowingPart::append_run(std::size_t begin, std::size_t end, const double* values, std::size_t parameters) {
    constexpr std::size_t few = 8;  // not worth a note
    if (joins_runs_ && end - begin > few) {
        runs_.push_back({begin, end, values, parameters, string_.letters.size(), string_.parameters.size()});
        return;
    }
    const bool has_room =
        end - begin <= modules_ - string_.letters.size() && parameters <= parameters_ - string_.parameters.size();
    if (!has_room) grow(end - begin, parameters);
    const auto append = [&](auto& column, const auto& old) {
        column.insert(column.end(), old.data() + begin, old.data() + end);
    };
    append(string_.letters, input_.from.letters);
    string_.parameters.insert(string_.parameters.end(), values, values + parameters);
    if (input_.lineage) append(string_.births, input_.from.births);
}

Extent GrowingPart::extent() const {
    Extent all{string_.letters.size(), string_.parameters.size(), siblings.rows().size()};
    for (const Run& run : runs_) all += {run.end - run.begin, run.parameters, 0};
    return all;
}

Appending::Appending(const StepInput& input, Machine& machine, Services& services, GrowingPart& out)
    : input_(input),
      system_(input.system),
      machine_(machine),
      services_(services),
      out_(out),
      matcher_(input.system, input.view, machine),
      rewriting_(system_.rules, matcher_, machine, input.lineage ? &out.siblings : nullptr),
      decomposition_(system_.decomposition, matcher_, machine, input.lineage ? &out.siblings : nullptr) {
    matcher_.set_random(input.key, input.step);
    if (system_.index == 0) out_.uses.resize(system_.rules.productions.size());
}

namespace {

/// Whether what a successor writes stands within a sub-L-system that the same successor opened.
class Inside {
public:
    bool any() const { return open_ > 0; }
    void pass(LetterId letter, const Enclosure& enclosure) {
        if (letter == Alphabet::open_bracket) {
            ++level_;
        } else if (letter == Alphabet::close_bracket) {
            if (level_-- == opened_at_) open_ = 0;
        } else if (enclosure.opens(letter)) {
            if (open_++ == 0) opened_at_ = level_;
        } else if (letter == enclosure.close && open_ > 0) {
            --open_;
        }
    }

private:
    int level_ = 0, opened_at_ = 0, open_ = 0;
};

}  // namespace

std::size_t Appending::run(std::size_t begin, std::size_t end, std::size_t parameters_at) {
    const auto arities = system_.source->alphabet.arities();
    const LetterId* letters = input_.from.letters.data();
    const double* values = input_.from.parameters.data() + parameters_at;
    std::size_t i = begin;
    while (i < end) {
        if (lives_on(letters[i])) {
            const std::size_t first = i;
            const double* const first_values = values;
            for (; i < end && lives_on(letters[i]); ++i) values += arities[letters[i]];
            out_.append_run(first, i, first_values, static_cast<std::size_t>(values - first_values));
            continue;
        }
        const auto at = static_cast<std::size_t>(values - input_.from.parameters.data());
        const Site site{i, at, letters[i], values, lineage(i).identity, 0};
        std::size_t consumed = 0;
        try {
            decomposing_ = false;
            consumed = rewrite(site);
        } catch (const EvaluationError& error) {
            const LetterId letter = decomposing_ ? decomposition_.letter() : letters[i];
            throw RunError(describe(error, system_.source->alphabet, letter,
                                    decomposing_ ? decomposition_.values() : values, input_.step));
        }
        for (const std::size_t next = i + consumed; i < next; ++i) values += arities[letters[i]];
    }
    return i;
}

/// Replaces the modules at a site; returns how many they were. Where no production applies, the decomposition takes
/// modules from the old string, even those behind that productions would replace.
std::size_t Appending::rewrite(const Site& site) {
    check_stop_();
    const CompiledProduction* production = matcher_.choose(system_.rules, site);
    const std::uint32_t depth = production ? 0 : 1;
    if (!production) production = decomposition_of(site);
    if (!production) {
        const int arity = system_.source->alphabet.arity(site.letter);
        out_.append(site.letter, site.values, static_cast<std::size_t>(arity), lineage(site.first).birth);
        return 1;
    }
    Site origin = site;
    origin.width = production->strict.size();
    strict_.clear();
    for (std::size_t k = 0; k < origin.width; ++k) strict_.push_back(lineage(site.first + k));
    if (depth == 0) matcher_.begin_successor(*production, site);
    if (depth == 0 && system_.index == 0)
        ++out_.uses[static_cast<std::size_t>(production - system_.rules.productions.data())];
    if (depth == 0 && !production->decomposes && !enclosure_) {
        rewriting_.emit_successor(*production, site.values, strict_.data(), input_.step,
                                  [&](LetterId letter, const double* values, std::size_t arity,
                                      const Lineage& lineage) { out_.append(letter, values, arity, lineage.birth); });
        follow_reseeding();
        return origin.width;
    }
    rewriting_.push_successor(*production, site.values, strict_.data(), input_.step, depth, stack_);
    if (depth == 0) follow_reseeding();
    decompose(origin);
    return origin.width;
}

/// What decomposes the modules at a site, its successor begun; null if nothing does.
const CompiledProduction* Appending::decomposition_of(Site site) {
    const CompiledRules& rules = system_.decomposition;
    if (!rules.has(site.letter) || rules.maximum_depth == 0) return nullptr;
    site.identity = mix(site.identity, 1);
    const CompiledProduction* const production = matcher_.choose(rules, site);
    if (production) matcher_.begin_successor(*production, site);
    return production;
}

void Appending::run_within(std::size_t begin, std::size_t end, std::size_t parameters_at, const Enclosure& enclosure) {
    enclosure_ = &enclosure;
    matcher_.limit(end);
    follow_seed();
    run(begin, end, parameters_at);
}

void Appending::decompose(const Site& site) {
    decomposing_ = true;
    if (!enclosure_) {
        decomposition_.run(stack_, site, input_.step, [&](const ModuleStack::Entry& entry, const double* values) {
            out_.append(entry.letter, values, entry.arity, entry.lineage.birth);
        });
    } else {
        decompose_within(site);
    }
    follow_reseeding();
}

void Appending::decompose_within(const Site& site) {
    Inside inside;
    while (!stack_.empty()) {
        if (inside.any()) {
            const ModuleStack::Entry entry = stack_.pop(values_);
            out_.append(entry.letter, values_.data(), entry.arity, entry.lineage.birth);
            inside.pass(entry.letter, *enclosure_);
            continue;
        }
        const ModuleStack::Entry* finished = decomposition_.replace(stack_, site, input_.step);
        if (!finished) continue;
        out_.append(finished->letter, decomposition_.values(), finished->arity, finished->lineage.birth);
        inside.pass(finished->letter, *enclosure_);
    }
}

// srand() in a production begins the stream anew for all modules that follow, too.
void Appending::follow_reseeding() {
    if (machine_.reseeded()) follow_seed();
}

void Appending::follow_seed() {
    matcher_.set_random(RandomKey(services_.seed, services_.plant, Stream::derivation, services_.salt), input_.step);
}

namespace {

template <class T>
void copy(const T* from, std::size_t count, T* to) {
    if (count > 0) std::memcpy(to, from, count * sizeof(T));
}

void copy_rows(const StepInput& input, const GrowingPart& part, std::size_t at, ModuleString& to) {
    const Column<Siblings>& rows = part.siblings.rows();
    for (std::size_t k = 0; k < rows.size(); ++k) to.siblings.added(input.from.siblings.size() + at + k) = rows[k];
}

/// Copies what a part wrote, and the runs of the old string between, from where the part begins in the new string.
class PartCopy {
public:
    PartCopy(const StepInput& input, const ModuleString& piece, const Extent& at, ModuleString& to)
        : from_(input.from), lineage_(input.lineage), piece_(piece), at_(at), siblings_before_(at.siblings), to_(to) {}

    void copy_all(const std::vector<GrowingPart::Run>& runs) {
        for (const GrowingPart::Run& run : runs) {
            copy_own(run.modules_before, run.parameters_before);
            copy_run(run);
        }
        copy_own(piece_.letters.size(), piece_.parameters.size());
    }

private:
    void copy_own(std::size_t modules_end, std::size_t parameters_end) {
        const std::size_t modules = modules_end - modules_, parameters = parameters_end - parameters_;
        copy(piece_.letters.data() + modules_, modules, to_.letters.data() + at_.modules);
        copy(piece_.parameters.data() + parameters_, parameters, to_.parameters.data() + at_.parameters);
        const std::size_t rows_before = from_.siblings.size();
        for (std::size_t k = 0; lineage_ && k < modules; ++k) {
            Birth& birth = to_.births[at_.modules + k] = piece_.births[modules_ + k];
            if (birth.siblings >= rows_before) birth.siblings += static_cast<std::uint32_t>(siblings_before_);
        }
        at_ += {modules, parameters, 0};
        modules_ = modules_end;
        parameters_ = parameters_end;
    }
    void copy_run(const GrowingPart::Run& run) {
        const std::size_t modules = run.end - run.begin;
        copy(from_.letters.data() + run.begin, modules, to_.letters.data() + at_.modules);
        copy(run.values, run.parameters, to_.parameters.data() + at_.parameters);
        if (lineage_) copy(from_.births.data() + run.begin, modules, to_.births.data() + at_.modules);
        at_ += {modules, run.parameters, 0};
    }

    const ModuleString& from_;
    const bool lineage_;
    const ModuleString& piece_;
    std::size_t modules_ = 0, parameters_ = 0;  ///< of the piece that are copied
    Extent at_;
    const std::size_t siblings_before_;
    ModuleString& to_;
};

}  // namespace

void join(const StepInput& input, const std::vector<ModuleString>& pieces, const std::deque<GrowingPart>& parts,
          std::size_t held, ModuleString& to) {
    std::vector<Extent> at;
    Extent all;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        at.push_back(all);
        all += parts[k].extent();
    }
    make_room(input, all, held, to, [] { return std::vector<std::uint64_t>(); });
    for_in_parallel(std::size_t{0}, parts.size(), [&](std::size_t k) {
        PartCopy(input, pieces[k], at[k], to).copy_all(parts[k].runs());
        if (input.lineage) copy_rows(input, parts[k], at[k].siblings, to);
    });
    if (input.lineage) drop_unused_siblings(to);
}

void add_siblings(const StepInput& input, const GrowingPart& part, ModuleString& to) {
    if (!input.lineage) return;
    to.siblings = input.from.siblings.grown(part.siblings.rows().size());
    copy_rows(input, part, 0, to);
    drop_unused_siblings(to);
}

void rewrite_and_decompose(const StepInput& input, Scratch& scratch, Machines& machines, Services& services,
                           ModuleString& to, std::atomic<bool>& limit) {
    make_chunks(input, scratch);
    std::atomic<std::size_t> bytes = bytes_before(input);
    if (scratch.pieces.size() < scratch.chunks.size()) scratch.pieces.resize(scratch.chunks.size());
    std::deque<GrowingPart> parts;
    for (std::size_t k = 0; k < scratch.chunks.size(); ++k) {
        parts.emplace_back(scratch.pieces[k], input, bytes, GrowingPart::Runs::joined);
    }
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine& machine) {
        Appending appending(input, machine, services, parts[static_cast<std::size_t>(&chunk - scratch.chunks.data())]);
        appending.run(chunk.begin, chunk.end, chunk.parameters_begin);
        if (appending.reached_limit()) limit = true;
    });
    // Parts of small strings are the thread's.
    join(input, scratch.pieces, parts, input.from.size() <= grain ? bytes_before(input) : bytes.load(), to);
}

}  // namespace espalier::lsystem
