// A model ready to grow: productions indexed by letter, every expression a program.
#pragma once

#include "espalier/lsystem/derivation.h"

#include "lsystem/compile/choosing.h"
#include "lsystem/compile/plans.h"
#include "lsystem/programs/column_program.h"
#include "lsystem/programs/machine.h"
#include "lsystem/programs/program.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::lsystem {

struct CompiledPattern {
    LetterId letter = no_letter;
    std::uint16_t arity = 0;
    std::uint32_t first_formal = 0;
    bool skip_branch = false;

    // The pattern names a module, not a bracket that begins or ends a branch to be followed.
    bool is_ordinary_left() const { return letter > Alphabet::close_bracket; }
    bool is_ordinary_right() const { return !skip_branch && letter != Alphabet::open_bracket; }
};

/// Where the modules of a successor come from: each module that is replaced hands its identity to the first of its
/// symbol that has none, and the others are born.
struct Descent {
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// For each module that is replaced: the module that carries it on, or where the next successor begins.
    std::vector<std::uint32_t> heirs;
    std::vector<std::uint32_t> carries;  ///< for each module of the successor: which of those it carries on, or `none`
    std::vector<Birth> births;           ///< place of each among those that are born, padded to whole blocks
    std::uint32_t born = 0;

    /// The successor is what it replaces, module by module.
    bool in_place() const;
};

struct CompiledProduction {
    const Production* source = nullptr;
    std::vector<CompiledPattern> left, strict, right;  ///< left: nearest first
    Program before, condition, after, successor, weight;
    bool has_condition = false, has_weight = false;
    bool begins_with_blocks = false;  ///< condition and successor run the blocks, which stand nowhere else
    std::vector<LetterId> letters;    ///< letters of the successor, padded to whole blocks
    std::vector<std::uint16_t> arities;
    Descent descent;
    std::size_t length = 0;
    std::size_t parameters = 0;
    Lanes lanes;
    bool affine = false;  ///< `lanes` say all; else the successor's program is run, or `rest`
    /// The values that are no lanes, where some are, and their places among the successor's parameters.
    Program rest;
    std::vector<std::uint32_t> rest_places;
    // For many modules at once, where that is possible.
    std::optional<ColumnProgram> tests;   ///< the condition
    std::optional<ColumnProgram> weighs;  ///< the weight
    std::optional<ColumnProgram> values;  ///< computes `rest` or, where nothing is a lane, the successor
    bool reads_context = false;           ///< the successor needs parameters of modules in the context
    bool decomposes = false;              ///< what it writes may be decomposed
    bool writing_samples = false;         ///< after-block or successor take random numbers
    bool testing_samples = false;         ///< before-block, condition or weight take random numbers

    bool context_free() const { return left.empty() && right.empty(); }
    /// It is about one module and the nearest neighbours of that.
    bool is_of_neighbours() const {
        return strict.size() == 1 && (left.empty() || (left.size() == 1 && left[0].is_ordinary_left())) &&
               (right.empty() || (right.size() == 1 && right[0].is_ordinary_right()));
    }
};

/// Productions by the letter of their first strict module.
struct CompiledRules {
    std::vector<CompiledProduction> productions;  ///< in file order
    std::vector<std::uint32_t> candidates;        ///< productions of letter l: candidates[first[l]] to [first[l + 1]]
    std::vector<std::uint32_t> first;
    /// The production that replaces every module of a letter whatever surrounds it, -1 if none or it depends.
    std::vector<std::int32_t> always;
    /// By letter of a homomorphism: the production that is always its picture, with lanes for values and no picture in
    /// turn; null: a writer must find out.
    std::vector<const CompiledProduction*> laid_out;
    bool stochastic = false;
    bool uses_context = false;
    bool binds_context = false;
    bool several_strict = false;
    /// Letters that stand side by side in a strict predecessor, sorted.
    std::vector<std::pair<LetterId, LetterId>> joints;
    std::size_t widest = 1;  ///< modules of the longest strict predecessor
    Effects effects;
    std::size_t maximum_depth = 1;
    bool explicit_depth = false;
    bool warnings = true;
    std::optional<std::uint64_t> salt;

    bool empty() const { return productions.empty(); }
    bool has(LetterId letter) const { return first[letter] != first[letter + 1]; }
    /// Some of these productions is of a letter that the production writes.
    bool follow(const CompiledProduction& production) const {
        const auto end = production.letters.begin() + static_cast<std::ptrdiff_t>(production.length);
        return std::any_of(production.letters.begin(), end, [&](LetterId letter) { return has(letter); });
    }
    /// Choosing a production may take random numbers.
    bool deciding_samples() const {
        return stochastic ||
               std::any_of(productions.begin(), productions.end(),
                           [](const CompiledProduction& production) { return production.testing_samples; });
    }
    /// A production may replace both of two modules that stand side by side.
    bool joins(LetterId left, LetterId right) const {
        return std::binary_search(joints.begin(), joints.end(), std::pair(left, right));
    }
    /// A module of the letter may be replaced together with one before it.
    bool follows(LetterId letter) const {
        return std::any_of(joints.begin(), joints.end(), [&](const auto& joint) { return joint.second == letter; });
    }
};

/// A variable or array that the surrounding L-system lends, by name.
struct External {
    std::uint32_t index = 0;
    std::string name;
};

/// One L-system of a model.
class CompiledSystem {
public:
    const Model* source = nullptr;
    const LSystem* system = nullptr;
    std::size_t index = 0;  ///< among the model's L-systems; 0 is the main one
    CompiledRules rules, decomposition, homomorphism;
    Plans plans;  ///< plans of `rules`
    Choosing choosing;
    Program start, start_each, end_each, end;
    Program axiom, length, seed;
    std::vector<LetterId> axiom_letters;
    std::vector<CompiledArray> arrays;
    std::vector<External> external_globals, external_arrays;
    std::map<std::string, std::uint32_t> global_indices, array_indices;  ///< what it may lend
    std::vector<double> constants;
    std::size_t registers = 0;
    std::uint32_t formals = 0;
    std::vector<std::uint8_t> ignored;  ///< by letter: passed over in contexts
    bool ring = false;
    bool computes_columns = false;  ///< some production of `rules` has `values`
    bool may_cut = false;           ///< `%` can stand in the string and is no production's business
    /// Shared by all plants that grow from it: see scratch_lease.h.
    mutable tbb::enumerable_thread_specific<std::shared_ptr<Machine>> machines;

    Machine machine() const { return Machine(constants, registers, arrays, source->arithmetic); }
    /// Globals and arrays as declared, external ones not yet lent.
    Variables variables() const;
    std::size_t bytes_of_arrays() const;
    bool ordered() const {
        return rules.effects.assigns || rules.effects.ordered || decomposition.effects.assigns ||
               decomposition.effects.ordered;
    }
    /// Modules are replaced one after the other: as ordered() says, or since a predecessor may reach beyond a cut.
    bool serial() const {
        return ordered() || (may_cut && (rules.follows(Alphabet::cut) || decomposition.follows(Alphabet::cut)));
    }
    /// Two modules that stand side by side may be replaced together.
    bool joins(LetterId left, LetterId right) const {
        return rules.joins(left, right) || decomposition.joins(left, right);
    }
    bool samples() const {
        return rules.effects.samples || rules.stochastic || decomposition.effects.samples || decomposition.stochastic;
    }
    /// Pictures assign variables: their own copies of them.
    bool picture_changes() const { return homomorphism.effects.assigns || homomorphism.effects.ordered; }
    /// Pictures take random numbers, which are those of the module they are of.
    bool picture_samples() const { return homomorphism.effects.samples || homomorphism.stochastic; }
    bool uses_context() const { return rules.uses_context || decomposition.uses_context; }
    bool uses_files() const;
    bool has_arrays() const { return !arrays.empty(); }
    bool binds_context() const { return rules.binds_context || decomposition.binds_context; }
};

/// Throws RunError, with the place of the largest array, if those of so many instances take more than the memory.
void require_arrays(const CompiledSystem& system, std::size_t instances, std::size_t memory);

/// Lends `own`, the variables of `system`, what it takes from the L-system around it. Throws RunError if that has it
/// not.
void borrow(const CompiledSystem& system, Variables& own, const CompiledSystem& around, Variables& theirs);

/// The modules ?(id), ?(id, scale) and $ that hold sub-L-systems.
struct Enclosure {
    LetterId open = no_letter, open_scaled = no_letter, close = no_letter;

    bool opens(LetterId letter) const { return letter == open || letter == open_scaled; }
};

Enclosure enclosure_of(const Alphabet& alphabet);

class PictureWriter;

class CompiledModel {
public:
    std::shared_ptr<const Model> source;
    std::vector<std::unique_ptr<const CompiledSystem>> systems;
    Enclosure enclosure;
    /// The string may hold sub-L-systems.
    bool nested = false;
    // One of the L-systems does.
    bool uses_context = false, binds_context = false, samples = false, uses_files = false;
    bool has_memory = false;  ///< besides the string: arrays or files
    mutable tbb::enumerable_thread_specific<std::shared_ptr<PictureWriter>>
        picture_writers;  ///< shared by all plants that grow from it

    const CompiledSystem& main() const { return *systems.front(); }
    /// The L-system of a number; null if there is none.
    const CompiledSystem* labelled(double id) const;
    /// "1, 2 and 7", for messages.
    std::string labels() const;
    bool any(bool (CompiledSystem::*property)() const) const {
        return std::any_of(systems.begin(), systems.end(), [&](const auto& system) { return ((*system).*property)(); });
    }
};

/// Throws UserError for external variables that no other L-system can lend.
void require_lenders(const CompiledModel& model);

}  // namespace espalier::lsystem
