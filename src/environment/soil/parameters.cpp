#include "environment/soil/parameters.h"

#include "espalier/base/math.h"

#include "base/text.h"
#include "environment/soil/read_kinds.h"

#include <fmt/format.h>

#include <numbers>

namespace espalier::environment {
namespace {

const Range head_range = Range::between(-1e6, 1e5);  // cm
const Range rate_range = Range::between(0, 1e5);     // mm/d

std::optional<SoilBeginning> read_beginning(const Settings& settings, const std::string& key) {
    if (!settings.has(key)) return std::nullopt;
    const Settings table = settings.table(key);
    const int given = table.has("head") + table.has("table") + table.has("content");
    if (given != 1) {
        throw UserError(settings.place(key),
                        "give one of 'head' (cm), 'table' (m, the height of a water table) and "
                        "'content' (m3/m3)");
    }
    if (table.has("head")) return SoilBeginning{SoilBeginning::Kind::head, table.number("head", head_range)};
    if (table.has("table")) return SoilBeginning{SoilBeginning::Kind::table, table.number("table")};
    return SoilBeginning{SoilBeginning::Kind::content, table.number("content", Range::between(0, 1))};
}

void refuse_overlap(const std::vector<SoilLayer>& layers, const SoilLayer& layer, const Place& place) {
    for (const SoilLayer& other : layers) {
        if (layer.rise != other.rise || layer.top <= other.bottom + 1e-9 || other.top <= layer.bottom + 1e-9) continue;
        throw UserError(place, fmt::format("this layer, from {} to {} m, overlaps the one from {} to {} m",
                                           format_general(layer.bottom), format_general(layer.top),
                                           format_general(other.bottom), format_general(other.top)));
    }
}

void read_layers(const Settings& settings, const Settings& named, SoilParameters& parameters) {
    for (const Settings& table : settings.tables("layers")) {
        SoilLayer layer;
        layer.bottom = table.number_or("bottom", parameters.water.domain.lower.y - parameters.water.voxel);
        layer.top = table.number_or("top", parameters.water.domain.upper.y + parameters.water.voxel);
        if (layer.bottom >= layer.top) {
            throw UserError(table.place("top"), "a layer's 'top' must be higher than its 'bottom' (y points up)");
        }
        layer.rise = math::tan(table.number_or("slope", 0, Range::between(-80, 80)) * std::numbers::pi / 180);
        if (table.has("soil")) layer.kind = read_soil_kind(table, "soil", named, parameters);
        layer.beginning = read_beginning(table, "initial");
        refuse_overlap(parameters.layers, layer, table.place("top"));
        parameters.layers.push_back(layer);
    }
    for (Settings& table : settings.tables("regions")) {
        SoilRegion region{read_shape(table), {}, {}};
        if (table.has("soil")) region.kind = read_soil_kind(table, "soil", named, parameters);
        region.beginning = read_beginning(table, "initial");
        parameters.regions.push_back(region);
    }
    for (Settings& table : settings.tables("sources")) {
        parameters.inflows.push_back({read_shape(table), table.number("rate", Range::between(0, 100)), table.place()});
    }
}

void read_map(const Settings& settings, const Settings& named, SoilParameters& parameters) {
    if (!settings.has("map")) return;
    const Settings map = settings.table("map");
    for (const std::string& name : map.texts_or("soils", {})) {
        parameters.map_kinds.push_back(find_soil_kind(name, map.place("soils"), named, parameters));
    }
    if (parameters.map_kinds.empty()) throw UserError(map.place(), "a map needs soils = [\"...\", ...]");
    if (map.has("file") == map.has("field")) {
        throw UserError(map.place(), "a map needs one of 'file' (a picture or a table) and 'field'");
    }
    if (map.has("file")) {
        parameters.map_file = TextureMap(map, parameters.map_kinds.size());
    } else {
        parameters.map_field = map.text("field");
    }
}

void read_surface(const Settings& boundaries, SoilSurface& surface) {
    if (!boundaries.is_table("top")) {
        boundaries.choice_or("top", "no-flux", {"no-flux"});
        return;
    }
    const Settings top = boundaries.table("top");
    if (top.has("head")) {
        surface.kind = SoilSurface::Kind::head;
        surface.head = SoilSeries::read(top, "head", 0, head_range);
    } else if (top.has("flux")) {
        surface.kind = SoilSurface::Kind::flux;
        surface.flux = SoilSeries::read(top, "flux", 0, Range::between(-1e5, 1e5));
    } else {
        surface.kind = SoilSurface::Kind::atmosphere;
        surface.rain = SoilSeries::read(top, "rain", 0, rate_range);
        surface.evaporation = SoilSeries::read(top, "evaporation", 0, rate_range);
        surface.dry_limit = top.number_or("dry_limit", -10000, Range::between(-1e6, -1));
        surface.ponding = top.number_or("ponding", 0, rate_range);
    }
}

void read_floor(const Settings& boundaries, SoilFloor& floor) {
    if (!boundaries.is_table("bottom")) {
        const std::string word = boundaries.choice_or("bottom", "no-flux", {"no-flux", "free-drainage", "seepage"});
        if (word == "free-drainage") floor.kind = SoilFloor::Kind::free_drainage;
        if (word == "seepage") floor.kind = SoilFloor::Kind::seepage;
        return;
    }
    const Settings table = boundaries.table("bottom");
    if (table.has("flux")) {
        floor.kind = SoilFloor::Kind::flux;
        floor.flux = SoilSeries::read(table, "flux", 0, Range::between(-1e5, 1e5));
        return;
    }
    floor.kind = SoilFloor::Kind::head;
    if (table.has("table")) {
        floor.table = table.number("table");
    } else {
        if (!table.has("head")) {
            throw UserError(table.place(),
                            "give 'head' (cm), 'table' (m, the height of the water table) or 'flux' (mm/d)");
        }
        floor.head = SoilSeries::read(table, "head", 0, head_range);
    }
}

}  // namespace

SoilParameters read_soil_parameters(Settings& settings, const EnvironmentContext& context) {
    SoilParameters parameters;
    read_water_space(settings, context, parameters.water);
    parameters.water.unit = "m3/m3";
    parameters.days = settings.number_or("days", 1, Range{0, 1e6, true});
    const Settings named = settings.table("soils");
    parameters.kind = read_soil_kind(settings, "soil", named, parameters);
    read_layers(settings, named, parameters);
    read_map(settings, named, parameters);
    named.ignore();
    parameters.beginning = read_beginning(settings, "initial").value_or(SoilBeginning{});

    const Settings boundaries = settings.table("boundaries");
    read_surface(boundaries, parameters.surface);
    read_floor(boundaries, parameters.floor);
    parameters.periodic = boundaries.choice_or("sides", "closed", {"closed", "periodic"}) == "periodic";
    parameters.accuracy = settings.number_or("accuracy", 0.005, Range{0, 0.5, true});
    parameters.max_substep = settings.number_or("max_substep", 1, Range{1e-6, 1e4, false});
    parameters.wilting_head = settings.number_or("wilting_head", -15000, Range::between(-1e6, -1));
    read_water_queries(settings, parameters.water);
    return parameters;
}

}  // namespace espalier::environment
