// Who the modules of the new string are, who bore them, and when.
#include "base/vector_clones.h"
#include "lsystem/derive/write.h"

#include <array>
#include <bit>
#include <cstring>

namespace espalier::lsystem {
namespace {

/// Where births are read and written.
struct Births {
    const Birth* from;
    Birth* to;
    std::ptrdiff_t in_end, out_end;  ///< where blocks may reach
    std::size_t in, out;
    std::uint32_t row;   ///< row of the next siblings
    Siblings* siblings;  ///< where that is written

    bool has_room(std::size_t run, std::size_t length) const {
        return static_cast<std::ptrdiff_t>(in + run + birth_block) <= in_end &&
               static_cast<std::ptrdiff_t>(out + run + birth_block + whole_blocks(length, birth_block)) <= out_end;
    }
};

// What follows is compiled anew for each width of vectors.

/// Gives a block of places their row, both as one number: else the compiler writes them half by half.
[[gnu::always_inline]] inline void bear(const Birth* places, std::uint32_t row, Birth* to) {
    std::array<std::uint64_t, birth_block> block;
    static_assert(sizeof block == birth_block * sizeof(Birth));
    std::memcpy(block.data(), places, sizeof block);
    for (std::uint64_t& birth : block) birth |= std::bit_cast<std::uint64_t>(Birth{row, 0});
    std::memcpy(to, block.data(), sizeof block);
}

/// The births of modules that live on, and of the successor of those behind them. All of it but the heirs are born now.
/// In whole blocks: what they hold too much is written over.
[[gnu::always_inline]] inline void write_in_blocks(const Births& births, std::size_t run, const Plan& plan) {
    const Birth* const from = births.from + births.in;
    Birth* const to = births.to + births.out;
    copy_run<birth_block>(from, to, run);
    const Descent& descent = plan.production->descent;
    for (std::size_t k = 0; k < plan.length; k += birth_block) bear(&descent.births[k], births.row, to + run + k);
    for (std::size_t s = 0; s < plan.width; ++s) to[run + descent.heirs[s]] = from[run + s];
}

/// The same where blocks would reach too far.
void write_exactly(const Births& births, std::size_t run, const Plan& plan) {
    const Birth* const from = births.from + births.in;
    Birth* const to = births.to + births.out;
    copy_exactly(from, to, run);
    const Descent& descent = plan.production->descent;
    for (std::size_t k = 0; k < plan.length; ++k) to[run + k] = {births.row, descent.births[k].place};
    for (std::size_t s = 0; s < plan.width; ++s) {
        if (descent.heirs[s] < plan.length) to[run + descent.heirs[s]] = from[run + s];
    }
}

ESPALIER_VECTOR_CLONES
void write_all(Births births, const ModuleString& string, std::uint32_t step, const Plan* plans,
               std::span<const Replacement> replacements, std::size_t end) {
    std::size_t replaced = births.in;  // modules before this one
    for (const Replacement& replacement : replacements) {
        const std::size_t module = replacement.module;
        if (module < replaced) continue;  // replaced with one before it
        const Plan& plan = plans[replacement.plan];
        replaced = module + plan.width;
        if (!plan.moves) continue;
        const std::size_t run = module - births.in;
        if (births.has_room(run, plan.length))
            write_in_blocks(births, run, plan);
        else
            write_exactly(births, run, plan);
        if (plan.bears) {
            *births.siblings++ = {string.identity(module), step, 0};
            ++births.row;
        }
        births.in = replaced;
        births.out += run + plan.length;
    }
    copy_exactly(births.from + births.in, births.to + births.out, end - births.in);
}

}  // namespace

void write_births(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements,
                  ModuleString& to) {
    const std::size_t row = input.from.siblings.size() + chunk.at.siblings;
    const Births births{input.from.births.data(),
                        to.births.data(),
                        reach(input.from.births, input.from.size(), spare_births, true),
                        reach(to.births, chunk.at.modules + chunk.becomes.modules, spare_births, chunk.is_last),
                        chunk.begin,
                        chunk.at.modules,
                        static_cast<std::uint32_t>(row),
                        chunk.becomes.siblings > 0 ? &to.siblings.added(row) : nullptr};
    write_all(births, input.from, input.step, input.system.plans.choices.data(), replacements, chunk.end);
}

}  // namespace espalier::lsystem
