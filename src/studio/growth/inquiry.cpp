#include "studio/growth/inquiry.h"

#include "espalier/lsystem/derivation.h"

#include "base/text.h"
#include "studio/packets/packet_parts.h"
#include "timeline/meshes/chosen_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace espalier::studio {
namespace {

void require_step(const KeptSteps& steps, int step) {
    if (!steps.has(step)) throw UserError(fmt::format("step {} has not been grown", step));
}

/// A plant's string at one step, with what is needed to read it.
struct PlantString {
    ModuleString string;
    const Model& model;
    std::vector<std::size_t> offsets = parameter_offsets(string, model.alphabet);

    std::span<const double> parameters(std::size_t module) const {
        return std::span(string.parameters).subspan(offsets[module], offsets[module + 1] - offsets[module]);
    }
    std::string text(std::size_t module) const {
        std::string text = model.alphabet.name(string.letters[module]);
        const std::span<const double> values = parameters(module);
        for (std::size_t i = 0; i < values.size(); ++i)
            text.append(i == 0 ? "(" : ",").append(format_general(values[i]));
        return values.empty() ? text : text + ")";
    }
    std::optional<std::size_t> find(Identity identity) const {
        for (std::size_t i = 0; i < string.births.size(); ++i) {
            if (string.identity(i) == identity) return i;
        }
        return std::nullopt;
    }
};

// Formal parameters of a declared module, or of the first production with the letter in its predecessor.
std::vector<std::string> parameter_names(const Model& model, LetterId letter) {
    const auto arity = static_cast<std::size_t>(model.alphabet.arity(letter));
    for (const ModuleDeclaration& declared : model.modules) {
        if (declared.name == model.alphabet.name(letter) && declared.parameters.size() == arity)
            return declared.parameters;
    }
    for (const LSystem& system : model.systems) {
        for (const Production& production : system.productions) {
            for (const ModulePattern& pattern : production.strict) {
                const auto first = production.formals.begin() + pattern.first_formal;
                if (pattern.letter == letter) return {first, first + static_cast<std::ptrdiff_t>(arity)};
            }
        }
    }
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= arity; ++i) names.push_back(fmt::format("parameter {}", i));
    return names;
}

/// What `pick` asks, gathered step by step.
class Inquiry {
public:
    Inquiry(const Scene& scene, const KeptSteps& steps, std::span<const OrganColumn> organs, int step,
            std::uint32_t module)
        : scene_(scene), steps_(steps), organs_(organs), step_(step) {
        require_step(steps, step);
        const std::vector<ModuleString> strings = steps.strings(step);
        for (plant_ = 0; plant_ < strings.size() && module - first_ >= strings[plant_].size(); ++plant_) {
            first_ += static_cast<std::uint32_t>(strings[plant_].size());
        }
        if (plant_ == strings.size()) throw UserError(fmt::format("step {} has no module {}", step, module));
        module_ = module - first_;
    }

    Picked answer() const {
        const PlantString now = at(step_);
        const LetterId letter = now.string.letters[module_];
        Picked picked;
        picked.plant = scene_.plants[plant_].name;
        picked.symbol = now.model.alphabet.name(letter);
        picked.text = now.text(module_);
        picked.names = parameter_names(now.model, letter);
        picked.parameters = numbers(now.parameters(module_));
        if (!now.string.has_lineage()) return picked;
        const Identity identity = now.string.identity(module_);
        picked.identity = name(identity);
        picked.born = now.string.step_of_birth(module_);
        picked.parent = parent(now);
        picked.children = children(now, identity);
        picked.siblings = siblings(now);
        picked.history = history(now, identity);
        picked.day = day(identity);
        picked.places = places(now, identity);
        return picked;
    }

private:
    PlantString at(int step) const { return {steps_.string(step, plant_), source_of(*scene_.plants[plant_].model)}; }

    static std::string name(Identity identity) { return fmt::format("{:016x}", identity); }

    static std::vector<Nullable<double>> numbers(std::span<const double> values) {
        return {values.begin(), values.end()};
    }

    Nullable<PickedParent> parent(const PlantString& now) const {
        const Identity identity = now.string.parent(module_);
        if (identity == 0) return {};
        PickedParent parent;
        parent.identity = name(identity);
        if (const std::optional<std::size_t> here = now.find(identity)) parent.module = first_ + *here;
        const int before = static_cast<int>(now.string.step_of_birth(module_)) - 1;
        if (before < 0 || !steps_.has(before)) return parent;
        const PlantString then = at(before);
        const std::optional<std::size_t> found = then.find(identity);
        if (!found) return parent;
        parent.symbol = then.model.alphabet.name(then.string.letters[*found]);
        parent.text = then.text(*found);
        parent.born = then.string.step_of_birth(*found);
        return parent;
    }

    static std::size_t children(const PlantString& now, Identity identity) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < now.string.size(); ++i) count += now.string.parent(i) == identity;
        return count;
    }

    std::vector<std::size_t> siblings(const PlantString& now) const {
        std::vector<std::size_t> modules;
        const auto born = [&](std::size_t module) { return now.string.siblings[now.string.births[module].siblings]; };
        const Siblings own = born(module_);
        for (std::size_t i = 0; i < now.string.size(); ++i) {
            if (i != module_ && born(i).is_same_as(own)) modules.push_back(first_ + i);
        }
        return modules;
    }

    // At most a hundred steps since its birth, at even distances.
    PickedHistory history(const PlantString& now, Identity identity) const {
        const int born = static_cast<int>(now.string.step_of_birth(module_));
        const int stride = std::max(1, (step_ - born) / 100);
        PickedHistory history;
        for (int step = step_ - (step_ - born) / stride * stride; step <= step_; step += stride) {
            if (!steps_.has(step)) continue;
            const PlantString then = at(step);
            const std::optional<std::size_t> found = then.find(identity);
            if (!found) continue;
            history.steps.push_back(step);
            history.parameters.push_back(numbers(then.parameters(*found)));
        }
        return history;
    }

    std::optional<PickedDay> day(Identity identity) const {
        const std::optional<StepsOfDay> of_day = steps_of_day(scene_.dt, scene_.time_unit, step_);
        if (!of_day || organs_.empty()) return std::nullopt;
        PickedDay course;
        std::vector<std::vector<Nullable<double>>> rows(organs_.size());
        std::vector<bool> is_known(organs_.size(), false);
        for (int step = of_day->first; step <= of_day->last; step += of_day->stride) {
            const std::optional<std::size_t> module = steps_.has(step) ? number_at(step, identity) : std::nullopt;
            if (!module) continue;
            course.steps.push_back(step);
            course.hours.push_back(of_day->hour_at_end_of(step));
            for (std::size_t i = 0; i < organs_.size(); ++i) {
                const float value = number_in(steps_.organs().message(organs_[i].name, step, 0), *module);
                is_known[i] = is_known[i] || !std::isnan(value);
                rows[i].push_back(std::isnan(value) ? Nullable<double>() : Nullable<double>(value));
            }
        }
        for (std::size_t i = 0; i < organs_.size(); ++i) {
            if (!is_known[i]) continue;
            course.names.push_back(organs_[i].name);
            course.units.push_back(organs_[i].unit);
            course.values.push_back(std::move(rows[i]));
        }
        return course.names.empty() ? std::nullopt : std::optional(course);
    }

    /// Through all plants.
    std::optional<std::size_t> number_at(int step, Identity identity) const {
        const std::vector<ModuleString> strings = steps_.strings(step);
        std::size_t before = 0;
        for (std::size_t plant = 0; plant < plant_; ++plant) before += strings[plant].size();
        const ModuleString& string = strings[plant_];
        for (std::size_t i = 0; i < string.births.size(); ++i) {
            if (string.identity(i) == identity) return before + i;
        }
        return std::nullopt;
    }

    // Productions that replace what stood here one step ago, itself or its parent, by something with its letter.
    std::vector<PickedPlace> places(const PlantString& now, Identity identity) const {
        std::vector<PickedPlace> places;
        if (step_ == 0 || !steps_.has(step_ - 1)) return places;
        const PlantString before = at(step_ - 1);
        std::optional<std::size_t> maker = before.find(identity);
        if (!maker) maker = before.find(now.string.parent(module_));
        std::set<LetterId> predecessors;
        if (maker) predecessors.insert(before.string.letters[*maker]);
        const LetterId letter = now.string.letters[module_];
        for (const LSystem& system : now.model.systems) {
            add_places(system.productions, predecessors, letter, places);
            add_places(system.decomposition.productions, {}, letter, places);
        }
        return places;
    }

    // `predecessors`: any letter if empty.
    static void add_places(const std::vector<Production>& productions, const std::set<LetterId>& predecessors,
                           LetterId letter, std::vector<PickedPlace>& places) {
        for (const Production& production : productions) {
            const bool applies = predecessors.empty() ||
                                 std::any_of(production.strict.begin(), production.strict.end(),
                                             [&](const auto& module) { return predecessors.contains(module.letter); });
            const bool makes = std::any_of(production.successor.begin(), production.successor.end(),
                                           [&](const auto& module) { return module.letter == letter; });
            if (!applies || !makes) continue;
            places.push_back({production.place.file, production.place.line, production.place.column});
        }
    }

    const Scene& scene_;
    const KeptSteps& steps_;
    const std::span<const OrganColumn> organs_;
    const int step_;
    std::size_t plant_ = 0, module_ = 0;
    std::uint32_t first_ = 0;  ///< number of the plant's first module
};

/// Numbers of the modules of one plant.
using ColumnOfPlant = void (*)(const PlantString& plant, std::size_t number, int step, std::vector<float>& values);

void put_age(const PlantString& plant, std::size_t, int step, std::vector<float>& values) {
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        values.push_back(plant.string.has_lineage() ? float(step) - float(plant.string.step_of_birth(i)) : no_number);
    }
}

void put_plant(const PlantString& plant, std::size_t number, int, std::vector<float>& values) {
    values.insert(values.end(), plant.string.size(), float(number));
}

void put_symbol(const PlantString& plant, std::size_t, int, std::vector<float>& values) {
    for (const LetterId letter : plant.string.letters) values.push_back(plant.model.alphabet.symbol_of(letter));
}

template <std::size_t N>
void put_parameter(const PlantString& plant, std::size_t, int, std::vector<float>& values) {
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        const std::span<const double> parameters = plant.parameters(i);
        values.push_back(parameters.size() > N ? static_cast<float>(parameters[N]) : no_number);
    }
}

const std::vector<std::pair<std::string, ColumnOfPlant>>& columns() {
    static const std::vector<std::pair<std::string, ColumnOfPlant>> all{
        {"age", put_age},
        {"plant", put_plant},
        {"symbol", put_symbol},
        {"parameter 1", put_parameter<0>},
        {"parameter 2", put_parameter<1>},
        {"parameter 3", put_parameter<2>},
        {"parameter 4", put_parameter<3>},
        {"parameter 5", put_parameter<4>},
        {"parameter 6", put_parameter<5>},
    };
    return all;
}

// The names that the scene gives to parameters. What `run` would refuse is told when it is run.
std::vector<timeline::ChosenParameter> named_parameters(const Scene& scene) {
    try {
        return timeline::read_chosen_parameters(scene.timeline.table("parameters"));
    } catch (const UserError&) {
        return {};
    }
}

void put_named(const timeline::ChosenParameter& chosen, const PlantString& plant, std::vector<float>& values) {
    const timeline::ParameterSlots slots(chosen, plant.model.alphabet);
    for (std::size_t i = 0; i < plant.string.size(); ++i) {
        const int slot = slots.find(plant.string, i);
        values.push_back(slot < 0 ? no_number
                                  : static_cast<float>(plant.parameters(i)[static_cast<std::size_t>(slot)]));
    }
}

int most_parameters(const Scene& scene) {
    int most = 0;
    for (const Plant& plant : scene.plants) {
        for (const int arity : source_of(*plant.model).alphabet.arities()) most = std::max(most, arity);
    }
    return most;
}

}  // namespace

Picked module_info(const Scene& scene, const KeptSteps& steps, std::span<const OrganColumn> organs, int step,
                   std::uint32_t module) {
    return Inquiry(scene, steps, organs, step, module).answer();
}

std::optional<StepsOfDay> steps_of_day(double dt, const std::string& unit, int step) {
    const bool in_days = unit == "day" || unit == "days" || unit == "d";
    const bool in_hours = unit == "hour" || unit == "hours" || unit == "h";
    StepsOfDay day;
    day.hours = in_days ? 24 * dt : in_hours ? dt : 0;
    if (!(day.hours > 0 && day.hours <= 6)) return std::nullopt;
    constexpr double slack = 1e-6;  // of a step
    const double steps_in_day = 24 / day.hours;
    const double number = std::floor((std::max(step, 1) - 1 + slack) / steps_in_day);  // of the day
    day.first = 1 + static_cast<int>(std::ceil(number * steps_in_day - slack));
    day.last = static_cast<int>(std::ceil((number + 1) * steps_in_day - slack));
    day.before = (day.first - 1) * day.hours - 24 * number;
    day.stride = std::max(1, (day.last - day.first + 1) / 100);
    return day;
}

std::vector<std::string> column_names(const Scene& scene) {
    constexpr std::size_t of_all_models = 3;
    std::vector<std::string> names;
    const auto parameters = static_cast<std::size_t>(most_parameters(scene));
    for (const auto& [name, put] : columns()) {
        if (names.size() < of_all_models + parameters) names.push_back(name);
    }
    const std::vector<timeline::ChosenParameter> chosen = named_parameters(scene);
    for (auto named = chosen.rbegin(); named != chosen.rend(); ++named) {
        if (std::find(names.begin(), names.end(), named->name) == names.end()) names.insert(names.begin(), named->name);
    }
    return names;
}

std::string column(const Scene& scene, const KeptSteps& steps, std::uint32_t growth, int step,
                   const std::string& name) {
    require_step(steps, step);
    const auto known =
        std::find_if(columns().begin(), columns().end(), [&](const auto& entry) { return entry.first == name; });
    const std::vector<timeline::ChosenParameter> chosen = named_parameters(scene);
    const auto named = std::find_if(chosen.begin(), chosen.end(), [&](const auto& one) { return one.name == name; });
    if (known == columns().end() && named == chosen.end()) throw UserError(fmt::format("modules have no '{}'", name));
    std::vector<float> values;
    std::vector<ModuleString> strings = steps.strings(step);
    for (std::size_t i = 0; i < strings.size(); ++i) {
        const PlantString plant{std::move(strings[i]), source_of(*scene.plants[i].model)};
        if (known == columns().end()) {
            put_named(*named, plant, values);
        } else {
            known->second(plant, i, step, values);
        }
    }
    return column_message(growth, step, name, values);
}

}  // namespace espalier::studio
