// The help of a part, read: `espalier list` prints it as it stands, the manual and tests need what it says.
//
// Text, in paragraphs.
//
// ?name(s)   -> a query, and what it is answered
//               goes on in lines that stand further in
//
// voxel   0.5 m, > 0; what it means: behind the default come the unit and the range
// mode    "add", or "attenuate"; a word, and the other words there are
// domain  the scene's, m; a default in words
// kill    required, m; no default
// sky     a row without a semicolon has a meaning only
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// A parameter, a query, or another row of two columns.
struct HelpRow {
    std::string name;      ///< several names are separated by ", "
    std::string fallback;  ///< the value if it is not given; "required", "none", or empty if the row does not say
    std::string unit, range, meaning;
    int depth = 0;  ///< 1: a key of the table in the row above
};

struct HelpBlock {
    enum class Kind {
        text,        ///< a paragraph in `text`
        heading,     ///< the name of a table, "[[plant]]", in `text`
        verbatim,    ///< lines that stand by themselves, in `text`
        parameters,  ///< `rows`
        queries      ///< `rows`, of which only `name` and `meaning` are used
    };
    Kind kind = Kind::text;
    std::string text = {};
    std::vector<HelpRow> rows = {};
};

/// ", 0 to 1", ", >= 0", ", <= 5" or "" for infinite bounds, as it stands behind a default.
std::string described_range(double lowest, double highest);

/// Every text can be read; what is no row is a paragraph.
std::vector<HelpBlock> read_help(std::string_view help);

/// Its parameters, block after block.
std::vector<HelpRow> parameters_of(std::string_view help);

}  // namespace espalier
