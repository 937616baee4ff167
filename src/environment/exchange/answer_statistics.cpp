#include "environment/exchange/answer_statistics.h"

#include <algorithm>
#include <limits>

namespace espalier::environment {

void AnswerStatistics::clear() {
    std::fill(totals_.begin(), totals_.end(), Totals());
}

void AnswerStatistics::add(std::uint32_t plant, double value) {
    if (plant >= totals_.size()) totals_.resize(plant + 1);
    Totals& totals = totals_[plant];
    totals.least = totals.count == 0 ? value : std::min(totals.least, value);
    totals.most = totals.count == 0 ? value : std::max(totals.most, value);
    totals.sum += value;
    totals.count += 1;
    totals.ones += value == 1;
}

void AnswerStatistics::sum_up(std::span<const Query> queries, std::span<const Answer> answers, std::size_t index) {
    clear();
    for (std::size_t i = 0; i < queries.size(); ++i) {
        if (index < answers[i].size()) add(queries[i].plant, answers[i][index]);
    }
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
