#include "lsystem/compile/foreseeing.h"

#include "base/vector_clones.h"

#include <array>

namespace espalier {
namespace {

/// Polynomials of letters, many side by side, so that also an exchange of two is seen.
ESPALIER_VECTOR_CLONES
std::uint64_t checksum(const LetterId* letters, std::size_t count) {
    constexpr std::size_t lanes = 64;
    constexpr std::uint32_t base = 0x01000193;
    std::array<std::uint32_t, lanes> sums{};
    std::size_t at = 0;
    for (; at + lanes <= count; at += lanes) {
        for (std::size_t k = 0; k < lanes; ++k) sums[k] = sums[k] * base + letters[at + k];
    }
    std::uint64_t sum = count;
    for (; at < count; ++at) sum = mix(sum ^ letters[at]);
    for (std::size_t k = 0; k < lanes; k += 2) sum = mix(sum ^ (std::uint64_t{sums[k]} << 32 | sums[k + 1]));
    return sum;
}

}  // namespace

void plan_ahead(const CompiledSystem& system, Plans& plans) {
    plans.foresees = !plans.all_known && system.choosing.places() == 1 && !system.rules.several_strict;
    for (Plan& plan : plans.choices) {
        Change change{};
        for (; plans.foresees && change.module < plan.length; ++change.module) {
            change.plan = plan.production ? plan.letters[change.module] : plan.block[0];
            if (system.choosing.told[change.plan].changes) {
                plans.ahead.push_back(change);
                ++plan.ahead_count;
            }
            change.held += plans.holdings[change.plan];
        }
        plans.growths.push_back({plan.length - std::int64_t{plan.width}, plan.parameters - std::int64_t{plan.reads},
                                 plan.drawers - std::int64_t{plan.read_drawers}, plan.ahead_count});
    }
    const Change* at = plans.ahead.data();
    for (Plan& plan : plans.choices) {
        plan.ahead = at;
        at += plan.ahead_count;
    }
}

void foresee(const StepInput& input, Scratch& scratch, const Chunk& chunk, const ModuleString& to) {
    const Plan* const plans = input.model.plans.choices.data();
    Change* next = scratch.foreseen.data() + chunk.out_changes;
    // What modules and holdings before a change will be more.
    auto modules = static_cast<std::uint32_t>(chunk.out - chunk.begin);
    std::uint64_t held = (std::uint64_t{chunk.out_parameters} << 32) + chunk.out_drawers -
                         (std::uint64_t{chunk.parameters_at} << 32) - chunk.drawers_at;
    for (const Change& change : std::span(chunk.changes, chunk.change_count)) {
        const Plan& plan = plans[change.plan];
        for (std::uint32_t k = 0; k < plan.ahead_count; ++k) {
            const Change& ahead = plan.ahead[k];
            *next++ = {change.held + held + ahead.held, change.module + modules + ahead.module, ahead.plan};
        }
        modules += plan.length - plan.width;
        held += plan.held_after() - plan.held_before();
    }
    std::size_t at = chunk.out;
    for (Stretch& stretch : scratch.stretches[static_cast<std::size_t>(&chunk - scratch.chunks.data())]) {
        stretch.checksum = checksum(to.letters.data() + at, stretch.modules);
        at += stretch.modules;
    }
}

bool is_as_written(const StepInput& input, const Chunk& chunk) {
    std::size_t at = chunk.begin;
    for (const Stretch& stretch : chunk.stretches) {
        if (checksum(input.from.letters.data() + at, stretch.modules) != stretch.checksum) return false;
        at += stretch.modules;
    }
    return true;
}

}  // namespace espalier
