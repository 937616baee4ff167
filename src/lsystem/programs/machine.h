// Runs compiled programs: one machine per thread, no memory taken while it runs.
#pragma once

#include "espalier/base/random.h"

#include "lsystem/programs/column_program.h"
#include "lsystem/programs/files.h"
#include "lsystem/programs/functions.h"
#include "lsystem/programs/program.h"

#include <functional>
#include <string>
#include <vector>

namespace espalier::lsystem {

struct CompiledArray {
    std::string name;
    std::vector<std::size_t> dimensions;
    std::size_t size = 0;        ///< elements of its own
    std::vector<double> values;  ///< the first ones, as declared; the rest is 0
    bool external = false;       ///< the elements are the surrounding L-system's
};

/// A plant's memory: globals (0 = current step, 1 = derivation length) and arrays.
struct Variables {
    std::vector<double> globals;
    std::vector<std::vector<double>> arrays;
    // For an L-system inside others, by index: where its external globals and arrays are kept.
    std::vector<double*> external_globals;
    std::vector<std::vector<double>*> external_arrays;

    double& length() { return external_globals.empty() ? globals[1] : *external_globals[1]; }
};

/// What programs may ask of the derivation they run in.
struct Services {
    std::function<void(const std::string&)> print;
    /// Says once for each place what is wrong there, though the run goes on.
    std::function<void(const Place&, const std::string&)> warn;
    const Resources* resources = nullptr;  ///< null: no side files
    ModelFiles* files = nullptr;
    std::uint64_t salt = 0;  ///< what srand() or `seed:` last said
    std::uint64_t seed = 0;
    std::uint32_t plant = 0;
    bool stopped = false;
};

class Machine {
public:
    Machine(const std::vector<double>& constants, std::size_t registers, const std::vector<CompiledArray>& arrays,
            Arithmetic arithmetic);

    /// Binds the variables and services that programs see from now on.
    void attach(Variables* variables, Services* services, Stream stream) {
        variables_ = variables;
        services_ = services;
        stream_ = stream;
    }
    void sample_with(const RandomSamples& numbers) { random_ = numbers; }
    const RandomSamples& random_numbers() const { return random_; }
    /// True once after a program called srand: its stream goes on until the module is done.
    bool reseeded() const { return reseeded_; }
    void forget_reseeding() { reseeded_ = false; }

    double* formals() { return registers_.data() + first_formal_; }
    double value(std::uint32_t index) const { return registers_[index]; }
    /// Throws EvaluationError.
    void run(const Program& program);
    /// Takes random numbers of a step, and counts on those of the batch.
    bool run(const ColumnProgram& program, Batch& batch, RandomKey key, std::uint32_t step) {
        const ColumnSamples samples{key, step, batch.owners.data(), batch.numbers.data()};
        return program.run(batch.modules, batch.count, *variables_, arithmetic_, samples, columns_);
    }
    const double* result(const ColumnProgram& program, std::size_t k) const { return program.result(k, columns_); }
    /// Modules that wait, by a number that whoever makes them wait chooses.
    Batch& batch(std::size_t number) {
        if (number >= batches_.size()) batches_.resize(number + 1);
        return batches_[number];
    }
    /// No module waits any more.
    void clear_batches() {
        for (Batch& batch : batches_) batch.count = 0;
    }
    double evaluate(const Program& program) {
        run(program);
        return registers_[program.results[0]];
    }

private:
    double call(const Instruction& instruction, const Place& place);
    double* element(const Instruction& instruction, const Place& place);
    double print(const PrintCall& call, const Place& place);
    double scan(const ScanCall& call, const Place& place);
    double warn_of_file(Function function, double file, const Place& place);

    std::vector<double> registers_;
    std::vector<double> columns_;
    std::vector<Batch> batches_;
    std::size_t first_formal_;
    const std::vector<CompiledArray>& arrays_;
    Arithmetic arithmetic_;
    Variables* variables_ = nullptr;
    Services* services_ = nullptr;
    Stream stream_ = Stream::blocks;
    RandomSamples random_{RandomKey(), 0, 0};
    bool reseeded_ = false;
};

}  // namespace espalier::lsystem
