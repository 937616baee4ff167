#include "environment/exchange/answer_statistics.h"

#include <algorithm>
#include <limits>

namespace espalier::environment {

void AnswerStatistics::clear() {
    std::fill(totals_.begin(), totals_.end(), Totals());
}

void AnswerStatistics::add(std::uint32_t plant, double value) {
    totals_of(plant).add(value);
}

// Queries come in the order of the plants. The totals of one stay in registers, and the queries of the last one need
// not be read.
void AnswerStatistics::add(Queries queries, std::span<const Answer> answers, std::size_t index) {
    for (std::size_t i = 0; i < queries.size();) {
        const std::uint32_t plant = queries[i].plant;
        const bool is_last = plant == queries.back().plant;
        Totals totals = totals_of(plant);
        for (; i < queries.size() && (is_last || queries[i].plant == plant); ++i) {
            if (index < answers[i].size()) totals.add(answers[i][index]);
        }
        totals_of(plant) = totals;
    }
}

void AnswerStatistics::sum_up(Queries queries, std::span<const Answer> answers, std::size_t index) {
    clear();
    add(queries, answers, index);
}

AnswerStatistics::Totals& AnswerStatistics::totals_of(std::uint32_t plant) {
    if (plant >= totals_.size()) totals_.resize(plant + 1);
    return totals_[plant];
}

std::vector<Quantity> AnswerStatistics::quantities(std::uint32_t plant) const {
    const Totals totals = of(plant);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const bool asked = totals.count > 0;
    return {{"mean", asked ? totals.sum / totals.count : none},
            {"min", asked ? totals.least : none},
            {"max", asked ? totals.most : none},
            {"queries", totals.count}};
}

std::vector<Quantity> AnswerStatistics::counts(std::uint32_t plant, const char* ones, const char* zeros) const {
    const Totals totals = of(plant);
    return {{ones, totals.ones}, {zeros, totals.count - totals.ones}};
}

}  // namespace espalier::environment
