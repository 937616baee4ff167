// Root systems as CRootBox and CPlantBox describe them: parameters of each type of roots.
#pragma once

#include "espalier/base/error.h"

#include "language/measured/notes.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace espalier::language::root_box {

/// A mean and its standard deviation.
struct Varied {
    double mean = 0, deviation = 0;
};

/// Roots of one type. Lengths in cm, times in days, angles in radians, as in the files.
struct RootType {
    int type = 0;
    std::string name;
    Varied basal_zone{0, 0}, apical_zone{10, 0}, spacing{1, 0};  ///< lb, la, ln
    Varied final_length{0, 0};                                   ///< lmax
    std::optional<Varied> branches = {};                         ///< nob, where a file says that instead
    Varied rate{1, 0}, radius{0.1, 0}, angle{1.22, 0}, life_time{1e9, 0};
    int tropism = 1;
    double trials = 1, sigma = 0.2;  ///< of the tropism
    double resolution = 0.25;        ///< dx
    int growth = 1;                  ///< gf; 1: negative exponential, 2: linear
    std::vector<int> successors;
    std::vector<double> chances;  ///< one for each successor
    Place place;
};

/// When roots other than the tap root begin, days, and where.
struct Seed {
    double depth = 0;  ///< cm
    double first_basal = 1e9, delay_basal = 1e9, most_basal = 0;
    std::optional<double> days = {};  ///< simulated
};

struct RootParameters {
    std::map<int, RootType> types;
    Seed seed;
};

/// `.rparam` of CRootBox, by position. Throws UserError with the place of a mistake.
RootParameters read_by_position(const std::string& text, const std::string& name, measured::Notes& notes);
/// `.pparam` of CRootBox, by position.
Seed read_seed_by_position(const std::string& text, const std::string& name, measured::Notes& notes);
/// XML of CPlantBox. Throws UserError with the place of a mistake.
RootParameters read_elements(const std::string& text, const std::string& name, measured::Notes& notes);

/// The text of the model, and notes of what has no equal.
std::string model_text(const RootParameters& parameters, const std::string& name, measured::Notes& notes);

}  // namespace espalier::language::root_box
