#include "environment/soil/richards/parameters.h"

#include "espalier/base/math.h"

#include "base/text.h"
#include "environment/given/weather/weather.h"
#include "environment/soil/hydraulics/heads.h"
#include "environment/soil/richards/read_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numbers>

namespace espalier::environment {
namespace {

const Range head_range = Range::between(-1e6, 1e5);  // cm
const Range rate_range = Range::between(0, 1e5);     // mm/d

/// Heights of a profile, m. `count`: of what belongs to them.
std::vector<double> read_heights(const Settings& table, std::size_t count) {
    std::vector<double> heights = table.numbers("heights");
    if (heights.empty() || heights.size() != count) {
        throw UserError(table.place("heights"),
                        fmt::format("a profile needs as many 'heights' as values: {} and {}", heights.size(), count));
    }
    if (!std::is_sorted(heights.begin(), heights.end(), std::less_equal<>()) &&
        !std::is_sorted(heights.rbegin(), heights.rend(), std::less_equal<>())) {
        throw UserError(table.place("heights"),
                        "the 'heights' (m, y points up) must rise, or fall, from each to the next");
    }
    return heights;
}

SoilBeginning read_profile(const Settings& table) {
    SoilBeginning beginning{SoilBeginning::Kind::head, 0, {}, {}, table.place("heights")};
    if (table.has("heads") == table.has("contents")) {
        throw UserError(beginning.place, "a profile needs one of 'heads' (cm) and 'contents' (m3/m3)");
    }
    if (table.has("heads")) {
        beginning.profile = read_heads(table, "heads", head_range);
    } else {
        beginning.kind = SoilBeginning::Kind::content;
        beginning.profile = table.numbers("contents");
    }
    beginning.heights = read_heights(table, beginning.profile.size());
    if (beginning.heights.front() > beginning.heights.back()) {
        std::reverse(beginning.heights.begin(), beginning.heights.end());
        std::reverse(beginning.profile.begin(), beginning.profile.end());
    }
    return beginning;
}

/// A column of the file for each height.
MeasuredHeads read_measured(const Settings& settings) {
    MeasuredHeads measured;
    if (!settings.has("measured")) return measured;
    const Settings table = settings.table("measured");
    const std::vector<std::string> columns = table.texts_or("columns", {});
    measured.heights = read_heights(table, columns.size());
    for (const std::string& column : columns) {
        measured.heads.push_back(read_head_column(table, column, head_range));
    }
    if (measured.heights.front() > measured.heights.back()) {
        std::reverse(measured.heights.begin(), measured.heights.end());
        std::reverse(measured.heads.begin(), measured.heads.end());
    }
    return measured;
}

std::optional<SoilBeginning> read_beginning(const Settings& settings, const std::string& key) {
    if (!settings.has(key)) return std::nullopt;
    const Settings table = settings.table(key);
    const int given = table.has("head") + table.has("table") + table.has("content") + table.has("heights");
    if (given != 1) {
        throw UserError(settings.place(key),
                        "give one of 'head' (cm), 'table' (m, the height of a water table), 'content' (m3/m3), and "
                        "'heights' (m) with 'heads' or 'contents'");
    }
    const Place place = settings.place(key);
    using Kind = SoilBeginning::Kind;
    if (table.has("heights")) return read_profile(table);
    if (table.has("head")) return SoilBeginning{Kind::head, read_head(table, "head", head_range), {}, {}, place};
    if (table.has("table")) return SoilBeginning{Kind::table, table.number("table"), {}, {}, place};
    return SoilBeginning{Kind::content, table.number("content", Range::between(0, 1)), {}, {}, place};
}

void refuse_overlap(const std::vector<SoilLayer>& layers, const SoilLayer& layer, const Place& place) {
    const auto [bottom, top] = layer.heights;
    for (const SoilLayer& other : layers) {
        const auto [other_bottom, other_top] = other.heights;
        if (layer.rise != other.rise || top <= other_bottom + 1e-9 || other_top <= bottom + 1e-9) continue;
        throw UserError(
            place, fmt::format("this layer, from {} to {} m, overlaps the one from {} to {} m", format_general(bottom),
                               format_general(top), format_general(other_bottom), format_general(other_top)));
    }
}

void read_layers(const Settings& settings, const Settings& named, SoilParameters& parameters) {
    for (const Settings& table : settings.tables("layers")) {
        SoilLayer layer;
        const SoilSpace& space = parameters.space;
        layer.heights =
            LayerHeights::read(table, space.domain.lower.y - space.voxel, space.domain.upper.y + space.voxel);
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

/// The weather's rain and evaporation; what the table says itself counts instead.
void read_weather(const Settings& top, const std::shared_ptr<const Weather>& weather, std::vector<Diagnostic>* warnings,
                  SoilSurface& surface) {
    const auto next_change = [weather](double day) { return weather->next_change(day); };
    if (!top.has("rain")) {
        if (!weather->has_rain() && warnings) {
            warnings->push_back({Diagnostic::Severity::warning, top.place("weather"),
                                 fmt::format("the weather '{}' knows no rain, and none falls: write rain = ... (mm/d) "
                                             "in its table or here",
                                             top.text("weather"))});
        }
        surface.rain = TimeSeries::of([weather](double day) { return weather->rain_rate(day); }, next_change);
    }
    if (top.has("evaporation")) return;
    if (!weather->has_radiation()) {
        throw UserError(top.place("weather"),
                        fmt::format("the weather '{}' knows no radiation, and so no evaporation: give it 'radiation' "
                                    "or a file with a column 'global (W m-2)', or write evaporation = ... (mm/d) here",
                                    top.text("weather")));
    }
    surface.evaporation = TimeSeries::of([weather](double day) { return weather->evaporation_rate(day); }, next_change);
}

/// Null beside a head or a flux, where rain is a key that nothing reads, too.
std::shared_ptr<const Weather> weather_above(const Settings& settings, const Fields& fields) {
    const Settings boundaries = settings.table("boundaries");
    if (!boundaries.is_table("top")) return nullptr;
    const Settings top = boundaries.table("top");
    return top.has("head") || top.has("flux") ? nullptr : Weather::named_by(top, "weather", fields);
}

void read_surface(const Settings& boundaries, const std::shared_ptr<const Weather>& weather,
                  std::vector<Diagnostic>* warnings, SoilSurface& surface) {
    if (!boundaries.is_table("top")) {
        boundaries.choice_or("top", "no-flux", {"no-flux"});
        return;
    }
    const Settings top = boundaries.table("top");
    if (top.has("head")) {
        surface.kind = SoilSurface::Kind::head;
        surface.head = read_head_series(top, "head", head_range);
    } else if (top.has("flux")) {
        surface.kind = SoilSurface::Kind::flux;
        surface.flux = TimeSeries::read(top, "flux", 0, Range::between(-1e5, 1e5));
    } else {
        surface.kind = SoilSurface::Kind::atmosphere;
        surface.rain = TimeSeries::read(top, "rain", 0, rate_range);
        surface.evaporation = TimeSeries::read(top, "evaporation", 0, rate_range);
        if (weather) read_weather(top, weather, warnings, surface);
        surface.dry_limit = read_head_or(top, "dry_limit", -10000, Range::between(-1e6, -1));
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
        floor.flux = TimeSeries::read(table, "flux", 0, Range::between(-1e5, 1e5));
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
        floor.head = read_head_series(table, "head", head_range);
    }
}

void warn_of_unused(const Settings& named, const SoilParameters& parameters, const EnvironmentContext& context) {
    for (const std::string& name : named.keys()) {
        if (parameters.names_in_use.contains(name)) continue;
        if (named.is_table(name)) named.table(name).ignore();
        if (!context.warnings) continue;
        context.warnings->push_back({Diagnostic::Severity::warning, named.place(name),
                                     fmt::format("nothing of '{}' is of the soil '{}'", context.name, name), ""});
    }
}

void read_sides(const Settings& boundaries, SoilParameters& parameters) {
    static const std::array<const char*, 4> names{"left", "right", "back", "front"};
    for (std::size_t side = 0; side < names.size(); ++side) {
        const char* const name = names[side];
        if (!boundaries.is_table(name)) {
            boundaries.choice_or(name, "closed", {"closed"});
            continue;
        }
        const Place place = boundaries.place(name);
        if (parameters.periodic) throw UserError(place, "a side cannot have a head where sides are periodic");
        if (parameters.space.flat && side >= 2) {
            throw UserError(place, fmt::format("a two-dimensional soil has no side '{}'", name));
        }
        const Settings table = boundaries.table(name);
        if (table.has("head") == table.has("table")) {
            throw UserError(place, "give one of 'head' (cm) and 'table' (m, the height of a water table)");
        }
        const bool has_table = table.has("table");
        parameters.sides[side] = {has_table ? SoilSide::Kind::table : SoilSide::Kind::head,
                                  has_table ? TimeSeries::read(table, "table", 0, Range::between(-1e4, 1e4))
                                            : read_head_series(table, "head", head_range)};
    }
}

/// Of values at rising places; constant beyond them.
double between(const std::vector<double>& places, double place, const std::function<double(std::size_t)>& value) {
    const auto after = std::upper_bound(places.begin(), places.end(), place);
    if (after == places.begin()) return value(0);
    if (after == places.end()) return value(places.size() - 1);
    const auto i = static_cast<std::size_t>(after - places.begin());
    return value(i - 1) + (value(i) - value(i - 1)) * (place - places[i - 1]) / (places[i] - places[i - 1]);
}

}  // namespace

double SoilBeginning::at(double height) const {
    if (!profile.empty()) return between(heights, height, [&](std::size_t i) { return profile[i]; });
    return kind == Kind::table ? 100 * (value - height) : value;
}

double MeasuredHeads::at(double height, double day) const {
    return between(heights, height, [&](std::size_t i) { return heads[i].at(day); });
}

OutsideSoil read_outside(const Settings& settings) {
    const std::string word = settings.choice_or("outside", "stop growing", {"stop growing", "ignore", "error"});
    if (word == "error") return OutsideSoil::error;
    return word == "ignore" ? OutsideSoil::ignored : OutsideSoil::root_ends;
}

SoilParameters read_soil_parameters(Settings& settings, const EnvironmentContext& context, bool is_still,
                                    const Fields& fields) {
    SoilParameters parameters;
    const std::shared_ptr<const Weather> weather = is_still ? nullptr : weather_above(settings, fields);
    parameters.is_still = is_still;
    parameters.space = SoilSpace::read(settings, context);
    parameters.days = read_days(settings, weather.get());
    const Settings named = settings.table("soils");
    parameters.kind = read_soil_kind(settings, "soil", named, parameters);
    read_layers(settings, named, parameters);
    read_map(settings, named, parameters);
    warn_of_unused(named, parameters, context);
    const std::optional<SoilBeginning> beginning = read_beginning(settings, "initial");
    parameters.beginning = beginning.value_or(SoilBeginning{});
    if (is_still) {
        parameters.measured = read_measured(settings);
        if (parameters.measured.any() && beginning) {
            throw UserError(settings.place("initial"), "'measured' heads stand instead of 'initial'");
        }
    }

    const Settings boundaries = settings.table("boundaries");
    if (!is_still) {
        read_surface(boundaries, weather, context.warnings, parameters.surface);
        read_floor(boundaries, parameters.floor);
    }
    parameters.periodic = boundaries.choice_or("sides", "closed", {"closed", "periodic"}) == "periodic";
    parameters.outside = read_outside(settings);
    parameters.max_substep = settings.number_or("max_substep", 1, Range{1e-6, 1e4, false});
    parameters.wilting_head = read_head_or(settings, "wilting_head", -15000, Range::between(-1e6, -1));
    if (!is_still) {
        read_sides(boundaries, parameters);
        parameters.accuracy = settings.number_or("accuracy", 0.005, Range{0, 0.5, true});
    }
    parameters.querying = SoilQuerying::read(settings, parameters.space.voxel, !is_still);
    if (is_still && parameters.querying.depletion) {
        throw UserError(settings.place("depletion"),
                        "what is taken from a soil of model = \"still\" is put back: it "
                        "knows no depletion");
    }
    return parameters;
}

void warn_of_root_outside(std::vector<Diagnostic>*& warnings, const SoilParameters& soil, const std::string& process,
                          std::uint32_t plant, const glm::dvec3& point) {
    if (!warnings) return;
    const bool ends = soil.outside == OutsideSoil::root_ends;
    warnings->push_back(
        {Diagnostic::Severity::warning, soil.space.place,
         fmt::format("a root of plant {} leaves the soil of '{}' at ({:.3g}, {:.3g}, {:.3g}): {}. Tips can ask how far "
                     "the nearest wall is, and a larger domain or periodic sides give them room; outside = \"error\" "
                     "ends the run here",
                     plant, process, point.x, point.y, point.z,
                     ends ? "what grows on outside takes no part" : "it takes nothing up outside"),
         ""});
    warnings = nullptr;
}

}  // namespace espalier::environment
