#include "turtle/asking.h"

#include <algorithm>

namespace espalier::turtle {

bool has_queries(const Alphabet& alphabet) {
    for (std::size_t symbol = 0; symbol < alphabet.symbol_count(); ++symbol) {
        if (alphabet.symbol_name(static_cast<SymbolId>(symbol)).starts_with('?')) return true;
    }
    return alphabet.find("s", 2) || alphabet.find("s", 3);  // the older name of ?P
}

std::span<const double> default_answer(const Model& model, const Query& query) {
    if (query.process < 0 || model.default_answers.empty()) return {};
    const auto found = model.default_answers.find(model.processes[static_cast<std::size_t>(query.process)]);
    if (found == model.default_answers.end()) return {};
    return std::span(found->second).first(std::min(found->second.size(), query.parameters.size()));
}

void write_default_answers(const Model& model, std::span<const Query> queries, ModuleString& string) {
    for (const Query& query : queries) {
        const std::span<const double> answer = default_answer(model, query);
        std::copy(answer.begin(), answer.end(),
                  string.parameters.begin() + static_cast<std::ptrdiff_t>(query.parameters_at));
    }
}

}  // namespace espalier::turtle
