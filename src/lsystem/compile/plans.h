// What replaces modules: everything that writing reads, side by side.
#pragma once

#include "espalier/lsystem/module_string.h"

#include <array>
#include <cstdint>
#include <vector>

namespace espalier::lsystem {

struct CompiledProduction;
class CompiledSystem;

/// How many modules, parameters, and rows of siblings.
struct Extent {
    std::size_t modules = 0, parameters = 0, siblings = 0;

    Extent& operator+=(const Extent& more) {
        modules += more.modules;
        parameters += more.parameters;
        siblings += more.siblings;
        return *this;
    }
};

// Successors are copied in whole blocks, whether or not all of a block belongs to them: the next module overwrites what
// is too much.
inline constexpr std::size_t letter_block = 16;
inline constexpr std::size_t value_block = 4;
inline constexpr std::size_t run_value_block = 8;
inline constexpr std::size_t birth_block = 8;

/// What columns have room for behind their last element, so that the last modules are read and written in whole blocks,
/// too, as those of small strings all are.
inline constexpr std::size_t spare_letters = letter_block, spare_values = run_value_block, spare_births = birth_block;

/// Modules that one thread rewrites before another may have its turn.
inline constexpr std::size_t grain = 8192;

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

/// What replaces a module, or several.
struct alignas(64) Plan {
    enum class Kind : std::uint8_t {
        copy,     ///< the module itself
        bare,     ///< letters without parameters
        lanes,    ///< `lanes` say all parameters
        mixed,    ///< `lanes` say some, the production's program `rest` the others
        program,  ///< the production's programs are run
    };
    std::array<LetterId, letter_block> block{};  ///< the first letters of the successor
    std::uint32_t length = 0;
    std::uint32_t parameters = 0;
    std::uint32_t reads = 0;  ///< parameters of all modules that are replaced
    std::uint16_t width = 1;  ///< modules that are replaced
    Kind kind = Kind::copy;
    bool bears = false;  ///< some modules of the successor are born
    bool moves = false;  ///< the successor is not one module that carries on the one it replaces
    const Lanes* lanes = nullptr;
    const LetterId* letters = nullptr;               ///< all of them, padded to whole blocks
    const CompiledProduction* production = nullptr;  ///< null: the module is copied
};

/// By letter, where the letter alone says what becomes of a module: modules, parameters and siblings that are written,
/// and parameters that are read, in one number, so that those of many modules can be added up.
struct PackedSizes {
    static constexpr int bits = 16;
    static constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    static constexpr int flag_bits = 8;  ///< for siblings, and for letters that are not simple: they share a field
    static constexpr std::uint64_t flag_mask = (std::uint64_t{1} << flag_bits) - 1;
    static constexpr std::size_t most_at_once = flag_mask;

    std::vector<std::uint64_t> of_letter;
    std::size_t at_once = 0;  ///< modules whose sizes can be added up; 0: not even those of one

    struct Sum {
        Extent becomes;
        std::size_t reads = 0;  ///< parameters
        bool simple = true;     ///< every letter alone decides, and no program is run
    };
    static std::uint64_t pack(const Plan& plan, bool simple);
    static Sum unpack(std::uint64_t sum) {
        const auto field = [&](int k) { return static_cast<std::size_t>(sum >> k * bits & mask); };
        return {
            {field(0), field(1), static_cast<std::size_t>(field(3) & flag_mask)}, field(2), field(3) >> flag_bits == 0};
    }
    /// Adds up at most `at_once` modules.
    Sum add_up(const LetterId* letters, std::size_t count) const {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += of_letter[letters[i]];
        return unpack(sum);
    }
};

/// What a scan of the string needs of a letter.
struct Lookup {
    std::uint32_t arity = 0;
    std::uint32_t replaced = 0;  ///< 1: a production applies, or may apply
};

struct Plans {
    /// Plans of all letters, one after the other: the copy, then the letter's productions in file order.
    std::vector<Plan> choices;
    std::vector<std::uint32_t> first;  ///< by letter: its first choice
    std::vector<std::uint32_t> known;  ///< by letter: the choice that the letter decides, else the copy
    std::vector<Lookup> lookups;       ///< by letter
    bool all_known = true;             ///< letters alone decide: no module needs choosing
    PackedSizes sizes;                 ///< sizes of known choices
    // The most that any plan reads and writes.
    std::size_t longest = 1, most_parameters = 0, most_read = 0;

    bool valued() const { return most_read + most_parameters > 0; }
    const Plan& of_letter(LetterId letter) const { return choices[known[letter]]; }
};

/// The plans of `system.rules`, which must stay where they are.
Plans make_plans(const CompiledSystem& system);

}  // namespace espalier::lsystem
