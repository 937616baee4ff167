// What tests of models measure: parameters of modules, directions, spreads.
#pragma once

#include "espalier/geometry/plant_geometry.h"
#include "espalier/lsystem/lsystem.h"
#include "espalier/lsystem/module_string.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace espalier {

/// The parameters of every module of one symbol, in the order of the string.
inline std::vector<std::vector<double>> parameters_of(const ModuleString& string, const Alphabet& alphabet,
                                                      const std::string& symbol) {
    std::vector<std::vector<double>> found;
    const std::vector<std::size_t> offsets = parameter_offsets(string, alphabet);
    for (std::size_t i = 0; i < string.size(); ++i) {
        if (alphabet.name(string.letters[i]) != symbol) continue;
        found.emplace_back(string.parameters.data() + offsets[i], string.parameters.data() + offsets[i + 1]);
    }
    return found;
}

/// The n-th parameter (counted from 0) of every module of one symbol.
inline std::vector<double> values_of(const ModuleString& string, const Alphabet& alphabet, const std::string& symbol,
                                     std::size_t n = 0) {
    std::vector<double> values;
    for (const auto& parameters : parameters_of(string, alphabet, symbol)) values.push_back(parameters.at(n));
    return values;
}

/// The modules' symbols in order, without parameters.
inline std::vector<std::string> symbols_of(const ModuleString& string, const Alphabet& alphabet) {
    std::vector<std::string> symbols;
    for (LetterId letter : string.letters) symbols.push_back(alphabet.name(letter));
    return symbols;
}

inline double length_of(const Internode& internode) {
    return glm::distance(internode.base, internode.tip);
}

inline glm::dvec3 direction_of(const Internode& internode) {
    return glm::normalize(internode.tip - internode.base);
}

/// Degrees between two directions, exact for small angles too.
inline double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

/// For every internode the internodes that begin where it ends.
inline std::vector<std::vector<std::size_t>> children_of(const PlantGeometry& geometry) {
    std::vector<std::vector<std::size_t>> children(geometry.internodes.size());
    for (std::size_t i = 0; i < children.size(); ++i) {
        for (std::size_t j = i + 1; j < children.size(); ++j) {
            if (glm::distance(geometry.internodes[i].tip, geometry.internodes[j].base) < 1e-12) {
                children[i].push_back(j);
            }
        }
    }
    return children;
}

inline double mean_of(const std::vector<double>& values) {
    double sum = 0;
    for (double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

inline double deviation_of(const std::vector<double>& values) {
    const double mean = mean_of(values);
    double sum = 0;
    for (double value : values) sum += (value - mean) * (value - mean);
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace espalier
