#include "simulation/scene/plant_table.h"

#include "espalier/base/random.h"
#include "espalier/base/settings.h"
#include "espalier/language/measured_plants.h"
#include "espalier/turtle/symbol.h"

#include "language/measured/units.h"
#include "simulation/object/side_files.h"
#include "simulation/scene/insertion.h"
#include "simulation/scene/keyframes.h"
#include "simulation/scene/scene_keyframes.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <limits>
#include <set>
#include <tuple>

namespace espalier::simulation {
namespace {

std::vector<std::string> or_none(std::vector<std::string> words) {
    words.insert(words.begin(), "");
    return words;
}

/// How the file is read: `unit`, `up`, `pixel` and `plants`.
MeasuredOptions read_measured_options(const Settings& plant) {
    MeasuredOptions options;
    options.unit = plant.choice_or("unit", "", or_none(language::measured::length_units()));
    options.up = plant.choice_or("up", "", or_none(language::measured::upward_axes()));
    if (plant.has("pixel")) options.pixel = 0.001 * plant.number("pixel", Range::positive());
    if (plant.has("plants")) {
        options.separate = plant.choice_or("plants", "separate", {"separate", "together"}) == "separate";
    }
    if (options.pixel && !options.unit.empty()) {
        throw UserError(plant.place("pixel"), "give either 'pixel' or 'unit': the width of a pixel is in millimetres");
    }
    return options;
}

/// What is taken from the places in the file, m: none, or with `begin = "position"` where its first plant begins.
glm::dvec3 read_measured_shift(const Settings& plant, const MeasuredPlants& plants) {
    const bool moves = plant.choice_or("begin", "file", {"file", "position"}) == "position";
    return moves ? plants.plants.front().base : glm::dvec3(0);
}

constexpr double most_plants = 1e6;

Tropism read_tropism(const Settings& table) {
    Tropism tropism;
    tropism.direction = table.vector_or("direction", tropism.direction);
    tropism.angle = glm::radians(table.number_or("angle", 0));
    tropism.elasticity = table.number_or("elasticity", 0);
    tropism.elasticity_step = table.number_or("elasticity_step", 0);
    tropism.torque = table.flag_or("torque", false);
    if (glm::length(tropism.direction) == 0) {
        throw UserError(table.place("direction"), "'direction' of a tropism must not be zero");
    }
    table.reject_unread();
    return tropism;
}

// What the table does not say stays as the view file has it.
TurtleSettings read_turtle(const Settings& table, TurtleSettings turtle) {
    const auto colour_index = [&](const char* key, int fallback) {
        return static_cast<int>(table.integer_or(key, fallback, Range::between(0, 65535)));
    };
    turtle.angle = glm::radians(table.number_or("angle", glm::degrees(turtle.angle)));
    if (table.has("line_width")) turtle.line_width = table.number("line_width", Range::not_negative());
    turtle.line_width_increment = table.number_or("line_width_increment", turtle.line_width_increment);
    turtle.colour = colour_index("colour", turtle.colour);
    turtle.colour_increment = colour_index("colour_increment", turtle.colour_increment);
    turtle.scale = table.number_or("scale", turtle.scale, Range::positive());
    turtle.scale_multiplier = table.number_or("scale_multiplier", turtle.scale_multiplier, Range::positive());
    turtle.past_cut = table.flag_or("past_cut", turtle.past_cut);
    if (table.has("tropism")) turtle.tropisms.clear();
    for (const Settings& tropism : table.tables("tropism")) turtle.tropisms.push_back(read_tropism(tropism));
    table.reject_unread();
    return turtle;
}

// Rows run along z, columns along x, and the middle of the stand is at `position`.
std::vector<glm::dvec3> grid_offsets(const Settings& grid, std::uint64_t seed, std::uint32_t stream) {
    const auto columns = grid.integer("columns", Range::between(1, most_plants));
    const auto rows = grid.integer_or("rows", 1, Range::between(1, most_plants));
    const double spacing = grid.number("spacing", Range::positive());
    const double jitter = grid.number_or("jitter", 0, Range::not_negative());
    grid.reject_unread();
    if (static_cast<double>(columns) * static_cast<double>(rows) > most_plants) {
        throw UserError(grid.place(), fmt::format("a stand may have at most {:.0f} plants", most_plants));
    }
    std::vector<glm::dvec3> offsets;
    for (std::int64_t row = 0; row < rows; ++row) {
        for (std::int64_t column = 0; column < columns; ++column) {
            RandomSamples samples({seed, stream + static_cast<std::uint32_t>(offsets.size()), Stream::placement}, 0, 0);
            const double dx = jitter * (2 * samples.uniform() - 1);
            const double dz = jitter * (2 * samples.uniform() - 1);
            offsets.push_back({(static_cast<double>(column) - 0.5 * static_cast<double>(columns - 1)) * spacing + dx, 0,
                               (static_cast<double>(row) - 0.5 * static_cast<double>(rows - 1)) * spacing + dz});
        }
    }
    return offsets;
}

std::vector<glm::dvec3> read_places(const Settings& table, std::uint64_t seed, std::uint32_t stream) {
    if (table.has("positions")) {
        for (const char* other : {"position", "grid"}) {
            if (table.has(other)) {
                throw UserError(table.place(other), fmt::format("give either 'positions' or '{}', not both", other));
            }
        }
        std::vector<glm::dvec3> positions = table.vectors("positions");
        if (positions.empty()) throw UserError(table.place("positions"), "'positions' is empty: no plant would grow");
        return positions;
    }
    const glm::dvec3 position = table.vector_or("position", {0, 0, 0});
    if (!table.has("grid")) return {position};
    std::vector<glm::dvec3> places = grid_offsets(table.table("grid"), seed, stream);
    for (glm::dvec3& place : places) place += position;
    return places;
}

Arithmetic read_arithmetic(const Settings& table) {
    const std::string name = table.choice_or("arithmetic", "double", {"double", "cpfg"});
    return arithmetic_called(name).value();
}

GeometryStages read_stages(const Settings& table) {
    GeometryStages stages;
    for (Settings stage : table.tables("stage")) {
        if (stage.flag_or("when", true)) {
            stages.push_back(read_geometry_stage(stage));
        } else {
            stage.ignore();
        }
    }
    return stages;
}

/// What looks wrong in a plant's model, which may be legal all the same.
std::vector<Diagnostic> review_of(const Plant& plant, const Insertions& insertions) {
    static const auto turtle = symbol_arities();
    return language::review(source_of(*plant.model), {turtle, insertions.letters()});
}

struct ModelKey {
    std::filesystem::path path;
    Defines defines;
    Arithmetic arithmetic;
    const View* view;
    // Not by <=>, which the maps of libc++ 14 do not have.
    bool operator<(const ModelKey& other) const {
        return std::tie(path, defines, arithmetic, view) <
               std::tie(other.path, other.defines, other.arithmetic, other.view);
    }
};

Pose read_pose(const Settings& table) {
    Pose pose;
    const glm::dvec3 heading = table.vector_or("heading", pose.heading);
    if (glm::length(heading) == 0) throw UserError(table.place("heading"), "'heading' must not be zero");
    head_towards(pose, heading);
    roll_left(pose, glm::radians(table.number_or("roll", 0)));
    return pose;
}

class PlantReader {
public:
    PlantReader(std::uint64_t seed, double dt, std::vector<Plant>& plants, SceneNotes& notes)
        : seed_(seed), dt_(dt), plants_(plants), notes_(notes), side_files_(notes) {}

    void read(const Settings& table, const std::vector<Keyframes>& keyframes) {
        Plant plant;
        const Defines defines = read_defines(table.table("define"));
        const std::filesystem::path folder = table.path_if_any("folder").value_or("");
        // The view comes first: it names the functions that the model calls.
        if (const auto view = table.path_if_any("view")) {
            require_file(table, "view");
            plant.view = side_files_.view(*view, defines, folder);
        }
        plant.palette = side_files_.palette(table);
        const std::vector<Individual> individuals = read_individuals(table, defines, plant);
        for (const std::string& text : table.texts_or("insert", {})) {
            plant.insertions.push_back(read_insertion(text, table.place("insert")));
        }
        review(plant, Insertions(plant));
        plant.turtle = read_turtle(table.table("turtle"), viewed(plant));
        plant.stages = read_stages(table);
        if (!keyframes.empty()) read_drawing_in_time(table, keyframes, plant);
        plant.turtle.pose = read_pose(table);
        const auto stream = static_cast<std::uint32_t>(
            table.integer_or("stream", static_cast<std::int64_t>(plants_.size()), Range::between(0, 4294967295.0)));
        const std::vector<glm::dvec3> places = read_places(table, seed_, stream);
        const std::string name = read_name(table, source_of(*plant.model));
        table.reject_unread();
        const std::size_t number = places.size() * individuals.size();
        const bool are_labelled = places.size() == 1 && have_different_labels(individuals);
        for (std::size_t i = 0; i < number; ++i) {
            const Individual& individual = individuals[i % individuals.size()];
            plant.model = individual.model;
            plant.name = are_labelled  ? fmt::format("{}-{}", name, individual.label)
                         : number == 1 ? name
                                       : fmt::format("{}-{}", name, i + 1);
            plant.stream = stream + static_cast<std::uint32_t>(i);
            plant.turtle.pose.position = places[i / individuals.size()] + individual.offset;
            plants_.push_back(plant);
        }
    }

private:
    /// One plant of those that a model stands for: a file of measured plants may hold several.
    struct Individual {
        std::shared_ptr<const CompiledModel> model;
        glm::dvec3 offset{0};  ///< m; from the place of the table's plant
        std::string label = {};
    };

    static bool have_different_labels(const std::vector<Individual>& individuals) {
        std::set<std::string> labels;
        for (const Individual& each : individuals) labels.insert(each.label);
        return individuals.size() > 1 && labels.size() == individuals.size() && !labels.contains("");
    }

    /// `plant` gets the model of the first.
    std::vector<Individual> read_individuals(const Settings& table, const Defines& defines, Plant& plant) {
        require_file(table, "model");
        if (!holds_measured_plants(table.path("model"))) {
            read_model_of(table, defines, plant);
            return {{plant.model}};
        }
        std::vector<Individual> individuals = read_measured(table, defines, plant.view.get());
        plant.model = individuals.front().model;
        return individuals;
    }

    std::vector<Individual> read_measured(const Settings& table, const Defines& defines, const View* view) {
        const MeasuredPlants measured = read_measured_plants(table.path("model"), read_measured_options(table));
        notes_.diagnostics.insert(notes_.diagnostics.end(), measured.warnings.begin(), measured.warnings.end());
        const glm::dvec3 shift = read_measured_shift(table, measured);
        const ReadOptions options = read_options(defines, read_arithmetic(table), view);
        if (!measured.separate) return {made(measured, std::nullopt, options, -shift)};
        std::vector<Individual> individuals;
        for (std::size_t i = 0; i < measured.plants.size(); ++i) {
            individuals.push_back(made(measured, i, options, measured.plants[i].base - shift));
        }
        return individuals;
    }

    /// Nobody wrote its model, so that nothing in it is looked at twice.
    Individual made(const MeasuredPlants& plants, std::optional<std::size_t> plant, const ReadOptions& options,
                    const glm::dvec3& offset) {
        Individual individual{compile(measured_model(plants, plant, options)), offset,
                              plant ? plants.plants[*plant].label : ""};
        reviewed_.insert(individual.model.get());
        return individual;
    }

    void review(const Plant& plant, const Insertions& insertions) {
        if (!reviewed_.insert(plant.model.get()).second) return;
        const std::vector<Diagnostic> found = review_of(plant, insertions);
        notes_.diagnostics.insert(notes_.diagnostics.end(), found.begin(), found.end());
    }

    static void require_file(const Settings& table, const char* key) {
        if (std::filesystem::exists(table.path(key))) return;
        throw UserError(table.place(key), fmt::format("there is no {} {}", key, table.path(key).string()));
    }

    // Keyframes give the model's settings the values of one age, or of each step, which sees them as the plant grows,
    // or from which the plant grows anew.
    void read_model_of(const Settings& table, const Defines& given, Plant& plant) {
        const std::vector<Keyframes> keyframes = read_keyframes(table, table.path("model"));
        const bool has_age = table.has("age"), regrows = table.flag_or("regrow", false);
        const double age = has_age ? table.number("age", Range::not_negative()) : 0;
        if (has_age && keyframes.empty()) {
            throw UserError(table.place("age"), "this plant has no [[plant.keyframes]] to look at");
        }
        if (has_age && regrows) throw UserError(table.place("age"), "a plant has either an 'age' or 'regrow'");
        for (const Keyframes& each : keyframes) {
            if (!given.contains(each.name)) continue;
            throw UserError(each.place, fmt::format("'{}' has a value in 'define' already", each.name));
        }
        Defines defines = at_time(given, keyframes, age);
        std::set<std::string> in_time;
        for (const Keyframes& each : keyframes) {
            if (has_age || regrows) continue;
            defines[each.name] = each.expression(fmt::format("(Q * {})", dt_));
            in_time.insert(each.name);
        }
        plant.model = compiled_model(table, defines, in_time, plant.view.get());
        if (!regrows) return;
        if (keyframes.empty()) {
            plant.in_time = std::make_shared<const ModelInTime>(plant.model);
            return;
        }
        const std::filesystem::path path = table.path("model");
        const ReadOptions options = read_options(defines, read_arithmetic(table), plant.view.get());
        plant.in_time = std::make_shared<const ModelInTime>(
            [=, view = plant.view](double time) {
                ReadOptions at_that_time = options;
                at_that_time.defines = at_time(given, keyframes, time);
                return compile(read_model(path, at_that_time));
            },
            dt_);
    }

    static TurtleSettings viewed(const Plant& plant) { return plant.view ? plant.view->turtle : TurtleSettings(); }

    /// The drawing of each time is read from a table with the values of that time. Throws UserError where it would not
    /// be sound at its key times or between them.
    void read_drawing_in_time(const Settings& table, const std::vector<Keyframes>& keyframes, Plant& plant) const {
        const auto make = [keyframes, table, turtle = viewed(plant)](double time) {
            Settings then = table.copy(table.place().file);
            for (const Keyframes& each : keyframes) then.set(each.name, fmt::format("{}", each.at(time)));
            return Drawing{read_turtle(then.table("turtle"), turtle), read_stages(then)};
        };
        for (const auto& [time, place] : times_to_try(keyframes)) {
            try {
                make(time);
            } catch (const UserError& error) {
                throw UserError(place, fmt::format("at the time {}: {}", time, error.diagnostics().front().message));
            }
        }
        plant.turtle = make(0).turtle;
        plant.stages = make(0).stages;
        plant.drawing_in_time = std::make_shared<const DrawingInTime>(make, dt_);
    }

    /// The key times and the middles between them.
    static std::vector<std::pair<double, Place>> times_to_try(const std::vector<Keyframes>& keyframes) {
        std::vector<std::pair<double, Place>> times;
        for (const Keyframes& each : keyframes) {
            for (std::size_t k = 0; k < each.times.size(); ++k) {
                times.emplace_back(each.times[k], each.place);
                if (k > 0) times.emplace_back((each.times[k - 1] + each.times[k]) / 2, each.place);
            }
        }
        return times;
    }

    static ReadOptions read_options(const Defines& defines, Arithmetic arithmetic, const View* view) {
        ReadOptions options;
        options.defines = defines;
        options.arithmetic = arithmetic;
        if (view) {
            options.predefined = view->function_names;
            options.resources = view->resources;
        }
        return options;
    }

    std::shared_ptr<const CompiledModel> compiled_model(const Settings& table, const Defines& defines,
                                                        const std::set<std::string>& in_time, const View* view) {
        const ModelKey key{table.path("model"), defines, read_arithmetic(table), view};
        std::shared_ptr<const CompiledModel>& model = models_[key];
        if (model) return model;
        ReadOptions options = read_options(defines, key.arithmetic, view);
        options.in_time = in_time;
        options.warnings = &notes_.diagnostics;
        model = compile(read_model(key.path, options));
        return model;
    }

    // A name given twice is a mistake; a missing name is made from the model's.
    std::string read_name(const Settings& table, const Model& model) {
        std::string name = table.text_or("name", "");
        if (!name.empty() && !names_.insert(name).second) {
            throw UserError(table.place("name"), fmt::format("two plants are called '{}'", name));
        }
        if (!name.empty()) return name;
        const std::string stem = std::filesystem::path(model.name).stem().string();
        name = stem;
        for (int number = 2; !names_.insert(name).second; ++number) name = fmt::format("{}-{}", stem, number);
        return name;
    }

    std::uint64_t seed_;
    double dt_;
    std::vector<Plant>& plants_;
    SceneNotes& notes_;
    SideFiles side_files_;
    std::set<std::string> names_;
    std::map<ModelKey, std::shared_ptr<const CompiledModel>> models_;
    std::set<const CompiledModel*> reviewed_;
};

}  // namespace

Defines read_defines(const Settings& table) {
    Defines defines;
    for (const std::string& name : table.keys()) defines[name] = table.value_text(name);
    return defines;
}

std::vector<Plant> read_plants(const Settings& root, std::uint64_t seed, double dt, Mistakes& mistakes,
                               SceneNotes& notes, const std::vector<std::vector<Keyframes>>& keyframes) {
    std::vector<Plant> plants;
    mistakes.attempt([&] {
        const std::vector<Settings> tables = root.tables("plant");
        if (tables.empty()) throw UserError(root.place(), "no [[plant]] in this scene: at least one is needed");
        PlantReader reader(seed, dt, plants, notes);
        for (std::size_t k = 0; k < tables.size(); ++k) {
            const std::vector<Keyframes> none;
            mistakes.attempt([&] { reader.read(tables[k], k < keyframes.size() ? keyframes[k] : none); });
        }
    });
    return plants;
}

}  // namespace espalier::simulation
