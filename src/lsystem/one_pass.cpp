// One pass over the string, appending: for models whose productions have an order, consume blocks of modules,
// or decompose what they write.
#include "expansion.h"
#include "rewriting.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace espalier {
namespace {

/// A string that grows within the step's memory.
class GrowingString {
public:
    GrowingString(ModuleString& string, const StepInput& input, std::atomic<std::size_t>& bytes)
        : string_(string), input_(input), bytes_(bytes) {
        string_.clear();
        bytes_ += string_.bytes();
    }

    void append(LetterId letter, const double* values, std::size_t arity, const Lineage& lineage) {
        if (string_.letters.size() == string_.letters.capacity() ||
            string_.parameters.capacity() - string_.parameters.size() < arity) {
            grow(arity);
        }
        string_.letters.push_back(letter);
        string_.parameters.insert(string_.parameters.end(), values, values + arity);
        if (!input_.lineage) return;
        string_.identities.push_back(lineage.identity);
        string_.parents.push_back(lineage.parent);
        string_.births.push_back(lineage.birth);
    }

    std::vector<std::uint64_t> uses;  ///< of each production, for the message when memory runs out

private:
    void grow(std::size_t arity) {
        const std::size_t modules = std::max<std::size_t>(1024, string_.letters.size() * 2);
        const std::size_t parameters = std::max<std::size_t>(
            string_.parameters.capacity(), string_.parameters.capacity() - string_.parameters.size() < arity
                                               ? std::max<std::size_t>(1024, (string_.parameters.size() + arity) * 2)
                                               : 0);
        const std::size_t before = string_.bytes();
        const std::size_t after = bytes_needed(modules, parameters, input_.lineage);
        const std::size_t total = bytes_ += after > before ? after - before : 0;
        if (total > input_.memory || modules >= BranchLinks::none) refuse_memory(input_, modules, total, uses);
        string_.letters.reserve(modules);
        string_.parameters.reserve(parameters);
        if (!input_.lineage) return;
        string_.identities.reserve(modules);
        string_.parents.reserve(modules);
        string_.births.reserve(modules);
    }

    ModuleString& string_;
    const StepInput& input_;
    std::atomic<std::size_t>& bytes_;
};

/// Rewrites one range of the string in order.
class OnePass {
public:
    OnePass(const StepInput& input, Machine& machine, Services& services, GrowingString& out)
        : input_(input),
          model_(input.model),
          machine_(machine),
          services_(services),
          out_(out),
          matcher_(input.model, input.view, machine),
          rewriting_(model_.rules, matcher_, machine),
          decomposition_(model_.decomposition, matcher_, machine) {
        matcher_.set_draws(input.key, input.step);
        out_.uses.resize(model_.rules.productions.size());
    }

    /// Returns where it ended: a predecessor of several modules that names `%` may reach beyond `end`.
    std::size_t run(std::size_t begin, std::size_t end, std::size_t parameters_at);
    bool reached_limit() const { return decomposition_.reached_limit(); }

private:
    std::size_t rewrite(const Site& site);
    Lineage lineage(std::size_t module) const;
    void decompose(const Site& site);
    void follow_reseeding();

    const StepInput& input_;
    const CompiledModel& model_;
    Machine& machine_;
    Services& services_;
    GrowingString& out_;
    Matcher matcher_;
    Expansion rewriting_, decomposition_;
    ModuleStack stack_;
    std::vector<Lineage> strict_;
    bool decomposing_ = false;
};

Lineage OnePass::lineage(std::size_t module) const {
    if (!input_.lineage) return {};
    return {input_.from.identities[module], input_.from.parents[module], input_.from.births[module]};
}

std::size_t OnePass::run(std::size_t begin, std::size_t end, std::size_t parameters_at) {
    const auto arities = model_.source->alphabet.arities();
    const LetterId* letters = input_.from.letters.data();
    const double* values = input_.from.parameters.data() + parameters_at;
    std::size_t i = begin;
    while (i < end) {
        const auto at = static_cast<std::size_t>(values - input_.from.parameters.data());
        const Site site{i, at, letters[i], values, lineage(i).identity, 0};
        std::size_t consumed = 0;
        try {
            decomposing_ = false;
            consumed = rewrite(site);
        } catch (const EvaluationError& error) {
            const LetterId letter = decomposing_ ? decomposition_.letter() : letters[i];
            throw RunError(describe(error, model_.source->alphabet, letter,
                                    decomposing_ ? decomposition_.values() : values, input_.step));
        }
        for (const std::size_t next = i + consumed; i < next; ++i) values += arities[letters[i]];
    }
    return i;
}

/// Replaces the modules at a site; returns how many they were.
std::size_t OnePass::rewrite(const Site& site) {
    const CompiledProduction* production = matcher_.choose(model_.rules, site);
    const std::size_t width = production ? production->strict.size() : 1;
    if (production) {
        ++out_.uses[static_cast<std::size_t>(production - model_.rules.productions.data())];
        matcher_.begin_successor(*production, site);
        strict_.clear();
        for (std::size_t k = 0; k < width; ++k) strict_.push_back(lineage(site.first + k));
        rewriting_.push_successor(*production, strict_.data(), input_.step, 0, stack_);
        follow_reseeding();
    } else {
        const int arity = model_.source->alphabet.arity(site.letter);
        if (!model_.decomposition.has(site.letter)) {
            out_.append(site.letter, site.values, static_cast<std::size_t>(arity), lineage(site.first));
            return 1;
        }
        stack_.push({site.letter, static_cast<std::uint16_t>(arity), 0, lineage(site.first)}, site.values);
    }
    Site origin = site;
    origin.width = width;
    decompose(origin);
    return width;
}

void OnePass::decompose(const Site& site) {
    decomposing_ = true;
    decomposition_.run(stack_, site, input_.step, [&](const ModuleStack::Entry& entry, const double* values) {
        out_.append(entry.letter, values, entry.arity, entry.lineage);
    });
    follow_reseeding();
}

// srand() in a production begins the stream anew for all modules that follow, too.
void OnePass::follow_reseeding() {
    if (!machine_.reseeded()) return;
    matcher_.set_draws(RandomKey(services_.seed, services_.plant, Stream::derivation, services_.salt), input_.step);
}

void run_in_order(const StepInput& input, Scratch& scratch, Machine& machine, Services& services, ModuleString& to,
                  std::atomic<bool>& limit) {
    std::atomic<std::size_t> bytes = input.from.bytes();
    GrowingString out(to, input, bytes);
    OnePass pass(input, machine, services, out);
    const auto arities = input.model.source->alphabet.arities();
    std::size_t at = 0, parameters_at = 0, rewritten = 0;
    for (const auto& [kept_begin, end] : scratch.kept) {
        const std::size_t begin = std::max(kept_begin, rewritten);
        for (; at < begin; ++at) parameters_at += arities[input.from.letters[at]];
        rewritten = pass.run(begin, end, parameters_at);
    }
    if (pass.reached_limit()) limit = true;
}

template <class T>
void copy_column(const Column<T>& from, Column<T>& to, std::size_t at) {
    if (!from.empty()) std::memcpy(to.data() + at, from.data(), from.size() * sizeof(T));
}

void join(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to, std::size_t held) {
    std::size_t modules = 0, parameters = 0;
    for (std::size_t k = 0; k < scratch.chunks.size(); ++k) {
        scratch.chunks[k].out = modules;
        scratch.chunks[k].out_parameters = parameters;
        modules += scratch.pieces[k].size();
        parameters += scratch.pieces[k].parameters.size();
    }
    const std::size_t bytes = held + bytes_needed(modules, parameters, input.lineage);
    if (bytes > input.memory || modules >= BranchLinks::none) refuse_memory(input, modules, bytes, {});
    resize(to, modules, parameters, input.lineage);
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine&) {
        const ModuleString& piece = scratch.pieces[static_cast<std::size_t>(&chunk - scratch.chunks.data())];
        copy_column(piece.letters, to.letters, chunk.out);
        copy_column(piece.parameters, to.parameters, chunk.out_parameters);
        copy_column(piece.identities, to.identities, chunk.out);
        copy_column(piece.parents, to.parents, chunk.out);
        copy_column(piece.births, to.births, chunk.out);
    });
}

}  // namespace

void rewrite_in_one_pass(const StepInput& input, Scratch& scratch, Machines& machines, Services& services,
                         ModuleString& to, std::atomic<bool>& limit) {
    make_chunks(input, scratch);
    if (input.model.ordered() || input.model.rules.several_strict || scratch.chunks.size() == 1) {
        return run_in_order(input, scratch, machines.local(), services, to, limit);
    }
    if (scratch.pieces.size() < scratch.chunks.size()) scratch.pieces.resize(scratch.chunks.size());
    std::atomic<std::size_t> bytes = input.from.bytes();
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine& machine) {
        GrowingString out(scratch.pieces[static_cast<std::size_t>(&chunk - scratch.chunks.data())], input, bytes);
        OnePass pass(input, machine, services, out);
        pass.run(chunk.begin, chunk.end, chunk.parameters_at);
        if (pass.reached_limit()) limit = true;
    });
    join(input, scratch, machines, to, bytes);
}

}  // namespace espalier
