// Who the modules of the new string are, who bore them, and when.
#include "writing.h"

namespace espalier {
namespace {

/// The columns of lineage from one module on.
struct LineageColumns {
    LineageColumns(ModuleString& string, std::size_t at)
        : identities(string.identities.data() + at),
          parents(string.parents.data() + at),
          births(string.births.data() + at) {}

    Identity* identities;
    Identity* parents;
    std::uint32_t* births;
};

inline void copy(const ModuleString& from, std::size_t module, const LineageColumns& to, std::size_t at) {
    to.identities[at] = from.identities[module];
    to.parents[at] = from.parents[module];
    to.births[at] = from.births[module];
}

/// All but the heirs are born now; heirs are put over them.
inline void write_brood(const StepInput& input, const CompiledProduction& production, std::size_t module,
                        const LineageColumns& to, std::size_t at) {
    const Identity parent = input.from.identities[module];
    const Brood brood(parent, input.step);
    const Descent* const descents = production.descents.data();
    for (std::size_t k = 0; k < production.length; ++k) {
        to.identities[at + k] = brood.born(descents[k].place);
        to.parents[at + k] = parent;
        to.births[at + k] = input.step;
    }
    for (std::size_t s = 0; s < production.heirs.size(); ++s) {
        if (production.heirs[s] != Descent::none) copy(input.from, module + s, to, at + production.heirs[s]);
    }
}

}  // namespace

void write_lineage(const StepInput& input, const Scratch& scratch, const Chunk& chunk, ModuleString& to) {
    const LetterId* const letters = input.from.letters.data();
    const Plan* const plans = input.model.plans.of_letter.data();
    const LineageColumns columns(to, chunk.out);
    const bool known = input.model.plans.all_known;
    std::size_t at = 0;
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        const Plan* plan = plans + letters[i];
        if (!known) plan = plan->choices + scratch.choices[i];
        if (plan->production)
            write_brood(input, *plan->production, i, columns, at);
        else if (plan->length > 0)
            copy(input.from, i, columns, at);
        at += plan->length;
    }
}

}  // namespace espalier
