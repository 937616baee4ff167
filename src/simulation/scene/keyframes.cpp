#include "simulation/scene/keyframes.h"

#include "espalier/language/model_settings.h"

#include "base/monotone_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::simulation {
namespace {

/// A number that the language reads back to the last bit.
std::string written(double number) {
    return number < 0 ? fmt::format("({})", number) : fmt::format("{}", number);
}

void check_values(const Keyframes& keyframes, const ModelSettings& settings) {
    for (const ModelSetting& setting : settings.list()) {
        if (setting.name != keyframes.name) continue;
        for (const double value : keyframes.values) {
            if (value >= setting.lowest && value <= setting.highest) continue;
            throw UserError(keyframes.place, fmt::format("the setting '{}' ({}) must be {}, not {}", setting.name,
                                                         setting.summary, setting.what_is_allowed(), value));
        }
    }
}

}  // namespace

Keyframes read_keyframes_table(const Settings& table, const char* named) {
    Keyframes keyframes{table.text(named), table.numbers("times"), table.numbers("values"),
                        table.flag_or("spline", false), table.place(named)};
    table.reject_unread();
    const std::vector<double>& times = keyframes.times;
    if (times.empty() || std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) != times.end()) {
        throw UserError(table.place("times"), "'times' must be one number or more, each greater than the one before");
    }
    if (times.size() == keyframes.values.size()) return keyframes;
    throw UserError(table.place("values"), fmt::format("'values' must have a number for each of the {} 'times', not {}",
                                                       times.size(), keyframes.values.size()));
}

double Keyframes::slope(std::size_t k) const {
    const auto rise = [&](std::size_t i) { return (values[i + 1] - values[i]) / (times[i + 1] - times[i]); };
    const std::size_t last = times.size() - 1;
    if (k == 0 || k == last) return rise(k == 0 ? 0 : last - 1);
    return monotone_slope(rise(k - 1), rise(k), times[k] - times[k - 1], times[k + 1] - times[k]);
}

double Keyframes::at(double time) const {
    if (time <= times.front()) return values.front();
    if (time >= times.back()) return values.back();
    const auto k = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin() - 1);
    const double span = times[k + 1] - times[k], t = (time - times[k]) / span, rise = values[k + 1] - values[k];
    if (!spline) return values[k] + t * rise;
    const double a = slope(k) * span, b = slope(k + 1) * span;
    return values[k] + t * (a + t * (3 * rise - 2 * a - b + t * (a + b - 2 * rise)));
}

std::string Keyframes::expression(const std::string& time) const {
    std::string text = written(values.back());
    for (std::size_t k = times.size() - 1; k-- > 0;) {
        const double span = times[k + 1] - times[k], rise = values[k + 1] - values[k];
        const double a = spline ? slope(k) * span : rise, b = spline ? slope(k + 1) * span : rise;
        const std::string t = fmt::format("(({} - {}) / {})", time, written(times[k]), written(span));
        std::string curve = fmt::format("{} + {} * {}", written(values[k]), t, written(rise));
        if (spline) {
            curve = fmt::format("{0} + {1} * ({2} + {1} * ({3} + {1} * {4}))", written(values[k]), t, written(a),
                                written(3 * rise - 2 * a - b), written(a + b - 2 * rise));
        }
        text = fmt::format("{} < {} ? {} : {}", time, written(times[k + 1]), curve, text);
    }
    return fmt::format("({} < {} ? {} : {})", time, written(times.front()), written(values.front()), text);
}

std::vector<Keyframes> read_keyframes(const Settings& plant, const std::filesystem::path& model) {
    std::vector<Keyframes> all;
    if (!plant.has("keyframes")) return all;
    const Defines defines;
    for (const Settings& table : plant.tables("keyframes")) all.push_back(read_keyframes_table(table, "name"));
    const ModelSettings settings = ModelSettings::read(model, defines);
    for (const Keyframes& keyframes : all) check_values(keyframes, settings);
    return all;
}

Defines at_time(Defines defines, const std::vector<Keyframes>& keyframes, double time) {
    for (const Keyframes& each : keyframes) defines[each.name] = fmt::format("{}", each.at(time));
    return defines;
}

}  // namespace espalier::simulation
