// The C preprocessor as models use it: comments, macros, conditions, included files, continued lines.
#pragma once

#include "espalier/language/reader.h"

#include "language/preprocessor/macros.h"
#include "language/text/source.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language {

/// What a comment beside a #define says of it: its words, range and unit.
struct SettingComment {
    std::string summary = {};
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool whole = false;  ///< "1..400 whole"
    std::string unit = {};
};

/// Reads a line as its author wrote it; nothing if it has no comment, or one without a range.
std::optional<SettingComment> setting_comment(std::string_view line);

/// "Crown" of a line that is nothing but a heading: /* --- Crown --- */ or // --- Crown ---; otherwise "".
std::string_view heading_of(std::string_view line);

/// A macro whose comment says which numbers it may be.
struct DocumentedMacro {
    std::string name;
    Location at;
    SettingComment comment;
    std::string group;  ///< the heading above it
};

struct Preprocessed {
    MappedText text;
    /// Every name the files define or ask for.
    std::set<std::string> macro_names;
    Macros macros = {};  ///< as they are at the end
    std::vector<DocumentedMacro> documented = {};
};

/// Whether `ReadOptions::defines` may hold names that a file never mentions.
enum class Overrides { must_be_known, may_be_unknown };

/// Preprocesses a file already added to `sources`; included files are added to it. Mistakes are collected.
Preprocessed preprocess(Sources& sources, std::uint32_t file, const std::filesystem::path& folder,
                        const ReadOptions& options, Mistakes& mistakes, Overrides overrides = Overrides::must_be_known);

/// The value of an #if expression whose macros are expanded; throws SyntaxError at `at`.
long long condition_value(std::string_view text, Location at);

}  // namespace espalier::language
