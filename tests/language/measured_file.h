// Shared by the tests of measured plants: what a text in a notation holds.
#pragma once

#include "espalier/language/measured_plants.h"
#include "espalier/language/notation.h"

#include "catch.h"

#include <glm/geometric.hpp>

#include <string>

namespace espalier {

/// A text in one notation of measured plants.
struct MeasuredText {
    std::string notation, file;

    language::MeasuredPlants read(const std::string& text, const language::MeasuredOptions& options = {}) const {
        return registered<language::NotationType>().at(notation)->measure(text, file, options);
    }
    language::MeasuredSummary summary(const std::string& text, const language::MeasuredOptions& options = {}) const {
        return language::summary_of(read(text, options));
    }
    /// A line for each.
    std::string warnings(const std::string& text, const language::MeasuredOptions& options = {}) const {
        std::string all;
        for (const Diagnostic& warning : read(text, options).warnings) all += warning.message + "\n";
        return all;
    }
    /// "tree.mtg:1:2: message", or "" where there is none.
    std::string mistake(const std::string& text, const language::MeasuredOptions& options = {}) const {
        try {
            read(text, options);
        } catch (const UserError& error) {
            return to_string(error.diagnostics()[0].place) + ": " + error.diagnostics()[0].message;
        }
        return "";
    }
};

/// What a user compares with the program that wrote a file. Lengths in metres.
struct Measures {
    std::size_t plants = 1, axes = 1;
    double length = 0;
    glm::dvec3 size{0};
    double links = 0;
};

inline void check_measures(const language::MeasuredPlants& plants, const Measures& expected) {
    const language::MeasuredSummary summary = language::summary_of(plants);
    CHECK(summary.plants == expected.plants);
    CHECK(summary.axes == expected.axes);
    CHECK(summary.length == Approx(expected.length).epsilon(1e-12));
    CHECK(summary.link_length == Approx(expected.links).epsilon(1e-12).margin(1e-15));
    const glm::dvec3 size = summary.extent[1] - summary.extent[0];
    for (int axis = 0; axis < 3; ++axis) CHECK(size[axis] == Approx(expected.size[axis]).margin(1e-12));
}

/// All warnings, a line each.
inline std::string warnings_of(const language::MeasuredPlants& plants) {
    std::string text;
    for (const Diagnostic& warning : plants.warnings) text += warning.message + "\n";
    return text;
}

}  // namespace espalier
