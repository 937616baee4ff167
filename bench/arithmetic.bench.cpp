// The elementary functions that are the same everywhere, beside those of the C library, which are not.
#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include "base/math_columns.h"
#include "table.h"

#include <benchmark/benchmark.h>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace espalier::bench {
namespace {

constexpr std::size_t count = 4096;  // fits in the first-level cache

std::vector<double> arguments(double low, double high, std::uint64_t salt) {
    std::vector<double> values;
    for (std::uint64_t k = 0; k < count; ++k) {
        values.push_back(low + (high - low) * static_cast<double>(mix(k, salt) >> 11) * 0x1p-53);
    }
    return values;
}

struct Function {
    std::string name;
    double low, high;  ///< of its arguments; the second of two lies between -3 and 3
    double (*ours)(double, double);
    double (*library)(double, double);
    void (*column)(std::span<const double>, std::span<const double>, double*);
    double column_limit;
};

using Columns = std::span<const double>;

const std::vector<Function>& functions() {
    static const std::vector<Function> all{
        {"pow", 0.01, 5, math::any_power, [](double x, double y) { return std::pow(x, y); },
         [](Columns x, Columns y, double* to) { math::pow(x, y, to); }, 1},
        {"exp", -20, 20, [](double x, double) { return math::exp(x); }, [](double x, double) { return std::exp(x); },
         [](Columns x, Columns, double* to) { math::exp(x, to); }, 0.5},
        {"log", 1e-9, 100, [](double x, double) { return math::log(x); }, [](double x, double) { return std::log(x); },
         [](Columns x, Columns, double* to) { math::log(x, to); }, 0.7},
        {"sin", -30, 30, [](double x, double) { return math::sin(x); }, [](double x, double) { return std::sin(x); },
         [](Columns x, Columns, double* to) { math::sin(x, to); }, 0.5},
        {"cos", -30, 30, [](double x, double) { return math::cos(x); }, [](double x, double) { return std::cos(x); },
         [](Columns x, Columns, double* to) { math::cos(x, to); }, 0.5},
        {"atan2", -3, 3, math::atan2, [](double y, double x) { return std::atan2(y, x); },
         [](Columns y, Columns x, double* to) { math::atan2(y, x, to); }, 0.5},
    };
    return all;
}

void measure(benchmark::State& state, const Function& function, double (*one)(double, double)) {
    const std::vector<double> x = arguments(function.low, function.high, 1), y = arguments(-3, 3, 2);
    for (auto _ : state) {
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += one(x[k], y[k]);
        benchmark::DoNotOptimize(sum);
    }
    state.SetItemsProcessed(state.iterations() * count);
}

void measure_column(benchmark::State& state, const Function& function) {
    const std::vector<double> x = arguments(function.low, function.high, 1), y = arguments(-3, 3, 2);
    std::vector<double> results(count);
    for (auto _ : state) {
        function.column(x, y, results.data());
        benchmark::DoNotOptimize(results.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * count);
}

const bool are_rows = [] {
    for (const Function& function : functions()) {
        const std::string ours = function.name + "_of_one", library = function.name + "_of_the_c_library",
                          column = function.name + "_of_a_column";
        benchmark::RegisterBenchmark(ours.c_str(), measure, std::cref(function), function.ours)->UseRealTime();
        benchmark::RegisterBenchmark(library.c_str(), measure, std::cref(function), function.library)->UseRealTime();
        benchmark::RegisterBenchmark(column.c_str(), measure_column, std::cref(function))->UseRealTime();
        const std::string end = "/real_time";
        Row(function.name + "() of one number, against the C library", ours + end, library + end,
            Row::Measure::time_per_item, Row::Goal::at_most, 1.5);
        Row(function.name + "() of a column, against the C library", column + end, library + end,
            Row::Measure::time_per_item, Row::Goal::at_most, function.column_limit);
    }
    return true;
}();

}  // namespace
}  // namespace espalier::bench
