// Writes strings whose modules have no parameters, where the letter alone says what replaces each: without a list.
#include "base/vector_clones.h"
#include "lsystem/derive/write.h"

#include <algorithm>

namespace espalier::lsystem {
namespace {

struct Reading {
    const LetterId *at, *end;
};

/// Writes in whole blocks as long as the longest successor fits before `end`; moves `reading` past what it wrote.
ESPALIER_VECTOR_CLONES
LetterId* write_in_blocks(const Plans& plans, Reading& reading, LetterId* out, const LetterId* end) {
    const Plan* const choices = plans.choices.data();
    const std::uint32_t* const known = plans.known.data();
    const auto most = static_cast<std::ptrdiff_t>(whole_blocks(plans.longest, letter_block));
    const LetterId* at = reading.at;
    while (at < reading.end && end - out >= most) {
        // As many as fit in any case.
        const LetterId* const stop = at + std::min(reading.end - at, (end - out) / most);
        for (; at < stop; ++at) {
            const Plan& plan = choices[known[*at]];
            std::memcpy(out, plan.block.data(), sizeof plan.block);
            if (plan.length > letter_block)
                copy_run<letter_block>(plan.letters + letter_block, out + letter_block, plan.length - letter_block);
            out += plan.length;
        }
    }
    reading.at = at;
    return out;
}

}  // namespace

void write_letters(const StepInput& input, const Chunk& chunk, ModuleString& to) {
    const Plans& plans = input.system.plans;
    Reading reading{input.from.letters.data() + chunk.begin, input.from.letters.data() + chunk.end};
    const std::size_t end = chunk.at.modules + chunk.becomes.modules;
    LetterId* out = write_in_blocks(plans, reading, to.letters.data() + chunk.at.modules, to.letters.data() + end);
    for (; reading.at < reading.end; ++reading.at) {
        const Plan& plan = plans.of_letter(*reading.at);
        copy_exactly(plan.production ? plan.letters : plan.block.data(), out, plan.length);
        out += plan.length;
    }
}

}  // namespace espalier::lsystem
