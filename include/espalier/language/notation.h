// A notation is another way to write a model. One file in src/language/notations/ per notation.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/registry.h"
#include "espalier/base/stations.h"
#include "espalier/language/measured_plants.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// A model that stands for a file of another notation.
struct TranslatedText {
    /// A place of the text, and what it was written for, up to the next origin.
    struct Origin {
        int line = 0, column = 0;  ///< where it stands in the text
        Place place;               ///< in the notation; not known: nothing in particular
    };

    std::string text;
    std::vector<Origin> origins = {};       ///< in the order of the text
    std::vector<Diagnostic> warnings = {};  ///< of what the file says and the text does not
};

/// What a file of src/language/notations/ registers: a translator into the language of models, or a reader of measured
/// plants.
struct NotationType {
    using Translate = std::function<TranslatedText(const std::string& text, const std::filesystem::path& path)>;
    /// Has the text to itself, so that it need not keep all of a large file while it makes plants of it.
    using Measure = std::function<MeasuredPlants(std::string text, const std::filesystem::path& path,
                                                 const MeasuredOptions& options)>;

    std::string name;       ///< what the file is called in messages: "pgraph"
    std::string extension;  ///< extension of its files: ".pgraph"
    std::string summary;    ///< one line about the notation
    std::string help;       ///< the notation: its parts with units, ranges and defaults; the published source
    /// The model of a file's text, as text that can be run, with the places that mistakes in it are told at. Throws
    /// UserError with every mistake at its own place. Null: the file holds measured plants.
    Translate translate = nullptr;
    /// The plants of a file's text, without path. Throws UserError with the place of a mistake.
    Measure measure = nullptr;
    /// Where files of other kinds have the same extension: whether a text that begins so is in this notation.
    std::function<bool(std::string_view head)> recognises = nullptr;
};

/// The notation that files of this extension are written in; null for models themselves.
const NotationType* notation_of(const std::filesystem::path& path);

/// The model that a text in a notation stands for, however its lines end. Throws UserError for bytes that are no text.
TranslatedText translated(const NotationType& notation, const std::string& text, const std::filesystem::path& path);
/// The model that a file in a notation stands for. Throws UserError for a file in none.
TranslatedText translated(const std::filesystem::path& path);

}  // namespace espalier::language
