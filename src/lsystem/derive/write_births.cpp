// Who the modules of the new string are, who bore them, and when.
#include "base/vector_clones.h"
#include "lsystem/derive/write.h"

namespace espalier::lsystem {
namespace {

/// Where births are read and written.
struct Births {
    const ModuleString& from;
    Birth* to;
    std::ptrdiff_t in_end, out_end;  ///< where blocks may reach
    std::size_t in, out;
    Siblings* row;  ///< row of the next siblings
    std::uint32_t number;
};

// What follows is compiled anew for each width of vectors.

/// Those that live on keep their births.
[[gnu::always_inline]] inline void copy_until(Births& births, std::size_t module) {
    const std::size_t count = module - births.in;
    const auto block = static_cast<std::ptrdiff_t>(count + birth_block);
    const bool has_room = births.in_end - static_cast<std::ptrdiff_t>(births.in) >= block &&
                          births.out_end - static_cast<std::ptrdiff_t>(births.out) >= block;
    const Birth* const from = births.from.births.data() + births.in;
    if (has_room)
        copy_run<birth_block>(from, births.to + births.out, count);
    else
        copy_exactly(from, births.to + births.out, count);
    births.in = module;
    births.out += count;
}

[[gnu::always_inline]] inline void bear(Births& births, const Descent& descent, std::size_t length,
                                        std::uint32_t step) {
    *births.row++ = {births.from.identity(births.in), step, 0};
    Birth* const to = births.to + births.out;
    const Birth* const places = descent.births.data();
    const auto write = [&](std::size_t k) { to[k] = {births.number, places[k].place}; };
    const auto blocks = static_cast<std::ptrdiff_t>(whole_blocks(length, birth_block));
    if (births.out_end - static_cast<std::ptrdiff_t>(births.out) >= blocks) {
        for (std::size_t begin = 0; begin < length; begin += birth_block) {
            for (std::size_t k = begin; k < begin + birth_block; ++k) write(k);
        }
    } else {
        for (std::size_t k = 0; k < length; ++k) write(k);
    }
    ++births.number;
}

ESPALIER_VECTOR_CLONES
void write_all(Births births, const Plan* plans, std::span<const Replacement> replacements, std::uint32_t step,
               std::size_t end) {
    std::size_t replaced = births.in;  // modules before this one
    for (const Replacement& replacement : replacements) {
        if (replacement.module < replaced) continue;  // replaced with one before it
        const Plan& plan = plans[replacement.plan];
        replaced = std::size_t{replacement.module} + plan.width;
        if (!plan.moves) continue;
        copy_until(births, replacement.module);
        const Descent& descent = plan.production->descent;
        if (plan.bears) bear(births, descent, plan.length, step);
        // All but the heirs are born now; heirs are put over them.
        for (std::size_t s = 0; s < descent.heirs.size(); ++s) {
            if (descent.heirs[s] == Descent::none) continue;
            births.to[births.out + descent.heirs[s]] = births.from.births[births.in + s];
        }
        births.in += plan.width;
        births.out += plan.length;
    }
    copy_until(births, end);
}

}  // namespace

void write_births(const StepInput& input, const Chunk& chunk, std::span<const Replacement> replacements,
                  ModuleString& to) {
    const std::size_t row = input.from.siblings.size() + chunk.at.siblings;
    const Births births{input.from,
                        to.births.data(),
                        reach(input.from.births, input.from.size(), spare_births, true),
                        reach(to.births, chunk.at.modules + chunk.becomes.modules, spare_births, chunk.is_last),
                        chunk.begin,
                        chunk.at.modules,
                        chunk.becomes.siblings > 0 ? &to.siblings.added(row) : nullptr,
                        static_cast<std::uint32_t>(row)};
    write_all(births, input.system.plans.choices.data(), replacements, input.step, chunk.end);
}

}  // namespace espalier::lsystem
