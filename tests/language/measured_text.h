// Shared by the tests of formats of measured plants: what a text holds, and what is said of it.
#pragma once

#include "espalier/language/measured_plants.h"
#include "espalier/language/notation.h"

#include <string>

namespace espalier {

/// A text in one notation of measured plants.
struct MeasuredText {
    std::string notation, file;

    MeasuredPlants plants_of(const std::string& text, const MeasuredOptions& options = {}) const {
        return registered<NotationType>().at(notation)->measure(text, file, options);
    }
    MeasuredSummary summary(const std::string& text, const MeasuredOptions& options = {}) const {
        return summary_of(plants_of(text, options));
    }
    /// A line for each.
    std::string warnings(const std::string& text, const MeasuredOptions& options = {}) const {
        std::string all;
        for (const Diagnostic& warning : plants_of(text, options).warnings) all += warning.message + "\n";
        return all;
    }
    /// "tree.mtg:1:2: message", or "" where there is none.
    std::string mistake(const std::string& text, const MeasuredOptions& options = {}) const {
        try {
            plants_of(text, options);
        } catch (const UserError& error) {
            return to_string(error.diagnostics()[0].place) + ": " + error.diagnostics()[0].message;
        }
        return "";
    }
};

}  // namespace espalier
