// The string of modules: contiguous columns, no heap memory per module.
#pragma once

#include "espalier/base/column.h"
#include "espalier/base/stations.h"
#include "espalier/lsystem/alphabet.h"
#include "espalier/lsystem/lineage.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace espalier::lsystem {

/// Columns: one letter a module; the parameters of all modules, each owning as many as its letter's arity; and, where
/// the lineage is kept, one birth a module with the table of siblings that births point to.
struct ModuleString {
    Column<LetterId> letters;
    Column<double> parameters;
    Column<Birth> births;
    SiblingTable siblings;

    std::size_t size() const { return letters.size(); }
    bool empty() const { return letters.empty(); }
    bool has_lineage() const { return !letters.empty() && births.size() == letters.size(); }

    // These need a string that has its lineage.
    Identity identity(std::size_t module) const {
        return siblings[births[module].siblings].identity(births[module].place);
    }
    /// 0 for modules of the axiom.
    Identity parent(std::size_t module) const {
        const Siblings& born = siblings[births[module].siblings];
        return born.depth == Siblings::axiom ? 0 : born.parent;
    }
    std::uint32_t step_of_birth(std::size_t module) const { return siblings[births[module].siblings].step; }
    /// How many modules of the run were born before it, if births are numbered; else its place among its siblings.
    std::uint64_t birth_number(std::size_t module) const {
        return siblings[births[module].siblings].first_number + births[module].place;
    }

    /// Forgets the modules, keeps the memory.
    void clear();
    /// Appends one module without lineage; for building strings by hand.
    void append(LetterId letter, std::span<const double> values = {});
    /// Bytes of the modules, without the room that the columns have besides.
    std::size_t content() const;
    /// Bytes held by the columns.
    std::size_t bytes() const;
};

/// Where each module's parameters begin; size() + 1 entries.
std::vector<std::size_t> parameter_offsets(const ModuleString& string, const Alphabet& alphabet);

/// The string in cpfg's notation: symbols side by side, parameters as %g, no line breaks.
std::string to_text(const ModuleString& string, const Alphabet& alphabet);

/// Matching brackets of a string. `partner[i]` of a bracket is its other end; of any other module, the opening
/// bracket of the branch it stands in. `none` where there is no such bracket.
struct BranchLinks {
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    Column<std::uint32_t> partner;
};

/// Computes links in one pass, reusing `links`' memory. An unmatched bracket has partner `none`.
void link_branches(const ModuleString& string, BranchLinks& links);

}  // namespace espalier::lsystem
