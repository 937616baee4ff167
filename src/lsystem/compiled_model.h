// A model ready to grow: productions indexed by letter, every expression a program.
#pragma once

#include "espalier/lsystem/derivation.h"

#include "machine.h"
#include "program.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace espalier {

struct CompiledPattern {
    LetterId letter = no_letter;
    std::uint16_t arity = 0;
    std::uint32_t first_formal = 0;
    bool skip_branch = false;
};

/// A parameter of a simple successor: predecessor's parameter * scale + offset.
struct Lane {
    std::uint32_t source = 0;
    double scale = 0, offset = 0;
};

/// Where a module of a successor comes from: the strict predecessor's module it carries on, or born with a place.
struct Descent {
    static constexpr std::uint32_t born = 0xFFFFFFFF;
    std::uint32_t heir_of = born;
    std::uint32_t place = 0;
};

/// Letters are copied in blocks of this many, whether or not all belong to the successor.
inline constexpr std::size_t letter_block = 16;

struct CompiledProduction {
    const Production* source = nullptr;
    std::vector<CompiledPattern> left, strict, right;  ///< left: nearest first
    Program before, condition, after, successor, weight;
    bool has_condition = false, has_weight = false;
    std::vector<LetterId> letters;  ///< of the successor, padded to whole blocks
    std::vector<std::uint16_t> arities;
    std::vector<Descent> descents;
    std::size_t length = 0;
    std::size_t parameters = 0;
    std::vector<Lane> lanes;
    bool affine = false;         ///< `lanes` say all; else the successor's program is run
    bool reads_context = false;  ///< the successor needs parameters of modules in the context
    bool tests_draw = false;     ///< before-block, condition or weight take random numbers

    bool context_free() const { return left.empty() && right.empty(); }
};

/// Productions by the letter of their first strict module.
struct CompiledRules {
    std::vector<CompiledProduction> productions;  ///< in file order
    std::vector<std::uint32_t> candidates;        ///< productions of letter l: candidates[first[l]] to [first[l + 1]]
    std::vector<std::uint32_t> first;
    /// The production that replaces every module of a letter whatever surrounds it, -1 if none or it depends.
    std::vector<std::int32_t> always;
    bool stochastic = false;
    bool uses_context = false;
    bool binds_context = false;
    bool several_strict = false;
    Effects effects;
    std::size_t maximum_depth = 1;
    bool explicit_depth = false;
    bool warnings = true;
    std::optional<std::uint64_t> salt;

    bool empty() const { return productions.empty(); }
    bool has(LetterId letter) const { return first[letter] != first[letter + 1]; }
};

/// How one module is written: everything the hot loop reads, side by side.
struct Plan {
    enum class Kind : std::uint8_t { bare, copy, lanes, program, choose };
    std::array<LetterId, letter_block> block{};  ///< the first letters of the successor
    const LetterId* letters = nullptr;           ///< all of them
    std::uint32_t length = 0;
    std::uint32_t parameters = 0;
    const Lane* lanes = nullptr;
    const CompiledProduction* production = nullptr;  ///< null: the module is copied
    std::uint16_t arity = 0;
    Kind kind = Kind::bare;
};

struct Plans {
    std::vector<Plan> of_letter;                     ///< kind `choose` where it depends on more than the letter
    std::vector<std::uint32_t> lengths, parameters;  ///< of each letter's plan
    std::vector<Plan> productions;
    std::vector<Plan> copies;  ///< by letter
    bool all_known = true;     ///< no letter needs choosing
};

class CompiledModel {
public:
    std::shared_ptr<const Model> source;
    CompiledRules rules, decomposition, homomorphism;
    Plans plans;  ///< of `rules`
    Program start, start_each, end_each, end;
    Program axiom, length, seed;
    std::vector<LetterId> axiom_letters;
    std::vector<CompiledArray> arrays;
    std::vector<double> constants;
    std::size_t registers = 0;
    std::uint32_t formals = 0;
    std::vector<std::uint8_t> ignored;  ///< by letter: passed over in contexts
    bool ring = false;
    bool may_cut = false;  ///< `%` can stand in the string and is no production's business

    Machine machine() const { return Machine(constants, registers, arrays, source->quirks); }
    bool ordered() const {
        return rules.effects.assigns || rules.effects.ordered || decomposition.effects.assigns ||
               decomposition.effects.ordered;
    }
    bool draws() const {
        return rules.effects.draws || rules.stochastic || decomposition.effects.draws || decomposition.stochastic;
    }
    /// Pictures take random numbers, which are those of the module they are of.
    bool picture_draws() const { return homomorphism.effects.draws || homomorphism.stochastic; }
};

}  // namespace espalier
