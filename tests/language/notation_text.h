// Shared by the tests of notations: the model that a text becomes, or its first mistake.
#pragma once

#include "espalier/base/error.h"
#include "espalier/language/notation.h"

#include <string>

namespace espalier {

/// A text in one notation.
struct NotationText {
    std::string notation, file;

    std::string model_of(const std::string& text) const {
        return language::translated(*registered<NotationType>().at(notation), text, file).text;
    }
    /// "tree.mtg:1:2: message", or "" where there is none.
    std::string mistake(const std::string& text) const {
        try {
            model_of(text);
        } catch (const UserError& error) {
            return to_string(error.diagnostics()[0].place) + ": " + error.diagnostics()[0].message;
        }
        return "";
    }
};

}  // namespace espalier
