// The settings of a model: #defines whose comment says what they are, in which range and in which unit.
#pragma once

#include "espalier/base/error.h"
#include "espalier/base/stations.h"
#include "espalier/language/reader.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

struct TranslatedText;

/// #define CROWN_WIDTH 6  /* width of the crown; 0.5..40; m */
struct ModelSetting {
    std::string name;
    std::string text;  ///< its value as it is written
    double value = 0;
    std::string summary;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool whole = false;  ///< only whole numbers, "1..400 whole"
    std::string unit;    ///< empty: a plain number
    std::string group;   ///< the heading above it, /* --- Crown --- */; may be empty
    Place place;

    bool allows(double number) const {
        return number >= lowest && number <= highest && (!whole || number == std::trunc(number));
    }
    /// "0.5..40", "0..", "1..400 whole"
    std::string range() const;
    /// "a number between 0.5 and 40 m"
    std::string what_is_allowed() const;
};

/// What a model defines, without its productions.
class ModelSettings {
public:
    /// `defines` replace values of the file, as for `read_model`. Throws UserError with every mistake found.
    static ModelSettings read(const std::filesystem::path& model, const Defines& defines = {});
    static ModelSettings parse(std::string_view text, const std::string& name, const std::filesystem::path& folder = {},
                               const Defines& defines = {});

    /// In the order of the file.
    const std::vector<ModelSetting>& list() const;

    /// The value of an expression in which names are #defines of the model, documented or not. Throws UserError,
    /// without a place, for what has no finite value.
    double value(std::string_view expression) const;
    /// The names of the settings that an expression reads, directly or through other #defines.
    std::vector<std::string> read_by(std::string_view expression) const;

private:
    struct Contents;
    static ModelSettings read_text(TranslatedText text, const std::string& name, const std::filesystem::path& folder,
                                   const Defines& defines);
    explicit ModelSettings(std::shared_ptr<const Contents> contents) : contents_(std::move(contents)) {}
    std::shared_ptr<const Contents> contents_;
};

}  // namespace espalier::language
