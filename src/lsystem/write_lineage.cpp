// Who the modules of the new string are, who bore them, and when.
#include "espalier/base/vector_clones.h"

#include "writing.h"

#include <algorithm>
#include <cstring>

namespace espalier {
namespace {

/// A column of the old string and that of the new one, from the chunk's part on.
template <class T>
struct Pair {
    const T* from;
    T* to;

    void copy(std::size_t module, std::size_t at) const { to[at] = from[module]; }
    void copy_block(std::size_t module, std::size_t at) const {
        std::memcpy(to + at, from + module, lineage_block * sizeof(T));
    }
    void fill_block(std::size_t at, T value) const {
        for (std::size_t k = 0; k < lineage_block; ++k) to[at + k] = value;
    }
};

struct LineageColumns {
    Pair<Identity> identities, parents;
    Pair<std::uint32_t> births;

    void copy(std::size_t module, std::size_t at) const {
        identities.copy(module, at);
        parents.copy(module, at);
        births.copy(module, at);
    }
    void copy_block(std::size_t module, std::size_t at) const {
        identities.copy_block(module, at);
        parents.copy_block(module, at);
        births.copy_block(module, at);
    }
};

/// What lineage is written from: whole columns, and the plans that the modules' letters and choices name.
struct Lines {
    LineageColumns columns;
    const LetterId* letters;
    const LetterId* choices;  ///< null where letters tell all
    const Plan* plans;
    std::uint32_t step;
    std::size_t size;  ///< of the old string
    std::size_t room;  ///< for the chunk's modules in the new one
    std::size_t longest;

    const Plan& plan(std::size_t module) const {
        const Plan& plan = plans[letters[module]];
        return choices ? plan.choices[choices[module]] : plan;
    }
};

inline bool lives_on(const Plan& plan) {
    return !plan.production && plan.length > 0;
}

/// All but the heirs are born now; heirs are put over them.
inline void write_heirs(const Lines& lines, const CompiledProduction& production, std::size_t module, std::size_t at) {
    for (std::size_t s = 0; s < production.heirs.size(); ++s) {
        if (production.heirs[s] != Descent::none) lines.columns.copy(module + s, at + production.heirs[s]);
    }
}

inline void write_brood(const Lines& lines, const CompiledProduction& production, std::size_t module, std::size_t at) {
    const LineageColumns& columns = lines.columns;
    const Identity parent = columns.identities.from[module];
    const Brood brood(parent, lines.step);
    const std::uint32_t* const places = production.places.data();
    for (std::size_t begin = 0; begin < production.length; begin += lineage_block) {
        for (std::size_t k = begin; k < begin + lineage_block; ++k) {
            columns.identities.to[at + k] = brood.born(places[k]);
        }
        columns.parents.fill_block(at + begin, parent);
        columns.births.fill_block(at + begin, lines.step);
    }
    write_heirs(lines, production, module, at);
}

/// The same, and nothing beyond the brood.
void write_brood_exactly(const Lines& lines, const CompiledProduction& production, std::size_t module, std::size_t at) {
    const Identity parent = lines.columns.identities.from[module];
    const Brood brood(parent, lines.step);
    for (std::size_t k = 0; k < production.length; ++k) {
        lines.columns.identities.to[at + k] = brood.born(production.places[k]);
        lines.columns.parents.to[at + k] = parent;
        lines.columns.births.to[at + k] = lines.step;
    }
    write_heirs(lines, production, module, at);
}

/// Writes the lineage of what replaces some modules.
ESPALIER_VECTOR_CLONES
void write_lines(const Lines& lines, std::size_t module, const std::size_t end) {
    const std::size_t margin = whole_blocks(lines.longest, lineage_block);
    const std::size_t last_at = lines.room - std::min(lines.room, margin - 1);
    const std::size_t last_module = std::min(end, lines.size - std::min(lines.size, lineage_block - 1));
    std::size_t at = 0;
    while (module < last_module && at < last_at) {
        const Plan& plan = lines.plan(module);
        if (!lives_on(plan)) {
            if (plan.production) write_brood(lines, *plan.production, module, at);
            at += plan.length;
            ++module;
            continue;
        }
        // A block at once, of which as many count as live on one after the other.
        lines.columns.copy_block(module, at);
        const std::size_t stop = std::min(end, module + lineage_block);
        for (++module, ++at; module < stop && lives_on(lines.plan(module)); ++module) ++at;
    }
    for (; module < end; ++module) {
        const Plan& plan = lines.plan(module);
        if (plan.production)
            write_brood_exactly(lines, *plan.production, module, at);
        else if (lives_on(plan))
            lines.columns.copy(module, at);
        at += plan.length;
    }
}

}  // namespace

void write_lineage(const StepInput& input, const Scratch& scratch, const Chunk& chunk, ModuleString& to) {
    const ModuleString& from = input.from;
    const LineageColumns columns{{from.identities.data(), to.identities.data() + chunk.out},
                                 {from.parents.data(), to.parents.data() + chunk.out},
                                 {from.births.data(), to.births.data() + chunk.out}};
    const Plans& plans = input.model.plans;
    const Lines lines{columns,
                      from.letters.data(),
                      plans.all_known ? nullptr : scratch.choices.data(),
                      plans.of_letter.data(),
                      input.step,
                      from.size(),
                      chunk.out_end - chunk.out,
                      plans.longest};
    write_lines(lines, chunk.begin, chunk.end);
}

}  // namespace espalier
