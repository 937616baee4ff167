// Measures the rows of the table: the two sides of a row in turns, so that what disturbs the machine disturbs both.
#pragma once

#include "table.h"

#include <benchmark/benchmark.h>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace espalier::bench {

/// The best of a benchmark's repetitions: what disturbs a machine only ever slows it.
struct Best {
    int repetitions = 0;
    double seconds = 0;                         ///< of one iteration; the least
    double rate = 0;                            ///< items per second; the most
    std::map<std::string, double> least, most;  ///< of the benchmark's own counters

    void note(const benchmark::BenchmarkReporter::Run& run);
};

/// A row and what was found.
struct Measured {
    const Row* row = nullptr;
    Best work, yardstick;
    Best divisible, divided;      ///< for a speedup: work that divides without loss, on one thread and on two
    std::size_t peak_memory = 0;  ///< of the process while this row was measured, bytes

    /// NaN if a side is missing or failed.
    double figure() const;
    bool reached() const;
};

/// Measures one row for about so many seconds, less if its bests stand still; every side at least once.
Measured measure(const Row& row, double seconds);

/// The benchmarks that Google Benchmark's own options choose, with its own output, and the rows they fill.
std::vector<Measured> measure_chosen_by_google_benchmark();

/// Makes the allocator keep what is freed, as it does in a program that has run for a while: whether a benchmark comes
/// first or last must not matter to it.
void warm_up_allocator();

}  // namespace espalier::bench
