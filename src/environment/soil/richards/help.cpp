#include "environment/soil/richards/parameters.h"

namespace espalier::environment {

const char* const richards_help = R"(
model = "richards": water with pressure and gravity. Keys domain, voxel, dimensions, obstacles, obstacle_field,
container_field, depletion, amount, range and gradient_length are as above, and those below. Pressure heads are numbers of
cm, or texts with a unit, as "-1.5 MPa": cm, mm, m, Pa, hPa, kPa, MPa, bar, pF.

days           1; days that a unit of the scene's time stands for
soil           required; the name of a soil, or a table, of the whole domain:
               { theta_r, theta_s, alpha (1/cm), n, ks (cm/d), l = 0.5 } is a soil of van Genuchten & Mualem,
               { model = "brooks-corey", theta_r, theta_s, air_entry (cm, below 0), lambda, ks } of Brooks & Corey, and
               { model = "gardner", theta_r, theta_s, alpha, ks } has K = ks exp(alpha h). Names are sand, loamy sand, sandy
               loam, loam, silt, silt loam, sandy clay loam, clay loam, silty clay loam, sandy clay, silty clay and clay
               (Carsel & Parrish 1988), the same behind "rosetta" (Schaap et al. 2001), and "hypres topsoil coarse", topsoil or
               subsoil with coarse, medium, medium fine, fine or very fine (Woesten et al. 1999). Textures are
               { sand, silt, clay (% of mass, two or all), organic_matter = 2.5 (%), transfer = "saxton-rawls" } (2006), or with
               transfer = "rosetta" or "carsel-parrish" the mean of their class. Measured soils are { heads = [0, -10, ...],
               theta = [...], k = [...] (cm/d) }, or { file = "soil.csv", unit = "cm" } with the columns head,theta,k
soils          {}; soils of your own by their names: { mine = { theta_r = 0.05, ... } }
initial        { head = -100 }; the water of frame 0, by one of
    head       pressure head everywhere, cm
    table      height of a water table over which the water hangs at rest, m
    content    water content everywhere, m3/m3, no more than the soil holds
    heights    heights of a profile, m, from one side to the other, with heads or contents: linear between them
layers         []; tables { bottom, top (heights, m), slope (degrees, along x), soil, initial } that do not overlap
regions        []; tables of a shape with soil and initial, such as lenses and stones; of two the later one counts
map            none; { field = "ground", soils = ["loam", "sand"] }, where a field has the value 0 lies the first of the soils;
               or of a file that covers the domain in x and y, or with plane = "xz" in x and z: { file = "ground.csv", soils },
               rows of numbers that count the soils from 0, the highest row first; or { file = "ground.png", soils,
               colours = ["#c8a060", "#604020"] }, a picture with a colour for each of the soils
boundaries     closed; what happens at the sides of the domain, in a table
    top        "no-flux" (the default), or a table with the keys rain, evaporation, ponding and dry_limit, or { flux } in mm/d
               into the soil, or { head } in cm
    weather    the name of a process weather that stands before this one: its rain falls on the surface, and its reference
               evaporation (FAO-56) is the potential one, unless rain or evaporation stand here, too
    rain       rain on the surface, mm/d
    evaporation  potential evaporation from bare soil, mm/d; it falls behind where the surface reaches dry_limit
    ponding    depth of water that may stand on the surface before it runs off, mm, by default 0
    dry_limit  pressure head below which the surface does not dry, by default -10000 cm
    bottom     "no-flux" (the default), "free-drainage", "seepage", { table } in m, { head } in cm, or { flux } in mm/d into
               the soil
    sides      "closed" (the default) or "periodic". Instead of a number, rain, evaporation, flux, head and table may be
               { file = "weather.csv", column = "rain" }, with unit = "hPa" for heads. The first column is the day from the
               beginning of the run, or a date (2025-06-21 13:30; the run begins at the first one's midnight), or time (h)
    left       "closed" (the default), { table }, the height of a water table at this side, m, or { head } in cm; so have right,
               back and front
outside        "stop growing", or "ignore", "error"; what a root does, for processes of roots, that leaves the soil through a side or
               the floor: stop growing: it ends there; ignore: it goes on and takes nothing up; error: the run ends
sources        []; tables of a shape with rate, the water that is put into it, m3/m3 per day
accuracy       0.005; error in the water content (m3/m3) that a substep may have
max_substep    1; longest substep, days
wilting_head   -15000 cm; water that is held more strongly is not for queries

?name(...) as above; a tenth parameter is answered the pressure head, cm, and three more its gradient, cm/cm.

Fields: `name` (m3/m3), `name.head` (cm), `name.flux_x`, `_y`, `_z` (cm/d), `name.ponding` (mm). Statistics: uptake and
wish (this plant, this step); storage, ponding; and since the beginning, in mm over the surface: rain, evaporation, runoff,
infiltration (through a top of given flux or head), sides (net, into the soil), drainage, added, drunk; balance as above;
substeps.

model = "still": heads that are given, and water that does not move: what roots take is put back. Keys as for "richards", but
for accuracy and boundaries other than sides; and

measured       none; measured heads instead of `initial`, { file = "tensiometers.csv", heights = [-0.1, -0.3],
               columns = ["shallow", "deep"], unit = "hPa" }: linear between the heights, each until the next line)";

}  // namespace espalier::environment
