#include "environment/soil/solutes/parameters.h"

#include <algorithm>

namespace espalier::environment {
namespace {

const Range concentrations = Range::between(0, 1e12);

SolutePart read_part(Settings& table) {
    if (table.has("shape")) return {0, 0, read_shape(table)};
    SolutePart part{table.number_or("bottom", -1e6), table.number_or("top", 1e6), nullptr};
    if (part.bottom < part.top) return part;
    throw UserError(table.place("top"), "the 'top' must be higher than the 'bottom' (y points up)");
}

Sorption read_sorption(const Settings& settings) {
    if (!settings.has("sorption")) return {};
    const Settings table = settings.table("sorption");
    const Range coefficients = Range::between(0, 1e9);
    Sorption sorption;
    sorption.coefficient = table.number("coefficient", coefficients);
    sorption.exponent = table.number_or("exponent", 1, Range{0.05, 1, false});
    sorption.density = table.number_or("density", 1.4, Range{0, 10, true});
    return sorption;
}

UptakeKinetics read_kinetics(const Settings& settings) {
    const Settings table = settings.table("uptake");
    UptakeKinetics kinetics;
    kinetics.vmax = table.number_or("vmax", 0, concentrations);
    kinetics.km =
        kinetics.vmax > 0 ? table.number("km", Range{0, 1e12, true}) : table.number_or("km", 1, concentrations);
    kinetics.cmin = table.number_or("cmin", 0, concentrations);
    kinetics.passive = table.number_or("passive", 0, Range::between(0, 1));
    return kinetics;
}

void read_parts(Settings& settings, SoluteParameters& parameters) {
    for (const char* const key : {"layers", "regions"}) {
        for (Settings& table : settings.tables(key)) {
            parameters.beginnings.push_back({read_part(table), table.number("initial", concentrations)});
        }
    }
    for (Settings& table : settings.tables("sources")) {
        parameters.sources.push_back({read_part(table), table.number("rate", concentrations), table.place()});
    }
    for (Settings& table : settings.tables("events")) {
        parameters.events.push_back({read_part(table), table.number("day", Range::between(0, 1e9)),
                                     table.number("amount", concentrations), table.place()});
    }
    std::stable_sort(parameters.events.begin(), parameters.events.end(),
                     [](const SoluteEvent& a, const SoluteEvent& b) { return a.day < b.day; });
}

void read_sides(const Settings& settings, SoluteParameters& parameters) {
    const Settings boundaries = settings.table("boundaries");
    const Settings top = boundaries.table("top"), bottom = boundaries.table("bottom");
    parameters.rain = TimeSeries::read(top, "entering", 0, concentrations);
    parameters.sides.entering_sides = boundaries.table("sides").number_or("entering", 0, concentrations);
    parameters.sides.entering_bottom = bottom.number_or("entering", 0, concentrations);
    if (top.has("held")) parameters.sides.held_top = top.number("held", concentrations);
    if (bottom.has("held")) parameters.sides.held_bottom = bottom.number("held", concentrations);
}

/// The space of a solute that finds no soil with pressure.
void read_space(Settings& settings, const EnvironmentContext& context, SoluteParameters& parameters) {
    parameters.soil.space = SoilSpace::read(settings, context);
    parameters.soil.days = settings.number_or("days", 1, Range{0, 1e6, true});
    parameters.soil.periodic = settings.choice_or("sides", "closed", {"closed", "periodic"}) == "periodic";
    parameters.soil.outside = read_outside(settings);
    SoilKind kind;
    kind.saturated = settings.number_or("porosity", 0.43, Range{0.01, 1, false});
    kind.conductivity = 10;
    parameters.soil.kinds.emplace_back(kind);
    parameters.content = settings.number_or("content", 0.3, Range{0.001, kind.saturated, false});
    parameters.flow = settings.number_or("flow", 0, Range::between(-1e5, 1e5));
}

}  // namespace

bool SolutePart::inside(const glm::dvec3& point) const {
    return shape ? shape->inside(point) : point.y >= bottom && point.y < top;
}

SoluteParameters read_solute_parameters(Settings& settings, const EnvironmentContext& context, bool alone) {
    SoluteParameters parameters;
    if (alone) read_space(settings, context, parameters);
    parameters.unit = settings.text_or("unit", "umol");
    parameters.properties.diffusion = settings.number_or("diffusion", 1.6, Range::between(0, 1e6));
    parameters.properties.dispersivity = settings.number_or("dispersivity", 0, Range::between(0, 1e4));
    parameters.properties.sorption = read_sorption(settings);
    parameters.decay = settings.number_or("decay", 0, Range::between(0, 1e6));
    parameters.initial = settings.number_or("initial", 0, concentrations);
    read_parts(settings, parameters);
    read_sides(settings, parameters);
    parameters.kinetics = read_kinetics(settings);
    parameters.zone = settings.flag_or("zone", true);
    parameters.max_substep = settings.number_or("max_substep", 0.05, Range{1e-6, 1e4, false});
    return parameters;
}

const char* const nutrient_help =
    R"(A solute in the soil: it moves with the water and spreads in it, is held by the soil, decays, comes as fertiliser, and
roots take it up. A scene has one process for each solute.

soil           none; name of the soil-water that the solute moves in, which stands before it in the scene. With model =
               "richards" the solute moves with its water; of the linear model it takes the content
unit           "umol"; the unit of amounts; concentrations are amounts per cm3 of water
initial        0, >= 0; concentration of frame 0
layers         []; tables { bottom, top (heights, m), initial }; of two the later one counts
regions        []; tables of a shape with initial
diffusion      1.6 cm2/d, 0 to 1e6; diffusion in water; in soil it is reduced by its tortuosity
dispersivity   0 cm, 0 to 10000; dispersion is this times the Darcy flux
sorption       none; what the soil's solids hold, s = coefficient c^exponent per g, in a table
    coefficient  cm3/g for linear sorption
    exponent   0.05 to 1, by default 1: linear; below 1: Freundlich
    density    bulk density of the soil, g/cm3, by default 1.4
decay          0 1/d, 0 to 1e6; of what is in the water and on the solids
sources        []; tables of a shape, or of bottom and top, with rate, amount/cm3 of soil and day
events         []; fertiliser: tables of a shape, or of bottom and top, with day and amount, which is spread over it
boundaries     closed; in a table
    sides      { entering } is that of water that enters through sides of given heads
    top        { entering } is the concentration of water that enters at the top, or { file = "rain.csv", column = "nitrate" };
               { held } is a concentration held at the surface
    bottom     { entering } is that of water that rises through the floor; { held } is held at the floor
uptake         none; what roots take per cm2 of their surface, vmax (c - cmin) / (km + c - cmin), in a table
    vmax       amount/cm2/d
    km         amount/cm3
    cmin       amount/cm3 below which nothing is taken, by default 0
    passive    0 to 1; part of the solute in the water that roots take which enters with it, by default 0
zone           true; around each root the concentration falls towards its surface as in a hollow cylinder
max_substep    0.05 d, 1e-06 to 10000; between two exchanges of movement and uptake

Without a soil of model = "richards" the solute needs a space of its own, and these count:

domain         the domain of the scene, m; { lower = [x, y, z], upper = [x, y, z] }
voxel          required, m, >= 1.5e-5; edge of a voxel
content        0.3 m3/m3; water content everywhere, if no linear soil gives it
porosity       0.43 m3/m3, 0.01 to 1; content of full soil, for the tortuosity
flow           0 cm/d; Darcy flux downwards, everywhere
obstacles      []; shapes without soil; obstacle_field, container_field and dimensions are as in soil-water
sides          "closed", or "periodic"; closed: nothing passes; periodic: what leaves at a side enters at the other
days           1 d, > 0; days that a unit of the scene's time stands for
outside        "stop growing", or "ignore", "error"; of roots that leave it, as in soil-water

?name(c)               -> concentration, amount/cm3
?name(c, gx, gy, gz)   -> ..., its gradient, amount/cm3 per cm
?name(c, gx, gy, gz, u) -> ..., what the plant took up in this step
?name(c, gx, gy, gz, u, r) -> ..., distance to the nearest wall, m: a stone, a side that is not periodic, the floor

Fields: `name` (concentration) and `name.amount` (per cm3 of soil). Statistics: uptake (this plant, per day, the mean of the step) and
total (this plant, since the beginning); stored, and since the beginning fertilised, produced, decayed, taken (by all plants),
inflow (net, at the top), leached (through the floor), rising (in through the floor), sides (net, in); balance as in soil-water; minimum, maximum.)";

}  // namespace espalier::environment
