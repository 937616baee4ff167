// Who the modules of the new string are, who bore them, and when.
#include "espalier/base/vector_clones.h"

#include "writing.h"

#include <algorithm>
#include <array>
#include <span>

namespace espalier {
namespace {

/// A column of the old string and that of the new one, from the chunk's parts on.
template <class T>
struct Pair {
    const T* from;
    T* to;

    void copy(std::size_t module, std::size_t at) const { to[at] = from[module]; }
    void copy_run(std::size_t module, std::size_t at, std::size_t count) const {
        espalier::copy_run<lineage_block>(from + module, to + at, count);
    }
    void copy_exactly(std::size_t module, std::size_t at, std::size_t count) const {
        std::copy_n(from + module, count, to + at);
    }
    void fill_block(std::size_t at, T value) const {
        for (std::size_t k = 0; k < lineage_block; ++k) to[at + k] = value;
    }
};

/// What lineage is written from, from the chunk's parts on.
struct Lines {
    Pair<Identity> identities, parents;
    Pair<std::uint32_t> births;
    const LetterId* letters;
    const LetterId* letters_end;  ///< of the whole string
    const LetterId* choices;      ///< null where letters tell all
    const Plans& plans;
    std::uint32_t step;
    std::size_t size;   ///< of the chunk
    std::size_t known;  ///< modules of the old string
    std::size_t room;   ///< for the chunk's modules in the new one

    const Plan& plan(std::size_t module) const {
        const Plan& plan = plans.of_letter[letters[module]];
        return choices ? plan.choices[choices[module]] : spelled_plan(plan, letters + module, letters_end);
    }
    /// Calls copy(column) for what is kept: identities or, if `whole`, parents and births, too.
    template <bool whole, class Copy>
    void for_each_column(const Copy& copy) const {
        copy(identities);
        if constexpr (whole) {
            copy(parents);
            copy(births);
        }
    }
};

// What follows is compiled anew for each width of vectors.

/// Where lineage is read and written.
struct Place {
    std::size_t module = 0, at = 0;
};

template <bool whole>
[[gnu::always_inline]] inline void write_run(const Lines& lines, Place& place, std::size_t end) {
    const auto [module, at] = place;
    const std::size_t count = end - module;
    if (end + lineage_block <= lines.known && at + count + lineage_block <= lines.room)
        lines.for_each_column<whole>([&](const auto& column) { column.copy_run(module, at, count); });
    else
        lines.for_each_column<whole>([&](const auto& column) { column.copy_exactly(module, at, count); });
    place = {end, at + count};
}

template <bool whole>
[[gnu::always_inline]] inline void write_brood(const Lines& lines, const CompiledProduction& production,
                                               const Place& place) {
    const auto [module, at] = place;
    const Identity parent = lines.identities.from[module];
    const Brood brood(parent, lines.step);
    const std::uint32_t* const places = production.places.data();
    Identity* const born = lines.identities.to + at;
    if (at + production.length + lineage_block <= lines.room) {
        for (std::size_t begin = 0; begin < production.length; begin += lineage_block) {
            for (std::size_t k = begin; k < begin + lineage_block; ++k) born[k] = brood.born(places[k]);
            if constexpr (whole) {
                lines.parents.fill_block(at + begin, parent);
                lines.births.fill_block(at + begin, lines.step);
            }
        }
    } else {
        for (std::size_t k = 0; k < production.length; ++k) {
            born[k] = brood.born(places[k]);
            if constexpr (whole) {
                lines.parents.to[at + k] = parent;
                lines.births.to[at + k] = lines.step;
            }
        }
    }
    // All but the heirs are born now; heirs are put over them.
    for (std::size_t s = 0; s < production.heirs.size(); ++s) {
        if (production.heirs[s] == Descent::none) continue;
        lines.for_each_column<whole>([&](const auto& column) { column.copy(module + s, at + production.heirs[s]); });
    }
}

/// Of modules that change, and of what lives on before them.
template <bool whole>
[[gnu::always_inline]] inline void write_changes(const Lines& lines, std::span<const Change> changes, Place& place) {
    for (const Change& change : changes) {
        if (change.module < place.module) continue;  // replaced with one before it
        if (change.module > place.module) write_run<whole>(lines, place, change.module);
        const Plan& plan = lines.plan(place.module);
        if (!plan.production) continue;  // it lives on after all
        write_brood<whole>(lines, *plan.production, place);
        place = {place.module + plan.width, place.at + plan.length};
    }
}

/// The same where the letters alone say what changes.
template <bool whole>
[[gnu::always_inline]] inline void write_rewritten(const Lines& lines, Place& place) {
    std::array<Change, 256> changes;
    for (std::size_t begin = 0; begin < lines.size; begin += changes.size()) {
        const std::size_t end = std::min(begin + changes.size(), lines.size);
        std::size_t found = 0;
        for (std::size_t i = begin; i < end; ++i) {
            changes[found].module = static_cast<std::uint32_t>(i);
            found += lines.plans.rewritten[lines.letters[i]];
        }
        write_changes<whole>(lines, {changes.data(), found}, place);
    }
}

template <bool whole>
[[gnu::always_inline]] inline void write_lines(const Lines& lines, std::span<const Change> changes) {
    Place place;
    if (lines.choices)
        write_changes<whole>(lines, changes, place);
    else
        write_rewritten<whole>(lines, place);
    write_run<whole>(lines, place, lines.size);
}

ESPALIER_VECTOR_CLONES
void write_lineages(const Lines& lines, std::span<const Change> changes) {
    write_lines<true>(lines, changes);
}

ESPALIER_VECTOR_CLONES
void write_identities(const Lines& lines, std::span<const Change> changes) {
    write_lines<false>(lines, changes);
}

}  // namespace

void write_lineage(const StepInput& input, const Scratch& scratch, const Chunk& chunk, ModuleString& to) {
    const ModuleString& from = input.from;
    const Plans& plans = input.model.plans;
    const bool whole = input.ancestry == Ancestry::whole;
    const std::size_t spare = chunk.in_blocks ? spare_lineage : 0;
    const auto pair = [&](const auto& old, auto& made) {
        return Pair<typename std::decay_t<decltype(old)>::value_type>{old.data() + chunk.begin,
                                                                      made.data() + chunk.out};
    };
    Lines lines{pair(from.identities, to.identities),
                whole ? pair(from.parents, to.parents) : Pair<Identity>{},
                whole ? pair(from.births, to.births) : Pair<std::uint32_t>{},
                from.letters.data() + chunk.begin,
                from.letters.data() + from.size(),
                plans.all_known ? nullptr : scratch.choices.data() + chunk.begin,
                plans,
                input.step,
                chunk.end - chunk.begin,
                from.size() - chunk.begin + spare,
                chunk.out_end - chunk.out + spare};
    const std::span<const Change> changes(chunk.changes, chunk.changes ? chunk.change_count : 0);
    whole ? write_lineages(lines, changes) : write_identities(lines, changes);
}

}  // namespace espalier
