// Programs that only compute values, run for many modules of one production side by side. A module for which the
// program has jumped ahead keeps its values until it is there.
#pragma once

#include "espalier/base/random.h"

#include "lsystem/programs/program.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace espalier::lsystem {

struct Variables;

/// Whose random numbers a program takes.
struct ColumnSamples {
    RandomKey key;
    std::uint32_t step = 0;
    const std::uint64_t* owners = nullptr;  ///< of each module
    std::uint32_t* numbers = nullptr;       ///< of each module: that of its next sample
};

class ColumnProgram {
public:
    /// Modules at once.
    static constexpr std::size_t lanes = 128;

    struct Step {
        Instruction instruction;  ///< with columns for registers
        bool is_skipped;          ///< some modules may have jumped over it
        bool may_divide_by_zero;
    };

    /// Whose parameters a program reads: the module's that is replaced, or its nearest neighbours'.
    enum Whose : std::uint8_t { own, left, right };
    static constexpr std::size_t whose_count = 3;
    /// Where the parameters of each of `lanes` modules begin; of neighbours only where a program reads them.
    using Modules = std::array<std::array<const double*, lanes>, whose_count>;

    /// Where a formal stands among whose parameters; nothing if it belongs to another module.
    struct Source {
        Whose whose;
        std::uint32_t place;
    };
    using Place = std::function<std::optional<Source>(std::uint32_t formal)>;

    /// Nothing if the program cannot be run in columns. Its registers have their numbers.
    static std::optional<ColumnProgram> make(const Program& program, std::span<const double> constants,
                                             std::uint32_t formals, const Place& place);

    /// Runs the program for `count` modules. `columns` is memory to work in. False if one of them divides by zero where
    /// that is an error, or has no random number: running it for each alone says which.
    bool run(const Modules& modules, std::size_t count, const Variables& variables, Arithmetic arithmetic,
             const ColumnSamples& samples, std::vector<double>& columns) const;
    /// The values of a result, one a module, where `run` left them.
    const double* result(std::size_t k, const std::vector<double>& columns) const {
        return columns.data() + std::size_t{results_[k]} * lanes;
    }
    std::size_t results() const { return results_.size(); }

private:
    struct Constant {
        std::uint32_t column;
        double value;
    };
    struct Input {
        std::uint32_t column;
        Source source;
    };

    std::vector<Step> steps_;
    bool jumps_ = false;
    std::vector<Constant> constants_;
    std::vector<Input> inputs_;
    std::vector<std::uint32_t> results_;
    std::size_t width_ = 0;  ///< columns; behind them, if it jumps, where each module goes on
};

/// Modules that wait until a column program is run for all of them.
struct Batch {
    std::size_t count = 0;
    ColumnProgram::Modules modules;
    std::array<double*, ColumnProgram::lanes> to;             ///< where their successors' parameters begin
    std::array<std::uint64_t, ColumnProgram::lanes> owners;   ///< whose random numbers are taken, where some are
    std::array<std::uint32_t, ColumnProgram::lanes> numbers;  ///< numbers of the next ones
    std::array<std::uint32_t, ColumnProgram::lanes> places;   ///< among what waits
};

}  // namespace espalier::lsystem
