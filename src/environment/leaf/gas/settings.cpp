#include "environment/leaf/gas/settings.h"

#include "espalier/base/math.h"

#include <fmt/format.h>

#include <limits>

namespace espalier::environment::leaf {

LeafKind usual_leaf() {
    LeafKind leaf;
    leaf.stomata.least = 0.005;
    return leaf;
}

namespace {

const char* name_of(Stomata::Form form) {
    return form == Stomata::Form::leuning ? "leuning" : form == Stomata::Form::ball_berry ? "ball-berry" : "medlyn";
}

/// The pathway and the form of stomata, with the usual parameters of others than those of `common`.
LeafKind read_forms(const Settings& settings, const LeafKind& common) {
    LeafKind leaf = common;
    const bool was_c4 = common.photosynthesis.pathway == Pathway::c4;
    const bool is_c4 = settings.choice_or("pathway", was_c4 ? "c4" : "c3", {"c3", "c4"}) == "c4";
    const std::string form =
        settings.choice_or("stomata", name_of(common.stomata.form), {"medlyn", "leuning", "ball-berry"});
    if (is_c4 != was_c4) leaf.photosynthesis = is_c4 ? Photosynthesis::of_c4() : Photosynthesis();
    leaf.stomata.form = form == "leuning"      ? Stomata::Form::leuning
                        : form == "ball-berry" ? Stomata::Form::ball_berry
                                               : Stomata::Form::medlyn;
    if (is_c4 != was_c4 || leaf.stomata.form != common.stomata.form) {
        leaf.stomata.slope = leaf.stomata.form != Stomata::Form::medlyn ? 9 : is_c4 ? 1.6 : 4;
    }
    return leaf;
}

}  // namespace

LeafKind read_leaf_kind(const Settings& settings, const LeafKind& common) {
    LeafKind leaf = read_forms(settings, common);
    Photosynthesis& rates = leaf.photosynthesis;
    if (rates.pathway == Pathway::c4) {
        rates.carboxylation_pep.at_25 = settings.number_or("vp", rates.carboxylation_pep.at_25, of_carboxylation);
    }
    rates.carboxylation.at_25 = settings.number_or("v", rates.carboxylation.at_25, of_carboxylation);
    rates.electron_transport.at_25 = settings.number_or("jmax", rates.electron_transport.at_25, of_electron_transport);
    rates.respiration.at_25 = settings.number_or("rd", rates.respiration.at_25, of_respiration);
    if (settings.has("tpu")) rates.phosphate_use = settings.number("tpu", of_carboxylation);
    Stomata& stomata = leaf.stomata;
    stomata.least = settings.number_or("g0", stomata.least, Range::between(0, 5));
    stomata.slope = settings.number_or("g1", stomata.slope, of_slope);
    stomata.deficit_0 = settings.number_or("d0", stomata.deficit_0, Range::positive());
    stomata.sensitivity = settings.number_or("sf", stomata.sensitivity, Range::between(0, 50));
    stomata.reference = settings.number_or("psi_f", stomata.reference, Range::between(-20, 0));
    stomata.dry = settings.number_or("psi_dry", stomata.dry, Range::between(-100, 0));
    leaf.width = settings.number_or("width", leaf.width, of_width);
    return leaf;
}

double read_humidity(const Settings& settings, double fallback) {
    const double humidity = settings.number_or("humidity", fallback, Range::not_negative());
    if (humidity <= 1) return humidity;
    throw UserError(settings.place("humidity"), "'humidity' is a share from 0 to 1: write 0.6 for 60 %");
}

double read_carbon_dioxide(const Settings& settings, double fallback) {
    const double carbon_dioxide = settings.number_or("co2", fallback, Range::positive());
    if (carbon_dioxide >= 50 && carbon_dioxide <= 10000) return carbon_dioxide;
    throw UserError(settings.place("co2"), "'co2' is in umol per mol of air, 50 to 10000: 40 Pa at sea level are 400");
}

double read_wind(const Settings& settings, double fallback) {
    const double wind = settings.number_or("wind", fallback, Range::any());
    if (wind >= 0.01 && wind <= 100) return wind;
    throw UserError(settings.place("wind"),
                    fmt::format("'wind' is a speed from 0.01 to 100 m/s, not {:g}: write 0.1 for calm air", wind));
}

SceneAir SceneAir::read(const Settings& settings) {
    SceneAir air;
    air.temperature = settings.number_or("temperature", air.temperature, Range::between(-40, 60));
    air.humidity = read_humidity(settings, air.humidity);
    air.wind = read_wind(settings, air.wind);
    air.carbon_dioxide = read_carbon_dioxide(settings, air.carbon_dioxide);
    if (settings.has("pressure") && settings.has("height")) {
        throw UserError(settings.place("height"), "give either 'height' above the sea or 'pressure'");
    }
    air.pressure = settings.has("height") ? pressure_at_height(settings.number("height", Range::between(-500, 9000)))
                                          : settings.number_or("pressure", sea_level, Range::between(20, 120));
    air.cloud = settings.number_or("cloud", 0, Range::between(0, 1));
    if (settings.has("thermal")) air.thermal = settings.number("thermal", Range::between(0, 5000));
    return air;
}

Air SceneAir::air() const {
    return {temperature, humidity * saturation_pressure(temperature), wind, carbon_dioxide, pressure};
}

double SceneAir::sky_radiation() const {
    const double hectopascal = 10 * humidity * saturation_pressure(temperature);
    const double clear = 1.24 * math::pow(hectopascal / (temperature + kelvin), 1.0 / 7);
    return ((1 - 0.84 * cloud) * clear + 0.84 * cloud) * black_body(temperature);
}

double SceneAir::thermal_radiation() const {
    return thermal ? *thermal : sky_radiation() + black_body(temperature);
}

const std::string& leaf_help() {
    static const std::string text =
        R"(pathway        "c3", or "c4"; C3 by Farquhar, von Caemmerer & Berry (1980) with the constants of Bernacchi et al. (2001), C4 by
               von Caemmerer (2000)
v              78.5 (c4: 60) umol m-2 s-1; carboxylation by Rubisco at 25 degrees, per area of one side as all rates
vp             120 umol m-2 s-1; of c4: carboxylation by PEP carboxylase
jmax           150 (c4: 400) umol m-2 s-1; electron transport at 25 degrees
rd             2.12 (c4: 0.6) umol m-2 s-1; respiration at 25 degrees
tpu            none, umol m-2 s-1; use of triose phosphates
stomata        "medlyn", "leuning", "ball-berry"; what they answer to: Medlyn et al. (2011), Leuning (1995), Ball et al. (1987)
g0             0.005 mol m-2 s-1; least conductance to water vapour
g1             4 kPa^0.5 (c4: 1.6), or 9 of the other forms; slope
d0             1.5 kPa; of Leuning's form
sf             0 MPa-1; how steeply stomata close with the water potential (Tuzet et al. 2003); 0: not at all
psi_f          -2 MPa; where they have closed half-way
psi_dry        -5 MPa; below it a leaf has dried, and its least conductance falls, too, e-fold in 0.5 MPa
width          0.05 m; of a leaf along the wind
)";
    return text;
}

const std::string& air_help() {
    static const std::string text =
        R"(temperature    25 degrees Celsius; of the air
humidity       0.6; relative humidity, 0 to 1
wind           1 m/s, at the leaves
co2            400 umol/mol; carbon dioxide in the air
pressure       101.325 kPa; or height (m above the sea), which gives it
cloud          0; share of the sky, 0 to 1, for its thermal radiation
thermal        that of the sky (Brutsaert 1975) and of a ground as warm as the air, W m-2; radiation that meets both sides
               of a leaf together
)";
    return text;
}

}  // namespace espalier::environment::leaf
