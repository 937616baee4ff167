// Who the modules of the new string are, who bore them, and when.
#include "base/vector_clones.h"
#include "lsystem/derive/writing.h"

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
    const Plans& plans;
    std::uint32_t step;
    std::size_t begin;    ///< of the chunk's part of the old columns
    std::size_t modules;  ///< of the chunk
    std::size_t size;     ///< of the chunk's part of the columns
    std::size_t known;    ///< of the old columns
    std::size_t room;     ///< for the chunk's part of the new ones

    const Plan& plan(const Change& change) const {
        if (!plans.all_known) return plans.choices[change.plan];
        const LetterId* const at = letters + (change.module - begin);
        return spelled_plan(plans.of_letter[*at], at, letters_end);
    }
    /// Calls copy(column) for what is kept: identities or parents and births, too.
    template <Ancestry kept, class Copy>
    void for_each_column(const Copy& copy) const {
        copy(identities);
        if constexpr (kept == Ancestry::whole) {
            copy(parents);
            copy(births);
        }
    }
};

// What follows is compiled anew for each width of vectors.

/// Where lineage is read and written, counted in identities.
struct Place {
    std::size_t module = 0, at = 0;
};

template <Ancestry kept>
[[gnu::always_inline]] inline void write_run(const Lines& lines, Place& place, std::size_t end) {
    const std::size_t module = place.module, at = place.at;
    const std::size_t count = end - module;
    if (end + lineage_block <= lines.known && at + count + lineage_block <= lines.room)
        lines.for_each_column<kept>([&](const auto& column) { column.copy_run(module, at, count); });
    else
        lines.for_each_column<kept>([&](const auto& column) { column.copy_exactly(module, at, count); });
    place = {end, at + count};
}

template <Ancestry kept>
[[gnu::always_inline]] inline void write_brood(const Lines& lines, const Kin& kin, const Place& place) {
    constexpr bool whole = kept == Ancestry::whole;
    if (kept == Ancestry::drawers && kin.length == 0) return;
    const std::size_t module = place.module, at = place.at;
    const Identity parent = lines.identities.from[module];
    const Brood brood(parent, lines.step);
    const std::uint32_t* const places = kin.places.data();
    Identity* const born = lines.identities.to + at;
    if (at + kin.length + lineage_block <= lines.room) {
        for (std::size_t begin = 0; begin < kin.length; begin += lineage_block) {
            for (std::size_t k = begin; k < begin + lineage_block; ++k) born[k] = brood.born(places[k]);
            if constexpr (whole) {
                lines.parents.fill_block(at + begin, parent);
                lines.births.fill_block(at + begin, lines.step);
            }
        }
    } else {
        for (std::size_t k = 0; k < kin.length; ++k) {
            born[k] = brood.born(places[k]);
            if constexpr (whole) {
                lines.parents.to[at + k] = parent;
                lines.births.to[at + k] = lines.step;
            }
        }
    }
    // All but the heirs are born now; heirs are put over them.
    for (std::size_t s = 0; s < kin.heirs.size(); ++s) {
        if (kin.heirs[s] == Descent::none) continue;
        lines.for_each_column<kept>([&](const auto& column) { column.copy(module + s, at + kin.heirs[s]); });
    }
}

/// Of modules that change, and of what lives on before them.
template <Ancestry kept>
[[gnu::always_inline]] inline void write_changes(const Lines& lines, std::span<const Change> changes, Place& place) {
    constexpr bool drawers = kept == Ancestry::drawers;
    std::size_t replaced = drawers ? 0 : lines.begin + place.module;  // modules before this one
    for (const Change& change : changes) {
        if (change.module < replaced) continue;  // replaced with one before it
        const Plan& plan = lines.plan(change);
        if (!plan.production) continue;  // it lives on after all
        replaced = change.module + plan.width;
        const Kin& kin = drawers ? plan.production->drawers : plan.production->kin;
        if (kin.same) continue;
        const std::size_t begin = (drawers ? change.drawers() : change.module) - lines.begin;
        if (begin > place.module) write_run<kept>(lines, place, begin);
        write_brood<kept>(lines, kin, place);
        place.module += drawers ? plan.read_drawers : plan.width;
        place.at += drawers ? plan.drawers : plan.length;
    }
}

/// The same where the letters alone say what changes.
template <Ancestry kept>
[[gnu::always_inline]] inline void write_rewritten(const Lines& lines, Place& place) {
    std::array<Change, 256> changes;
    for (std::size_t begin = 0; begin < lines.modules; begin += changes.size()) {
        const std::size_t end = std::min(begin + changes.size(), lines.modules);
        std::size_t found = 0;
        for (std::size_t i = begin; i < end; ++i) {
            changes[found].module = static_cast<std::uint32_t>(lines.begin + i);
            found += lines.plans.rewritten[lines.letters[i]];
        }
        write_changes<kept>(lines, {changes.data(), found}, place);
    }
}

template <Ancestry kept>
[[gnu::always_inline]] inline void write_lines(const Lines& lines, std::span<const Change> changes) {
    Place place;
    if (!lines.plans.all_known)
        write_changes<kept>(lines, changes, place);
    else
        write_rewritten<kept>(lines, place);
    write_run<kept>(lines, place, lines.size);
}

ESPALIER_VECTOR_CLONES
void write_lineages(const Lines& lines, std::span<const Change> changes) {
    write_lines<Ancestry::whole>(lines, changes);
}

/// Of changes that were found already.
ESPALIER_VECTOR_CLONES
void write_found_lineages(const Lines& lines, std::span<const Change> changes) {
    Place place;
    write_changes<Ancestry::whole>(lines, changes, place);
    write_run<Ancestry::whole>(lines, place, lines.size);
}

ESPALIER_VECTOR_CLONES
void write_identities(const Lines& lines, std::span<const Change> changes) {
    write_lines<Ancestry::identities>(lines, changes);
}

ESPALIER_VECTOR_CLONES
void write_drawers(const Lines& lines, std::span<const Change> changes) {
    write_lines<Ancestry::drawers>(lines, changes);
}

}  // namespace

void write_lineage(const Plans& plans, std::span<const Change> changes, const ModuleString& from, std::uint32_t step,
                   ModuleString& to) {
    const auto pair = [](const auto& old, auto& made) {
        return Pair<typename std::decay_t<decltype(old)>::value_type>{old.data(), made.data()};
    };
    const Lines lines{pair(from.identities, to.identities),
                      pair(from.parents, to.parents),
                      pair(from.births, to.births),
                      from.letters.data(),
                      from.letters.data() + from.size(),
                      plans,
                      step,
                      0,
                      from.size(),
                      from.size(),
                      from.size() + spare_lineage,
                      to.size() + spare_lineage};
    write_found_lineages(lines, changes);
}

void write_lineage(const StepInput& input, const Chunk& chunk, ModuleString& to) {
    const ModuleString& from = input.from;
    const Plans& plans = input.model.plans;
    const bool whole = input.ancestry == Ancestry::whole, drawers = input.ancestry == Ancestry::drawers;
    const std::size_t begin = drawers ? chunk.drawers_at : chunk.begin, end = drawers ? chunk.drawers_end : chunk.end;
    const std::size_t out = drawers ? chunk.out_drawers : chunk.out;
    const std::size_t out_end = drawers ? chunk.out_drawers_end : chunk.out_end;
    const std::size_t spare = chunk.in_blocks ? spare_lineage : 0;
    const auto pair = [&](const auto& old, auto& made) {
        return Pair<typename std::decay_t<decltype(old)>::value_type>{old.data() + begin, made.data() + out};
    };
    const Lines lines{pair(from.identities, to.identities),
                      whole ? pair(from.parents, to.parents) : Pair<Identity>{},
                      whole ? pair(from.births, to.births) : Pair<std::uint32_t>{},
                      from.letters.data() + chunk.begin,
                      from.letters.data() + from.size(),
                      plans,
                      input.step,
                      begin,
                      chunk.end - chunk.begin,
                      end - begin,
                      from.identities.size() - begin + spare,
                      out_end - out + spare};
    const std::span<const Change> changes(chunk.changes, chunk.changes ? chunk.change_count : 0);
    if (whole)
        write_lineages(lines, changes);
    else
        drawers ? write_drawers(lines, changes) : write_identities(lines, changes);
}

}  // namespace espalier
