// Leaves and air as scenes describe them.
#pragma once

#include "espalier/base/settings.h"

#include "environment/leaf/gas/gas_exchange.h"

#include <optional>
#include <string>

namespace espalier::environment::leaf {

/// The leaf of a scene that says nothing: C3, with a g0 of 0.005 mol m-2 s-1.
LeafKind usual_leaf();

// What a leaf may have of each, in a scene and in a query.
inline constexpr Range of_carboxylation{0, 1000, true}, of_electron_transport{0, 2000, true};  ///< umol m-2 s-1
inline constexpr Range of_respiration{0, 100}, of_slope{0, 100}, of_width{1e-4, 10};           ///< ..., g1, m

/// Reads `pathway`, `v`, `jmax`, `rd`, `tpu`, `stomata`, `g0`, `g1`, `d0`, `sf`, `psi_f`, `psi_dry`, `width`. What is
/// not there is as in `common`; with another pathway or form of stomata, their parameters are the usual ones.
LeafKind read_leaf_kind(const Settings& settings, const LeafKind& common = usual_leaf());

/// The keys `humidity`, 0 to 1, and `co2`, umol mol-1, of which errors say what to write instead of % and Pa.
double read_humidity(const Settings& settings, double fallback);
double read_carbon_dioxide(const Settings& settings, double fallback);

/// The air of a step, the same for all leaves.
struct SceneAir {
    double temperature = 25;        ///< degrees Celsius
    double humidity = 0.6;          ///< 0 to 1
    double wind = 1;                ///< m s-1
    double carbon_dioxide = 400;    ///< umol mol-1
    double pressure = sea_level;    ///< kPa
    double cloud = 0;               ///< share of the sky, 0 to 1
    std::optional<double> thermal;  ///< radiation that meets both sides of a leaf, W m-2; none: of sky and ground

    static SceneAir read(const Settings& settings);
    Air air() const;
    /// Of the sky on level ground, W m-2 (Brutsaert 1975; clouds as Monteith & Unsworth 1990, eq. 4.23).
    double sky_radiation() const;
    /// Without a number of the scene: of that sky, and of a ground as warm as the air.
    double thermal_radiation() const;
};

/// What users read of both.
const std::string& leaf_help();
const std::string& air_help();

}  // namespace espalier::environment::leaf
