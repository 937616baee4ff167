// How well roots conduct, as a scene says it.
#pragma once

#include "espalier/base/settings.h"

#include <string>
#include <vector>

namespace espalier::environment {

/// A number, or a curve: linear between its points, constant beyond.
struct RootCurve {
    std::vector<double> at, values;

    double operator()(double x) const;
    static RootCurve read(const Settings& settings, const std::string& key, const RootCurve* fallback);
};

/// Of the roots of one order of branching.
struct RootConductances {
    RootCurve radial;  ///< 1/d
    RootCurve axial;   ///< cm3/d
};

/// Reads radial and axial, and `orders`, of which the last stands for all higher ones. Throws UserError.
std::vector<RootConductances> read_root_conductances(const Settings& settings);

}  // namespace espalier::environment
