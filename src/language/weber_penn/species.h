// A species in the parameters of Weber & Penn 1995, "Creation and Rendering of Realistic Trees".
#pragma once

#include "espalier/base/error.h"

#include "language/text/source.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language::weber_penn {

constexpr int highest_described_level = 3;  // deeper levels are like this one

struct Parameter {
    std::string name;  ///< without the digit of the level: "Length"
    std::string unit;  ///< "" for a pure number
    double lowest, highest;
    bool is_whole = false;
    std::string summary;
    std::vector<double> standard;  ///< the default; of a parameter of levels one for each level that has it
    int first_level = -1;          ///< -1: of the whole tree

    bool has_levels() const { return first_level >= 0; }
};

const std::vector<Parameter>& parameters();

/// The parameters as a person reads them.
std::string describe_parameters();

/// The name in a file, "1Length", and the name of the setting in the model, "Length_1".
std::string written_name(const Parameter& parameter, int level);
std::string setting_name(const Parameter& parameter, int level);

class Species {
public:
    /// What the file says or the default. Levels deeper than 3 are like level 3.
    double value(const std::string& name, int level = -1) const;
    /// The default.
    double standard(const std::string& name, int level = -1) const;
    int levels() const { return static_cast<int>(value("Levels")); }
    bool prunes() const { return value("PruneRatio") > 0; }

    void set(const std::string& written, double value, Location at) {
        values_[written] = value;
        places_[written] = at;
    }
    /// Where the file sets a parameter; nothing for a default.
    std::optional<Location> place(const std::string& written) const;
    /// The first place where the file sets a parameter of a level, or anything.
    std::optional<Location> place_of_level(int level) const;

    std::vector<Diagnostic> warnings;  ///< of what the file says and nothing reads

private:
    std::map<std::string, double> values_;  // by written name
    std::map<std::string, Location> places_;
};

/// Reads a table as the paper prints it, or one of the forms below, by how the text begins; `name` stands in messages.
/// Throws UserError with every mistake at its place.
Species parse(const std::string& text, const std::string& name);
/// The same of the XML of Arbaro (W. Diestel 2003 to 2012).
Species parse_arbaro(const std::string& text, const std::string& name);
/// The same of the arrays of tree-gen (C. Hewitt 2017), a dict of Python or an object of JSON.
Species parse_tree_gen(const std::string& text, const std::string& name);

}  // namespace espalier::language::weber_penn
