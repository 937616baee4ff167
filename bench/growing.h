// Growing a model again and again in reused memory, and the trees that several benchmarks share.
#pragma once

#include "lsystem/model_builder.h"
#include "table.h"

#include <tbb/global_control.h>

#include <benchmark/benchmark.h>

namespace espalier::bench {

/// What is counted: the modules of every new string, or those of every string that was read.
enum class Counts { written, visits };

struct Growing {
    int steps = 0;
    bool lineage = false;
    Counts counts = Counts::written;
};

/// With as many threads as the benchmark's argument says.
void derive(benchmark::State& state, test::ModelBuilder& model, const Growing& growing);

/// Copies the string of every step as often into memory that is there: what deriving it would take if nothing but its
/// bytes counted.
void copy(benchmark::State& state, test::ModelBuilder& model, const Growing& growing);

/// A plant without parameters: 24 modules of 100 draw, 32 are brackets.
void make_bare_plant(test::ModelBuilder& model);

/// Honda's monopodial tree (ABOP figure 2.6): A(l, w), B(l, w), C(l, w).
void make_honda(test::ModelBuilder& model);

/// A bush whose apices have conditions, random numbers and powers: what most parametric models are made of. Variables
/// that its blocks assign are each module's own.
void make_bush(test::ModelBuilder& model, bool blocks);

inline tbb::global_control threads(const benchmark::State& state) {
    return {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(state.range(0))};
}

}  // namespace espalier::bench
