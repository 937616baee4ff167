// What tests of p-graphs share: a graph from a few lines, its mistakes, and the instances it grows.
#pragma once

#include "language/growing.h"
#include "language/pgraph/graph.h"
#include "language/pgraph/translation.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::test {

inline pgraph::Graph graph_of(const std::string& lines) {
    return pgraph::parse("pgraph 1\n" + lines, "plant.pgraph");
}

/// What is wrong with a graph: "3:5: ...", one a line. The first line of `lines` is the second of the file.
inline std::string graph_mistakes(const std::string& lines) {
    try {
        pgraph::translate(graph_of(lines));
    } catch (const UserError& error) {
        std::string result;
        for (const Diagnostic& mistake : error.diagnostics()) {
            result += (result.empty() ? "" : "\n") + std::to_string(mistake.place.line) + ":" +
                      std::to_string(mistake.place.column) + ": " + mistake.message;
        }
        return result;
    }
    return "";
}

/// The parameters of every module, by its symbol, after the last step.
inline std::map<std::string, std::vector<std::vector<double>>> instances_of(const std::string& lines) {
    Grown plant(pgraph::translate(graph_of(lines)).text);
    plant.steps(static_cast<int>(plant.derivation.length()));
    std::map<std::string, std::vector<std::vector<double>>> found;
    const Alphabet& alphabet = plant.model->alphabet;
    const std::vector<std::size_t> offsets = parameter_offsets(plant.string, alphabet);
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        const double* values = plant.string.parameters.data();
        found[alphabet.name(plant.string.letters[i])].emplace_back(values + offsets[i], values + offsets[i + 1]);
    }
    return found;
}

/// The first parameter of every instance, in order.
inline std::vector<double> first_values(const std::string& lines, const std::string& symbol) {
    std::vector<double> values;
    auto instances = instances_of(lines);
    for (const auto& parameters : instances[symbol]) values.push_back(parameters.at(0));
    return values;
}

}  // namespace espalier::test
