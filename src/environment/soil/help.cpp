#include "environment/soil/parameters.h"

namespace espalier::environment {

const char* const richards_help = R"(
model = "richards": water with pressure and gravity. Keys domain, voxel, dimensions, obstacles, obstacle_field,
container_field, depletion, amount, range and gradient_length are as above, and

days             1: days that a unit of the scene's time stands for
soil             required: a name, or a table
                 { theta_r, theta_s, alpha (1/cm), n, ks (cm/d), l = 0.5 }                van Genuchten & Mualem
                 { model = "brooks-corey", theta_r, theta_s, air_entry (cm, < 0), lambda, ks }
                 { model = "gardner", theta_r, theta_s, alpha, ks }                       K = ks exp(alpha h)
                 Names: sand, loamy sand, sandy loam, loam, silt, silt loam, sandy clay loam, clay loam, silty clay
                 loam, sandy clay, silty clay, clay (Carsel & Parrish 1988); "hypres topsoil coarse" and topsoil or
                 subsoil with coarse, medium, medium fine, fine, very fine (Woesten et al. 1999)
soils            { name = { ... }, ... }: soils of your own by name
initial          { head = -100 } cm, { table = y } m: hydrostatic over a water table, or { content = 0.2 }
layers           [ { bottom, top (m, y), slope (degrees, along x), soil, initial }, ... ] that do not overlap
regions          [ { a shape, soil, initial }, ... ]: lenses, later ones win
map              { field = "ground", soils = ["loam", "sand"] }: a field whose value 0 is the first of the soils
boundaries       { top, bottom, sides }
  top            "no-flux" (default); { rain, evaporation (potential), ponding = 0, dry_limit = -10000 } with mm/d, mm/d,
                 mm, cm; { flux } mm/d into the soil; { head } cm
  bottom         "no-flux" (default), "free-drainage", "seepage"; { table = y } m; { head } cm; { flux } mm/d into the soil
  sides          "closed" (default) or "periodic"
                 Instead of a number, rain, evaporation, flux and head may be { file = "weather.csv", column = "rain" };
                 the first column is the day from the beginning of the run
sources          [ { a shape, rate }, ... ]: m3/m3 per day
accuracy         0.005 m3/m3: the error in time that a substep may have
max_substep      1 d
wilting_head     -15000 cm: water that is held more strongly is not for queries

?name(...) as above; a tenth parameter is answered the pressure head, cm.

Fields: `name` (m3/m3), `name.head` (cm), `name.flux_x`, `_y`, `_z` (cm/d), `name.ponding` (mm). Statistics: uptake and
wish (this plant, this step); storage, ponding; and since the beginning, in mm over the surface: rain, evaporation, runoff,
infiltration (through a top of given flux or head), drainage, added, drunk; balance as above; substeps.)";

}  // namespace espalier::environment
