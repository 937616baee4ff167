// What the readers of species share: names and ranges of parameters, and the mistakes that a file has.
#pragma once

#include "language/weber_penn/species.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::language::weber_penn {

class SpeciesBuilder {
public:
    /// A place of the file; lines and columns count from 1, 0: the file as a whole.
    struct At {
        int line = 0, column = 0;
    };

    /// `file` is the name in messages, `notation` that of the page with all parameters.
    SpeciesBuilder(const std::string& text, std::string file, std::string notation);

    static bool is_known(const std::string& written);
    void mistake(At at, const std::string& message);
    void warn(At at, const std::string& message);
    /// A parameter by its written name, "1Length". Its name must be known and new, and the value of its range.
    void set(const std::string& written, double value, At name_at, At value_at);

    const Species& so_far() const { return species_; }
    /// The species. Throws UserError with all mistakes.
    Species finished();

private:
    Diagnostic told(Diagnostic::Severity severity, At at, const std::string& message) const;
    void check_range(const Parameter& parameter, const std::string& name, double number, At at);
    void check_together();

    std::vector<std::string> lines_;
    std::string file_, notation_;
    Species species_;
    std::set<std::string> seen_;
    std::vector<Diagnostic> mistakes_;
};

}  // namespace espalier::language::weber_penn
