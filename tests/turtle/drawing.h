// Strings written as text and drawn, for tests that need no model file.
#pragma once

#include "espalier/turtle/interpretation.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace espalier {

using namespace espalier::turtle;

/// A string and the alphabet it needs: "F(1)[+(30)F]", each character a module. A name in <> is one letter.
struct Drawing {
    Model model;
    ModuleString string;
    TurtleSettings settings;
    InterpretOptions options;
    Interpretation result;

    explicit Drawing(const std::string& text) {
        model.name = "test";
        settings.line_width = 1;
        for (std::size_t i = 0; i < text.size();) {
            std::string symbol(1, text[i++]);
            if (symbol == "<") {
                const std::size_t end = text.find('>', i);
                symbol = text.substr(i, end - i);
                i = end + 1;
            }
            std::vector<double> parameters;
            if (i < text.size() && text[i] == '(') {
                const char* at = text.c_str() + i;
                do {
                    char* end = nullptr;
                    parameters.push_back(std::strtod(at + 1, &end));
                    at = end;
                } while (*at == ',');
                i = std::size_t(at - text.c_str()) + 1;
            }
            string.append(model.alphabet.letter(symbol, int(parameters.size())), parameters);
        }
    }

    const Interpretation& draw() {
        interpret(model, *symbol_table(model), string, settings, nullptr, options, result);
        return result;
    }
    const PlantGeometry& geometry() { return draw().geometry; }

    /// The turtle's pose at the end of a string without queries.
    Pose pose() {
        Drawing asking = *this;
        asking.string.append(asking.model.alphabet.letter("?", 0));
        asking.string.append(asking.model.alphabet.letter("E", 1), std::array{0.0});
        return asking.draw().queries.at(0).pose;
    }
};

inline Pose pose_after(const std::string& text) {
    return Drawing(text).pose();
}

inline double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// How far a frame is from orthonormal with up = left x heading.
inline double frame_error(const Pose& pose) {
    double error = glm::length(pose.up - glm::cross(pose.left, pose.heading));
    error = std::max(error, std::abs(glm::length(pose.heading) - 1));
    error = std::max(error, std::abs(glm::length(pose.left) - 1));
    return std::max(error, std::abs(glm::dot(pose.heading, pose.left)));
}

}  // namespace espalier
