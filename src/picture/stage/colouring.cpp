#include "picture/stage/colouring.h"

#include "espalier/base/error.h"

#include "archive/meshes/surface_mesh.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace espalier::picture {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_names = 16;

struct Array {
    const char* name;
    const char* title;
    bool is_category;
    double (*value)(const FrameGeometry&, int step, std::size_t point);
};

constexpr Array arrays[] = {
    {"birth", "step of birth", false,
     [](const FrameGeometry& g, int, std::size_t i) { return double(g.of_points.births[i]); }},
    {"age", "age (steps)", false,
     [](const FrameGeometry& g, int step, std::size_t i) { return double(step - g.of_points.births[i]); }},
    {"order", "order of branching", false,
     [](const FrameGeometry& g, int, std::size_t i) { return double(g.of_points.orders[i]); }},
    {"radius", "radius (m)", false, [](const FrameGeometry& g, int, std::size_t i) { return double(g.radii[i]); }},
    {"height", "height (m)", false, [](const FrameGeometry& g, int, std::size_t i) { return double(g.points[i].y); }},
    {"plant", "plant", true, [](const FrameGeometry& g, int, std::size_t i) { return double(g.of_points.plants[i]); }},
    {"symbol", "symbol", true,
     [](const FrameGeometry& g, int, std::size_t i) { return double(g.of_points.symbols[i]); }},
    {"kind", "kind", true, [](const FrameGeometry& g, int, std::size_t i) { return double(g.of_points.kinds[i]); }},
    {"colour", "colour", true,
     [](const FrameGeometry& g, int, std::size_t i) { return double(g.of_points.colours[i]); }},
};

const Array* array_of(const std::string& name) {
    const auto found =
        std::find_if(std::begin(arrays), std::end(arrays), [&](const Array& a) { return a.name == name; });
    return found == std::end(arrays) ? nullptr : found;
}

/// Chosen parameters that something drawn has; answers of queries alone are drawn nowhere.
std::vector<std::string> parameter_names(const RecordedRun& run) {
    std::vector<std::string> names;
    const auto& frames = run.frames();
    const auto with_plants =
        std::find_if(frames.rbegin(), frames.rend(), [](const auto& frame) { return !frame.plants.empty(); });
    if (with_plants == frames.rend()) return names;
    const FrameGeometry geometry = run.geometry(*with_plants);
    for (const auto& [name, values] : geometry.parameters) {
        const auto is_drawn = [&geometry, &values = values](std::size_t i) {
            return std::isfinite(values[i]) && geometry.of_points.kinds[i] != Kind::query;
        };
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!is_drawn(i)) continue;
            names.push_back(name);
            break;
        }
    }
    return names;
}

constexpr const char* kind_names[] = {"query", "axis", "polygon", "organ", "cylinder", "patch", "label"};

}  // namespace

Colouring::Colouring(const RecordedRun& run, const std::string& name) : name_(name) {
    if (is_natural() || array_of(name)) return;
    const std::vector<std::string> known = names(run);
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    if (!is_known) {
        throw UserError(fmt::format("{} has no array '{}' to colour by{}; it has {}", run.folder().string(), name,
                                    did_you_mean(name, known), fmt::join(known, ", ")));
    }
    const std::vector<std::string> fields = run.field_names();
    for (const std::string& field : fields) {
        if (name == field || name == "field." + field) field_ = field;
    }
    const std::vector<std::string> parameters = parameter_names(run);
    if (std::find(parameters.begin(), parameters.end(), name) != parameters.end()) field_.clear();
    if (!field_.empty()) field_unit_ = run.field(run.frames().back(), field_).unit;
}

std::vector<std::string> Colouring::names_of_every_run() {
    std::vector<std::string> result{"natural"};
    for (const Array& array : arrays) result.emplace_back(array.name);
    return result;
}

std::vector<std::string> Colouring::names(const RecordedRun& run) {
    std::vector<std::string> result = names_of_every_run();
    const auto add = [&](const std::string& name) {
        if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
    };
    for (const std::string& parameter : parameter_names(run)) add(parameter);
    for (const std::string& field : run.field_names()) {
        const bool taken = std::find(result.begin(), result.end(), field) != result.end();
        add(taken ? "field." + field : field);
    }
    return result;
}

bool Colouring::is_category() const {
    const Array* array = array_of(name_);
    return array && array->is_category;
}

std::vector<double> Colouring::values(const RecordedRun& run, const RecordedFrame& frame,
                                      const FrameGeometry& geometry) const {
    std::vector<double> values(geometry.points.size(), nothing);
    if (const Array* array = array_of(name_)) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = array->value(geometry, frame.step, i);
    } else if (!field_.empty()) {
        if (!frame.fields.contains(field_)) return values;
        const RecordedField field = run.field(frame, field_);
        tbb::parallel_for(std::size_t{0}, values.size(),
                          [&](std::size_t i) { values[i] = sampled(field, glm::dvec3(geometry.points[i])); });
    } else if (const auto found = geometry.parameters.find(name_); found != geometry.parameters.end()) {
        values.assign(found->second.begin(), found->second.end());
    }
    return values;
}

std::vector<Rgb> Colouring::colours(const RecordedRun& run, const RecordedFrame& frame, const FrameGeometry& geometry,
                                    const std::array<double, 2>& range) const {
    std::vector<Rgb> colours(geometry.points.size());
    if (is_natural()) {
        for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = colour_of(geometry.of_points, i);
        return colours;
    }
    const std::vector<double> numbers = values(run, frame, geometry);
    const double span = range[1] > range[0] ? range[1] - range[0] : 1;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        if (!std::isfinite(numbers[i])) {
            colours[i] = no_value;
        } else if (is_category()) {
            colours[i] = category_colour(static_cast<std::size_t>(numbers[i]));
        } else {
            colours[i] = along(viridis(), (numbers[i] - range[0]) / span);
        }
    }
    return colours;
}

std::string Colouring::name_of(const RecordedRun& run, const FrameGeometry& geometry, std::size_t value) const {
    if (name_ == "plant") return run.plants().at(value).name;
    if (name_ == "symbol") return geometry.symbol_names.at(value);
    if (name_ == "kind") return kind_names[value];
    return std::to_string(value);
}

/// With its unit: "light.absorbed (mol)".
std::string Colouring::title(const FrameGeometry& geometry) const {
    if (const Array* array = array_of(name_)) return array->title;
    const auto found = geometry.units.find(name_);
    const std::string& unit = field_.empty() && found != geometry.units.end() ? found->second : field_unit_;
    return with_unit(name_, unit);
}

std::optional<ColourKey> Colouring::key(const RecordedRun& run, const FrameGeometry& geometry,
                                        const std::array<double, 2>& range) const {
    if (is_natural()) return std::nullopt;
    const Array* array = array_of(name_);
    ColourKey key{title(geometry), range, {}, {}};
    if (!is_category()) {
        key.colours = viridis();
        return key;
    }
    std::set<std::size_t> present;
    for (std::size_t i = 0; i < geometry.points.size(); ++i) {
        if (geometry.of_points.kinds[i] == Kind::query) continue;
        present.insert(static_cast<std::size_t>(array->value(geometry, 0, i)));
        if (present.size() > most_names) return std::nullopt;
    }
    for (const std::size_t value : present)
        key.names.emplace_back(name_of(run, geometry, value), category_colour(value));
    return key;
}

std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit);
}

std::optional<std::array<double, 2>> range_of(const std::vector<double>& values) {
    std::optional<std::array<double, 2>> range;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        if (!range) range = {value, value};
        (*range)[0] = std::min((*range)[0], value);
        (*range)[1] = std::max((*range)[1], value);
    }
    return range;
}

double sampled(const RecordedField& field, const glm::dvec3& point) {
    std::array<int, 3> low{}, high{};
    std::array<double, 3> share{};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double at = (point[k] - field.origin[k]) / field.voxel[k];
        if (!(at >= -0.5 && at <= field.size[k] - 0.5)) return nothing;  // within the voxels, not only their centres
        const double inside = std::clamp(at, 0.0, double(field.size[k] - 1));
        low[i] = static_cast<int>(inside);
        high[i] = std::min(low[i] + 1, field.size[k] - 1);
        share[i] = inside - low[i];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<int, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) {
            const bool far = corner >> k & 1;
            at[k] = far ? high[k] : low[k];
            weight *= far ? share[k] : 1 - share[k];
        }
        if (weight > 0) sum += weight * field.at(at[0], at[1], at[2]);
    }
    return sum;
}

}  // namespace espalier::picture
