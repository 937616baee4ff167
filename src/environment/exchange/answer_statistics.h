// Sums of the answers that each plant got: what most processes report in statistics.csv.
#pragma once

#include "espalier/environment/environment_process.h"

#include <algorithm>
#include <span>
#include <vector>

namespace espalier::environment {

class AnswerStatistics {
public:
    explicit AnswerStatistics(std::uint32_t plants) : totals_(plants) {}

    void clear();
    void add(std::uint32_t plant, double value);
    /// Parameter `index` of every answer that has it. Queries in the order of the plants.
    void add(Queries queries, std::span<const Answer> answers, std::size_t index = 0);
    /// The same, after clear.
    void sum_up(Queries queries, std::span<const Answer> answers, std::size_t index = 0);

    /// mean, min, max and queries of one plant; but for the queries, NaN where it asked nothing.
    std::vector<Quantity> quantities(std::uint32_t plant) const;
    /// For answers of 1 and 0: how many of each, under these names.
    std::vector<Quantity> counts(std::uint32_t plant, const char* ones, const char* zeros) const;

private:
    struct Totals {
        double sum = 0, count = 0, least = 0, most = 0, ones = 0;

        void add(double value) {
            least = count == 0 ? value : std::min(least, value);
            most = count == 0 ? value : std::max(most, value);
            sum += value;
            count += 1;
            ones += value == 1;
        }
    };
    Totals& totals_of(std::uint32_t plant);
    Totals of(std::uint32_t plant) const { return plant < totals_.size() ? totals_[plant] : Totals(); }

    std::vector<Totals> totals_;
};

}  // namespace espalier::environment
