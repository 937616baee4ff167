// How modules are written: everything the writing pass reads, side by side.
#pragma once

#include "espalier/lsystem/module_string.h"

#include <array>
#include <cstdint>
#include <vector>

namespace espalier {

/// What a choice makes of a string, beyond what there was.
struct Growth {
    std::int64_t modules = 0, parameters = 0;
    std::int64_t drawers = 0;  ///< modules of letters that come to draw
    std::int64_t ahead = 0;    ///< changes that are foreseen

    Growth& operator+=(const Growth& more) {
        modules += more.modules;
        parameters += more.parameters;
        drawers += more.drawers;
        ahead += more.ahead;
        return *this;
    }
};

struct CompiledProduction;
class CompiledSystem;

// What is written is copied in whole blocks, whether or not all of a block belongs to it: the next module overwrites
// what is too much.
inline constexpr std::size_t letter_block = 16;
inline constexpr std::size_t value_block = 4;
inline constexpr std::size_t run_value_block = 8;
inline constexpr std::size_t lineage_block = 8;

/// What columns have room for behind their last element, so that the last modules are read and written in whole blocks,
/// too, as those of small strings all are.
inline constexpr std::size_t spare_letters = letter_block, spare_values = run_value_block,
                             spare_lineage = lineage_block;

/// Modules that one thread writes before another may have its turn: at least so many of the old string or the new.
inline constexpr std::size_t grain = 8192;
/// The longest stretch of a new string whose future is added up in one number, but for one successor.
inline constexpr std::size_t longest_stretch = 2 * grain;

constexpr std::size_t whole_blocks(std::size_t count, std::size_t block) {
    return (count + block - 1) / block * block;
}

/// A parameter of a simple successor: predecessor's parameter * scale + offset.
struct Lane {
    std::uint32_t source = 0;
    double scale = 0, offset = 0;
};

/// The lanes of a successor, in columns padded to whole blocks with lanes whose value is 0.
struct Lanes {
    std::vector<std::uint32_t> sources;
    std::vector<double> scales, offsets;

    void push_back(const Lane& lane);
    void pad();
};

/// A module that does not simply live on.
struct Change {
    /// By the modules of the string before it (Plans::holdings; of parameters the last 32 bits of their number).
    std::uint64_t held;
    std::uint32_t module;
    std::uint32_t plan;  ///< among Plans::choices; the module's place in the table of choices until that is known

    std::uint32_t parameters() const { return static_cast<std::uint32_t>(held >> 32); }
    std::uint32_t drawers() const { return static_cast<std::uint32_t>(held); }
};

struct alignas(64) Plan {
    enum class Kind : std::uint8_t {
        copy,       ///< the module itself, with at most `value_block` parameters
        wide_copy,  ///< the same with more
        bare,       ///< letters without parameters
        lanes,      ///< `lanes` say all parameters
        mixed,      ///< `lanes` say some, the production's program `rest` the others
        program,    ///< the production's programs are run
        choose,     ///< depends on more than the letter
        spelled,    ///< depends on the letter and those behind it: spelled_plan() tells it
    };
    std::array<LetterId, letter_block> block{};  ///< the first letters of the successor
    std::uint32_t length = 0;
    std::uint32_t parameters = 0;
    std::uint16_t arity = 0;
    Kind kind = Kind::bare;
    std::uint16_t width = 1;                      ///< modules that are replaced
    std::uint32_t reads = 0;                      ///< parameters of all modules that are replaced
    LetterId second = no_letter;                  ///< of the modules that are replaced, if they are several
    LetterId productions = 0;                     ///< among `choices`, from the second on
    std::uint32_t drawers = 0, read_drawers = 0;  ///< modules of letters that come to draw: written, and replaced
    /// Modules and (from bit 32 on) parameters that will replace what this plan writes, where no letter needs choosing.
    std::uint64_t next = 0;
    const Lanes* lanes = nullptr;

    const LetterId* letters = nullptr;               ///< all of them, padded to whole blocks
    const CompiledProduction* production = nullptr;  ///< null: the module is copied
    /// Of a letter: the plan that is known or the copy; if it is to be chosen, the productions in file order.
    const Plan* choices = nullptr;
    /// Where changes are foreseen: those of what this plan writes, counted from its beginning.
    const Change* ahead = nullptr;
    std::uint32_t ahead_count = 0;

    bool inherits = false;  ///< the production's kin is the same (Kin::same)

    bool depends() const { return kind == Kind::choose || kind == Kind::spelled; }
    std::uint64_t held_before() const { return std::uint64_t{reads} << 32 | read_drawers; }
    std::uint64_t held_after() const { return std::uint64_t{parameters} << 32 | drawers; }
};

/// Three numbers in one: parameters that a plan reads, modules and parameters that it writes. Those of a small string's
/// letters can be added up.
struct PackedSizes {
    static constexpr std::uint64_t most = 1024;  ///< letters of a string, and each number of a letter
    static constexpr int bits = 21;
    static constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    static constexpr std::uint64_t unknown = (most + 1) << bits;  ///< of a letter: makes any sum too large
    static_assert(most * (most + 1) <= mask);

    static std::uint64_t pack(std::uint64_t reads, std::uint64_t modules, std::uint64_t parameters) {
        return reads | modules << bits | parameters << 2 * bits;
    }
};

struct Plans {
    std::vector<Plan> of_letter;
    std::vector<std::uint32_t> lengths, parameters;  ///< of each letter's plan
    std::vector<std::uint8_t> rewritten;             ///< by letter: its module may not live on as who it is
    /// By letter what its module has: whether it comes to draw, and (from bit 32 on) parameters.
    std::vector<std::uint64_t> holdings;
    /// By letter PackedSizes of its plan, where that depends on nothing else and runs no program.
    std::vector<std::uint64_t> sizes;
    bool draws = false;           ///< some letter comes to draw
    std::vector<Plan> choices;    ///< of all letters, one after the other
    bool all_known = true;        ///< no letter needs choosing: letters tell all
    bool spelled = false;         ///< some of them only with those behind them
    bool looks_ahead = false;     ///< Plan::next is known
    bool foresees = false;        ///< Plan::ahead is
    std::vector<Growth> growths;  ///< of choices
    std::vector<Change> ahead;    ///< of all choices
    // The most that any plan reads and writes.
    std::size_t longest = 1, most_parameters = 0, most_read = 0;

    bool valued() const { return most_read + most_parameters > 0; }
};

/// The plans of `model.rules`, which must stay where they are.
Plans make_plans(const CompiledSystem& model);

/// True if letters from the third on of what the plan replaces stand at `letters`.
bool spells_rest(const Plan& plan, const LetterId* letters);

/// The plan of the first of some letters, whose own is `plan`, where letters tell it.
inline const Plan& spelled_plan(const Plan& plan, const LetterId* letters, const LetterId* end) {
    if (plan.kind != Plan::Kind::spelled) return plan;
    for (LetterId k = 1; k <= plan.productions; ++k) {
        const Plan& choice = plan.choices[k];
        const bool stands = choice.width == 1 || (end - letters >= choice.width && letters[1] == choice.second &&
                                                  (choice.width == 2 || spells_rest(choice, letters)));
        if (stands) return choice;
    }
    return plan.choices[0];
}

}  // namespace espalier
