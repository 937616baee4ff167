// Queries and answers as lines of text, as cpfg exchanges them with its environment programs (Mech & Prusinkiewicz
// 1996, Visual models of plants interacting with their environment).
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/exchange/communication.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::environment {

/// The queries of a step. The address of each is its number in the step, from 0.
std::string text_of_queries(const WorldView& world, Queries queries, const Communication& communication);

/// Ends the exchange: the program is not asked again.
std::string text_of_end(int step);

/// Takes the lines of a program's answer to a step.
class AnswerReader {
public:
    AnswerReader(const WorldView& world, Queries queries, std::span<Answer> answers)
        : world_(world), queries_(queries), answers_(answers), answered_(queries.size()) {}

    /// True for the line that ends the answers. Throws RunError for a line that is no answer to a query of the step.
    bool take(std::string_view line);

private:
    void answer(std::string_view line);

    const WorldView& world_;
    Queries queries_;
    std::span<Answer> answers_;
    std::vector<bool> answered_;
};

}  // namespace espalier::environment
