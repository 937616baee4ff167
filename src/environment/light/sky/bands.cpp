#include "environment/light/sky/bands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace espalier::environment {
namespace {

constexpr double photons_of_par = 4.57;     // McCree 1972
constexpr double red = 660, far_red = 730;  // nm, 10 nm wide each: Smith 1982
constexpr double share_of_red = 0.0144;     // 1.44 of 1000 W/m2 in a nanometre, ten times
constexpr double red_to_far_red = 1.19;     // photons of daylight: Smith 1982, table 1

std::vector<LightBand> known_bands() {
    const double of_red = photons_per_joule(red), of_far_red = photons_per_joule(far_red);
    return {{"par", 0.5, photons_of_par},
            {"nir", 0.5, photons_per_joule(1100)},
            {"red", share_of_red, of_red},
            {"far-red", share_of_red * of_red / (red_to_far_red * of_far_red), of_far_red}};
}

}  // namespace

double photons_per_joule(double wavelength) {
    constexpr double planck = 6.62607015e-34, speed_of_light = 299792458, avogadro = 6.02214076e23;
    return wavelength * 1e-9 * 1e6 / (planck * speed_of_light * avogadro);
}

LightBand read_light_band(const std::string& name, const Settings& table) {
    const std::vector<LightBand> known = known_bands();
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const LightBand& band) { return band.name == name; });
    if (found == known.end() && !table.has("share")) {
        throw UserError(table.place(),
                        fmt::format("the band '{}' needs share = its part of the energy of daylight: only "
                                    "par, nir, red and far-red have one of their own",
                                    name));
    }
    LightBand band = found != known.end() ? *found : LightBand{name, 0, photons_of_par};
    if (band.is_par()) {
        if (!table.has("share")) return band;
        throw UserError(table.place("share"), "the share of PAR in the light is a matter of the sky: sky.par_share");
    }
    band.share = table.number_or("share", band.share, Range{0, 1, true});
    if (table.has("wavelength")) band.photons = photons_per_joule(table.number("wavelength", Range::between(100, 1e5)));
    band.photons = table.number_or("photons", band.photons, Range::positive());
    return band;
}

const std::string& bands_help() {
    static const std::string text =
        R"(  share       part of the energy of daylight: nir 0.5, red (655 to 665 nm) 0.0144, far-red (725 to 735 nm) 0.0109, which
              is 1.19 photons of red for one of far-red (Smith 1982); that of par is the sky's par_share
  photons     umol per joule, or wavelength in nm: nir 1100, red 660, far-red 730
)";
    return text;
}

}  // namespace espalier::environment
