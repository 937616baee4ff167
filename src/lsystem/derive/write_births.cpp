// Who the modules of the new string are, who bore them, and when.
#include "base/vector_clones.h"
#include "lsystem/derive/write.h"

#include <bit>
#include <cstring>

namespace espalier::lsystem {
namespace {

// What follows is compiled anew for each width of vectors.

/// Births, each as one number.
using FourBirths = std::uint64_t __attribute__((vector_size(32)));
static_assert(sizeof(FourBirths) == 4 * sizeof(Birth) && birth_block % 4 == 0);

/// Gives a block of places their row.
[[gnu::always_inline]] inline void bear(const Birth* places, std::uint32_t row, Birth* to) {
    for (std::size_t k = 0; k < birth_block; k += 4) {
        FourBirths births;
        std::memcpy(&births, places + k, sizeof births);
        births |= std::bit_cast<std::uint64_t>(Birth{row, 0});
        std::memcpy(to + k, &births, sizeof births);
    }
}

/// The births of a run of modules that live on, and of the successor of those behind them. All of it but the heirs are
/// born now. In whole blocks: what they hold too much is written over.
[[gnu::always_inline]] inline void write_in_blocks(const Birth* from, Birth* to, std::size_t run, const Plan& plan,
                                                   std::uint32_t row) {
    copy_run<birth_block>(from, to, run);
    from += run;
    to += run;
    const Descent& descent = plan.production->descent;
    for (std::size_t k = 0; k < plan.length; k += birth_block) bear(&descent.births[k], row, to + k);
    for (std::size_t s = 0; s < plan.width; ++s) to[descent.heirs[s]] = from[s];
}

/// The same where blocks would reach too far.
void write_exactly(const Birth* from, Birth* to, std::size_t run, const Plan& plan, std::uint32_t row) {
    copy_exactly(from, to, run);
    from += run;
    to += run;
    const Descent& descent = plan.production->descent;
    for (std::size_t k = 0; k < plan.length; ++k) to[k] = {row, descent.births[k].place};
    for (std::size_t s = 0; s < plan.width; ++s) {
        if (descent.heirs[s] < plan.length) to[descent.heirs[s]] = from[s];
    }
}

/// Where births and rows of siblings are read and written.
struct Births {
    const ModuleString& from;
    ModuleString& to;
    std::size_t in, out;          ///< where the chunk begins
    std::size_t in_end, out_end;  ///< where blocks may reach
    std::size_t row;              ///< that of the next siblings
    std::uint32_t step;
};

ESPALIER_VECTOR_CLONES
void write_all(const Births& births, const Plan* plans, std::span<const Replacement> replacements, std::size_t end) {
    const Birth* const from = births.from.births.data();
    Birth* const to = births.to.births.data();
    std::size_t in = births.in, out = births.out, row = births.row;
    for (const Replacement& replacement : replacements) {
        const std::size_t module = replacement.module;
        if (module < in) continue;  // replaced with one before it
        const Plan& plan = plans[replacement.plan];
        if (!plan.moves) continue;
        const std::size_t run = module - in;
        const std::size_t blocks = birth_block + whole_blocks(plan.length, birth_block);
        if (module + birth_block <= births.in_end && out + run + blocks <= births.out_end)
            write_in_blocks(from + in, to + out, run, plan, static_cast<std::uint32_t>(row));
        else
            write_exactly(from + in, to + out, run, plan, static_cast<std::uint32_t>(row));
        if (plan.bears) births.to.siblings.added(row++) = {births.from.identity(module), births.step, 0, 0};
        in = module + plan.width;
        out += run + plan.length;
    }
    copy_exactly(from + in, to + out, end - in);
}

}  // namespace

void write_births(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements,
                  ModuleString& to) {
    const auto end = [](std::ptrdiff_t reached) { return static_cast<std::size_t>(reached); };
    const Births births{input.from,
                        to,
                        chunk.begin,
                        chunk.at.modules,
                        end(reach(input.from.births, input.from.size(), spare_births, true)),
                        end(reach(to.births, chunk.at.modules + chunk.becomes.modules, spare_births, chunk.is_last)),
                        input.from.siblings.size() + chunk.at.siblings,
                        input.step};
    write_all(births, input.system.plans.choices.data(), replacements, chunk.end);
}

}  // namespace espalier::lsystem
