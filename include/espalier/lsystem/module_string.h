// The string of modules: contiguous columns, no heap memory per module.
#pragma once

#include "espalier/base/column.h"
#include "espalier/lsystem/alphabet.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace espalier {

/// A module's name for life: a hash of its parent's identity, the step of its birth and its place among its siblings.
using Identity = std::uint64_t;

/// Columns: one letter a module; the parameters of all modules, each owning as many as its letter's arity; and, only
/// where something reads them, identities (of all, or of who may come to draw), or with parents' and steps of birth.
struct ModuleString {
    Column<LetterId> letters;
    Column<double> parameters;
    Column<Identity> identities;
    Column<Identity> parents;
    Column<std::uint32_t> births;

    std::size_t size() const { return letters.size(); }
    bool empty() const { return letters.empty(); }
    bool has_identities() const { return !letters.empty() && identities.size() == letters.size(); }
    bool has_lineage() const {
        return has_identities() && parents.size() == letters.size() && births.size() == letters.size();
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

}  // namespace espalier
