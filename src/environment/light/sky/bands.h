// Bands of the spectrum: their share in the energy of daylight, and their photons.
#pragma once

#include "espalier/base/settings.h"

#include <string>
#include <vector>

namespace espalier::environment {

struct LightBand {
    std::string name;
    double share = 0;    ///< of the energy of daylight; of PAR, the sky's `par_share`
    double photons = 0;  ///< umol per joule

    /// PAR is measured by itself; other bands are shares of the whole.
    bool is_par() const { return name == "par"; }
};

/// umol per joule at a wavelength in nm: lambda / (h c N_A).
double photons_per_joule(double wavelength);

/// The band `name` with `share` and `photons` (or `wavelength`) of its table, or its own: see `bands_help`. Throws
/// UserError for an unknown band without them.
LightBand read_light_band(const std::string& name, const Settings& table);

/// What users read of bands.
const std::string& bands_help();

}  // namespace espalier::environment
