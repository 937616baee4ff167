#include "environment/soil/linear/parameters.h"

#include "espalier/base/math.h"

#include "base/text.h"

#include <fmt/format.h>

#include <numbers>

namespace espalier::environment {
namespace {

/// diffusion (one number) times anisotropy (one factor per axis).
glm::dvec3 read_diffusion(const Settings& settings, double fallback, const glm::dvec3& anisotropy) {
    const double diffusion = settings.number_or("diffusion", fallback, Range::between(0, 1e30));
    const glm::dvec3 factors = settings.vector_or("anisotropy", anisotropy);
    for (int axis = 0; axis < 3; ++axis) {
        if (factors[axis] < 0) throw UserError(settings.place("anisotropy"), "'anisotropy' must not be negative");
    }
    return diffusion * factors;
}

std::array<WaterSide, 6> read_sides(Settings& settings, bool flat) {
    static const std::array<const char*, 6> names = {"left", "right", "bottom", "top", "back", "front"};
    std::array<WaterSide, 6> sides;
    const Settings boundaries = settings.table("boundaries");
    for (std::size_t side = 0; side < names.size(); ++side) {
        if (boundaries.is_table(names[side])) {
            sides[side] = {true, boundaries.table(names[side]).number("fixed", content_range)};
        } else {
            sides[side].fixed = boundaries.choice_or(names[side], "no-flux", {"no-flux", "open"}) == "open";
        }
        if (flat && side >= 4 && sides[side].fixed) {
            throw UserError(boundaries.place(names[side]),
                            fmt::format("a two-dimensional soil has no '{}' to cross", names[side]));
        }
    }
    return sides;
}

/// Straight down, turned about the z axis towards +x.
glm::dvec3 gravity_at(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {math::sin(angle), -math::cos(angle), 0};
}

std::vector<WaterLayer> read_layers(Settings& settings, const WaterParameters& parameters, double diffusion,
                                    const glm::dvec3& anisotropy) {
    std::vector<WaterLayer> layers;
    for (Settings& table : settings.tables("layers")) {
        WaterLayer layer;
        layer.heights = LayerHeights::read(table, parameters.space.domain.lower.y, parameters.space.domain.upper.y);
        if (parameters.mode == WaterMode::diffusion) layer.diffusion = read_diffusion(table, diffusion, anisotropy);
        const double degrees = table.number_or("gravity_angle", 0);
        if (degrees != 0) layer.gravity = gravity_at(degrees);
        if (table.has("initial")) layer.initial = table.number("initial", content_range);
        layers.push_back(layer);
    }
    return layers;
}

std::vector<WaterRegion> read_regions(Settings& settings) {
    std::vector<WaterRegion> regions;
    for (Settings& table : settings.tables("regions")) {
        regions.push_back({read_shape(table), table.number("value", content_range),
                           table.number_or("edge", 0, Range::not_negative())});
    }
    return regions;
}

std::vector<WaterSource> read_sources(Settings& settings) {
    std::vector<WaterSource> sources;
    for (Settings& table : settings.tables("sources")) {
        WaterSource source;
        source.shape = read_shape(table);
        source.place = table.place();
        if (table.has("hold")) source.hold = table.number("hold", content_range);
        if (table.has("rate")) source.rate = table.number("rate", content_range);
        if (table.has("hold") == table.has("rate")) {
            throw UserError(table.place(), "a source needs one of 'hold' (content) and 'rate' (content per time unit)");
        }
        sources.push_back(source);
    }
    return sources;
}

void read_mode(Settings& settings, WaterParameters& parameters) {
    const std::string mode = settings.choice_or("mode", "diffusion", {"diffusion", "relaxation"});
    if (mode == "diffusion") {
        parameters.max_substeps = static_cast<int>(settings.integer_or("max_substeps", 100000, Range::between(1, 1e9)));
        return;
    }
    parameters.mode = WaterMode::relaxation;
    parameters.sweeps = static_cast<int>(settings.integer_or("sweeps", 1, Range::between(0, 1e9)));
    parameters.relaxation = settings.number_or("relaxation", 0.5, Range::between(0, 1));
    parameters.tolerance = settings.number_or("tolerance", 0, Range::not_negative());
    for (const WaterSide& side : parameters.sides) {
        if (side.fixed) {
            throw UserError(settings.place("boundaries"), "mode = \"relaxation\" knows closed boundaries only");
        }
    }
}

/// Nothing may begin, or be held, with more than a voxel has room for.
void read_porosity(Settings& settings, WaterParameters& parameters) {
    if (!settings.has("porosity")) return;
    parameters.porosity = settings.number("porosity", Range::positive());
    const auto require_room = [&](double content, const Place& place) {
        if (content <= parameters.porosity) return;
        throw UserError(place, fmt::format("a content of {} is more than the porosity of the soil, {}",
                                           format_general(content), format_general(parameters.porosity)));
    };
    require_room(parameters.initial, settings.place("initial"));
    for (const WaterSide& side : parameters.sides) require_room(side.content, settings.place("boundaries"));
    for (const WaterLayer& layer : parameters.layers) require_room(layer.initial.value_or(0), settings.place("layers"));
    for (const WaterRegion& region : parameters.regions) require_room(region.content, settings.place("regions"));
    for (const WaterSource& source : parameters.sources) require_room(source.hold.value_or(0), source.place);
}

}  // namespace

WaterParameters read_water_parameters(Settings& settings, const EnvironmentContext& context) {
    WaterParameters parameters;
    parameters.space = SoilSpace::read(settings, context);
    parameters.unit = settings.text_or("unit", "m3/m3");
    parameters.initial = settings.number_or("initial", 0, content_range);
    parameters.sides = read_sides(settings, parameters.space.flat);
    read_mode(settings, parameters);
    parameters.steady = settings.choice_or("begin", "initial", {"initial", "steady"}) == "steady";
    if (parameters.steady && parameters.mode == WaterMode::relaxation) {
        throw UserError(settings.place("begin"), "begin = \"steady\" needs mode = \"diffusion\"");
    }

    double diffusion = 0;
    glm::dvec3 anisotropy{1};
    if (parameters.mode == WaterMode::diffusion) {
        parameters.diffusion = read_diffusion(settings, 0, anisotropy);
        diffusion = settings.number_or("diffusion", 0);
        anisotropy = settings.vector_or("anisotropy", anisotropy);
    }
    parameters.layers = read_layers(settings, parameters, diffusion, anisotropy);
    parameters.regions = read_regions(settings);
    parameters.sources = read_sources(settings);
    read_porosity(settings, parameters);
    parameters.querying = SoilQuerying::read(settings, parameters.space.voxel);
    return parameters;
}

const WaterLayer* WaterParameters::layer_at(double y) const {
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
        const auto [bottom, top] = layer->heights;
        if (y >= bottom && (y < top || (y == top && y == space.domain.upper.y))) return &*layer;
    }
    return nullptr;
}

const char* const soil_water_help = R"(A content (water in m3/m3, or any concentration) on a grid of cubic voxels.

model            "linear" (default): diffusion, described here; "richards", "still": see below
domain           { lower = [x, y, z], upper = [x, y, z] }  m; default: the scene's
voxel            m, required, >= 1.5e-5; the domain is covered by whole voxels about its middle
dimensions       2 or 3; default 2 if the domain is at most one voxel deep (z); then z is ignored
unit             text, "m3/m3"; "1" for a plain concentration
initial          content everywhere, 0
layers           [ { bottom, top (m, y), initial, diffusion, anisotropy, gravity_angle }, ... ], later ones win;
                 gravity_angle (degrees, 0) turns the layer's downward direction about z, towards +x
regions          [ { a shape, value, edge }, ... ] applied in order to the initial content; within `edge` (m, 0)
                 outside the shape, the content fades to the earlier content
begin            "initial" (default): with the contents above; "steady": with the steady state between the fixed
                 sides and the sources; soil that neither affects begins at its mean
obstacles        [ { a shape }, ... ]: water can neither enter nor pass
obstacle_field   name of a distance field, as "stone.distance": inside it is an obstacle
container_field  name of a distance field, as "pot.distance": outside it is an obstacle
boundaries       { left, right, bottom, top, back, front }, each "no-flux" (default), { fixed = content } held on
                 the face of that side, or "open": the same with content 0; water that reaches the side is lost
sources          [ { a shape, rate or hold }, ... ]: the content grows by `rate` per time unit, or is held at `hold`
porosity         content of a voxel that is full; default: none. What a source brings beyond it runs off. Nothing else may
                 exceed it: neither `initial` contents nor what is held

mode             "diffusion" (default): finite volumes, conserves water; or "relaxation" (below)
diffusion        m2 per time unit, 0; between layers the harmonic mean counts
anisotropy       [x, y, z] factors of diffusion, [1, 1, 1]
max_substeps     100000: a step that would need more substeps to be stable is an error

mode = "relaxation": per step `sweeps` (1) times  new = (1 - w) old + w mean of the free face neighbours, w =
`relaxation` (0.5), until no voxel changes by more than `tolerance` (0). Not conservative: `balance` shows the error.

depletion        true; false: queries remove nothing, and each is answered as if it were alone
amount           "content" (default): amounts are content times voxels, 0.2 takes 0.2 m3/m3 from one voxel;
                 "volume": content times m3
range            1: difference of content at which the gradient has its full weight
gradient_length  m, one voxel: distance over which the difference is taken

?name(wish)                                -> obtained
?name(wish, _)                             -> obtained, content
?name(wish, g, h, _)                       -> obtained, dx, dy, dz
?name(wish, g, h, length, _, _, _, _)      -> obtained, dx, dy, dz, hx, hy, hz, clear
?name(wish, g, h, length, _, _, _, _, _)   -> ... and content
?name(wish, g, h, length, ..., r)          -> with 14 parameters, r: distance to the nearest wall, m: a stone, a side, the
                                              floor
d = g * down + h * gradient * gradient_length / range. (hx, hy, hz): unit heading, the turtle's own bent by d, turned
by 2, 4, ... 180 degrees until a segment of `length` from the turtle meets no obstacle and stays in the domain;
clear = 1, or 0 with a zero heading if there is none. Requests that exceed the stock of a voxel share it in proportion.
Content is interpolated between voxels before uptake; outside the domain it is 0 and nothing is obtained.

Field `name`: the content. Statistics: uptake and wish (this plant, this step); and of the world, amounts: total,
added (by sources, so far), boundary (net inflow so far), drunk (so far), displaced (by moving obstacles, so far),
runoff (what was added and found no room, so far), balance = (start + added + boundary - drunk - displaced - runoff -
total) / the largest of them; minimum and maximum content.)";

}  // namespace espalier::environment
