// Parameters of a leaf from what an instrument measured of it.
#pragma once

#include "environment/leaf/gas/gas_exchange.h"
#include "environment/leaf/measured/leaf_records.h"

#include <map>
#include <string>
#include <vector>

namespace espalier::study {

/// What a file does not tell, and where the search begins.
struct LeafFitChoices {
    environment::leaf::LeafKind leaf;
    double absorptance = 0.85;        ///< share of PAR that the leaf absorbs, where the instrument does not say
    std::vector<std::string> fitted;  ///< "v", "jmax", ...: keys of leaf-exchange
};

struct FittedNumber {
    std::string name, unit;
    double value = 0;
    double error = 0;  ///< standard; NaN: the file does not decide it
};

/// Two parameters of which the file tells one combination only.
struct ConfusedPair {
    std::string first, second;
    double correlation = 0;
};

struct LeafFit {
    environment::leaf::LeafKind leaf;
    std::vector<FittedNumber> numbers;
    std::vector<ConfusedPair> pairs;
    std::size_t rows_of_assimilation = 0, rows_of_conductance = 0;
    double residual_of_assimilation = 0;  ///< root mean square, umol m-2 s-1
    double residual_of_conductance = 0;   ///< mol m-2 s-1
    /// Rows by what limits them: "Rubisco", "light", ...
    std::map<std::string, std::size_t> limits;
};

/// The names that a leaf of this pathway and form of stomata may fit.
std::vector<std::string> names_to_fit(const environment::leaf::LeafKind& leaf);

/// Photosynthesis by A over Ci, light and temperature of each row, stomata by gs over A and the air at the surface
/// where the leaf gains; each by least squares. Throws UserError for a name that cannot be fitted, and for fewer rows
/// than parameters.
LeafFit fit_leaf(const environment::leaf::LeafRecords& records, const LeafFitChoices& choices);

/// A that this leaf has in the conditions of a row, umol m-2 s-1.
double modelled_assimilation(const environment::leaf::LeafRecord& row, const LeafFitChoices& choices,
                             const environment::leaf::LeafKind& leaf);
/// gs in them, with the row's own A, mol m-2 s-1; NaN where the row does not tell the air at the surface.
double modelled_conductance(const environment::leaf::LeafRecord& row, const environment::leaf::LeafKind& leaf);

}  // namespace espalier::study
