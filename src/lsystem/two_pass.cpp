// Match and measure, prefix sum, write. Every chunk of the old string knows where its part of the new one begins.
#include "measuring.h"

#include <algorithm>
#include <cstring>

namespace espalier {
namespace {

constexpr std::size_t copied_at_once = 4;

/// Rewrites chunks of one string into another whose columns have their final size.
class TwoPasses {
public:
    TwoPasses(const StepInput& input, Scratch& scratch)
        : input_(input), model_(input.model), plans_(input.model.plans), scratch_(scratch) {}

    void place(ModuleString& to);
    void write(Chunk& chunk, Machine& machine) const;

private:
    template <bool Lineage>
    void write(Chunk& chunk, Machine& machine) const;
    void write_values(const Plan& plan, const Site& site, Matcher& matcher, Machine& machine, double* out) const;
    void write_lineage(const Plan& plan, std::size_t module, std::size_t out) const;
    std::vector<std::uint64_t> count_uses() const;

    const StepInput& input_;
    const CompiledSystem& model_;
    const Plans& plans_;
    Scratch& scratch_;
    ModuleString* to_ = nullptr;
};

void TwoPasses::place(ModuleString& to) {
    std::size_t modules = 0, parameters = 0;
    for (Chunk& chunk : scratch_.chunks) {
        chunk.out = modules;
        chunk.out_parameters = parameters;
        modules += chunk.out_end;
        parameters += chunk.out_parameters_end;
        chunk.out_end = modules;
        chunk.out_parameters_end = parameters;
    }
    const std::size_t bytes = input_.from.bytes() + bytes_needed(modules, parameters, input_.lineage);
    if (bytes > input_.memory || modules >= BranchLinks::none) refuse_memory(input_, modules, bytes, count_uses());
    resize(to, modules, parameters, input_.lineage);
    to_ = &to;
}

std::vector<std::uint64_t> TwoPasses::count_uses() const {
    std::vector<std::uint64_t> uses(model_.rules.productions.size());
    for (const Chunk& chunk : scratch_.chunks) {
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
            const Plan& known = plans_.of_letter[input_.from.letters[i]];
            const Plan& used = known.kind == Plan::Kind::choose ? known.choices[scratch_.choices[i]] : known;
            if (used.production) ++uses[static_cast<std::size_t>(used.production - model_.rules.productions.data())];
        }
    }
    return uses;
}

void TwoPasses::write_values(const Plan& plan, const Site& site, Matcher& matcher, Machine& machine,
                             double* out) const {
    const CompiledProduction& production = *plan.production;
    matcher.bind(production, site);
    matcher.begin_successor(production, site);
    if (!production.after.empty()) machine.run(production.after);
    machine.run(production.successor);
    for (std::size_t k = 0; k < production.parameters; ++k) out[k] = machine.value(production.successor.results[k]);
    require_finite(production, out);
}

void TwoPasses::write_lineage(const Plan& plan, std::size_t module, std::size_t out) const {
    const ModuleString& from = input_.from;
    const Identity identity = from.identities[module];
    Identity* const identities = to_->identities.data() + out;
    Identity* const parents = to_->parents.data() + out;
    std::uint32_t* const births = to_->births.data() + out;
    if (!plan.production) {
        *identities = identity;
        *parents = from.parents[module];
        *births = from.births[module];
        return;
    }
    const Brood brood(identity, input_.step);
    const Descent* const descents = plan.production->descents.data();
    for (std::size_t k = 0; k < plan.length; ++k) {
        const bool heir = descents[k].heir_of != Descent::born;
        identities[k] = heir ? identity : brood.born(descents[k].place);
        parents[k] = heir ? from.parents[module] : identity;
        births[k] = heir ? from.births[module] : input_.step;
    }
}

/// Writes lanes; false if a value is not finite.
inline bool write_lanes(const Plan& plan, const double* values, double* out) {
    static constexpr double none = 0;
    const double* source = plan.arity > 0 ? values : &none;
    bool finite = true;
    for (std::uint32_t k = 0; k < plan.parameters; ++k) {
        const Lane& lane = plan.lanes[k];
        const double value = source[lane.source] * lane.scale + lane.offset;
        out[k] = value;
        finite &= value - value == 0;
    }
    return finite;
}

/// Writes the letters of a successor. A whole block is copied whatever its length: the next module overwrites what is
/// too much.
inline void write_letters(const Plan& plan, LetterId* out, const LetterId* out_end) {
    if (out_end - out < static_cast<std::ptrdiff_t>(letter_block)) {
        std::copy_n(plan.block.data(), plan.length, out);
        return;
    }
    std::memcpy(out, plan.block.data(), sizeof plan.block);
    if (plan.length <= letter_block) return;
    std::memcpy(out + letter_block, plan.letters + letter_block, (plan.length - letter_block) * sizeof(LetterId));
}

inline void copy_values(std::size_t count, const double* from, const double* from_end, double* to,
                        const double* to_end) {
    const auto room = static_cast<std::ptrdiff_t>(copied_at_once);
    if (count <= copied_at_once && from_end - from >= room && to_end - to >= room) {
        std::memcpy(to, from, copied_at_once * sizeof(double));
    } else {
        std::memcpy(to, from, count * sizeof(double));
    }
}

template <bool Lineage>
void TwoPasses::write(Chunk& chunk, Machine& machine) const {
    Matcher matcher(model_, input_.view, machine);
    matcher.set_draws(input_.key, input_.step);
    LetterId* out = to_->letters.data() + chunk.out;
    LetterId* const out_end = to_->letters.data() + chunk.out_end;
    double* out_values = to_->parameters.data() + chunk.out_parameters;
    double* const out_values_end = to_->parameters.data() + chunk.out_parameters_end;
    const double* values = input_.from.parameters.data() + chunk.parameters_at;
    const double* const values_end = input_.from.parameters.data() + input_.from.parameters.size();
    const LetterId* const letters = input_.from.letters.data();
    const Plan* const plans = plans_.of_letter.data();
    std::size_t i = chunk.begin;
    try {
        for (const std::size_t end = chunk.end; i < end; ++i) {
            const Plan* used = plans + letters[i];
            if (used->kind == Plan::Kind::choose) used = used->choices + scratch_.choices[i];
            write_letters(*used, out, out_end);
            if (used->kind != Plan::Kind::bare) {
                if (used->kind == Plan::Kind::copy) {
                    copy_values(used->arity, values, values_end, out_values, out_values_end);
                } else if (used->kind == Plan::Kind::program || !write_lanes(*used, values, out_values)) {
                    write_values(*used, site_of(input_, i, values), matcher, machine, out_values);
                }
            }
            if constexpr (Lineage) write_lineage(*used, i, static_cast<std::size_t>(out - to_->letters.data()));
            out += used->length;
            out_values += used->parameters;
            values += used->arity;
        }
    } catch (const EvaluationError& error) {
        throw RunError(describe(error, model_.source->alphabet, letters[i], values, input_.step));
    }
}

void TwoPasses::write(Chunk& chunk, Machine& machine) const {
    if (input_.lineage)
        write<true>(chunk, machine);
    else
        write<false>(chunk, machine);
}

}  // namespace

void rewrite_in_two_passes(const StepInput& input, Scratch& scratch, Machines& machines, ModuleString& to) {
    make_chunks(input, scratch);
    TwoPasses passes(input, scratch);
    if (!input.model.plans.all_known) {
        scratch.choices.resize(input.from.size());
        for_each_chunk(scratch.chunks, machines,
                       [&](Chunk& chunk, Machine& machine) { measure(input, scratch, chunk, machine); });
    }
    passes.place(to);
    for_each_chunk(scratch.chunks, machines, [&](Chunk& chunk, Machine& machine) { passes.write(chunk, machine); });
}

}  // namespace espalier
