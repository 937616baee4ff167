// Models and worlds for programs in JavaScript: what npm/index.js calls. Every function takes and gives JSON; arrays
// are told as {"at": address, "length": n} and hold until the next call.
#include "espalier/geometry/openvdb_grid.h"
#include "espalier/simulation/simulation.h"
#include "espalier/timeline/last_frame.h"

#include "app/look/studio_documents.h"
#include "archive/meshes/surface_mesh.h"
#include "base/reason.h"
#include "timeline/measures/plant_statistics.h"

#include <nlohmann/json.hpp>

#include <emscripten.h>
#include <map>
#include <memory>
#include <utility>

namespace espalier {
namespace {

using Json = nlohmann::ordered_json;

std::string answered;  ///< stays until the next answer
std::string printed;   ///< by models, since it was told

template <class Vector>
Json array_of(const Vector& values) {
    return {{"at", reinterpret_cast<std::uintptr_t>(values.data())}, {"length", values.size()}};
}

Json json_of(const Diagnostic& one) {
    return {{"message", one.message},
            {"file", one.place.file},
            {"line", one.place.line},
            {"column", one.place.column},
            {"source", one.source}};
}

/// What `work` returns, or why it could not.
template <class Work>
const char* answer(const Work& work) {
    Json json;
    try {
        json = work();
        if (!printed.empty()) json["printed"] = std::exchange(printed, "");
    } catch (const UserError& error) {
        json = {{"error", error.what()}, {"problems", Json::array()}};
        for (const Diagnostic& one : error.diagnostics()) json["problems"].push_back(json_of(one));
    } catch (const std::exception& error) {
        json = {{"error", reason_of(error)}, {"problems", Json::array()}};
    }
    answered = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return answered.c_str();
}

std::shared_ptr<Printout> printout() {
    return std::make_shared<Printout>([](const std::string& text) { printed += text; });
}

/// A string as columns that live until the next one is asked for.
Json columns_of(const ModuleString& string, const Alphabet& alphabet) {
    static std::vector<LetterId> letters;
    static std::vector<std::uint32_t> offsets;
    static std::vector<double> parameters;
    letters.assign(string.letters.begin(), string.letters.end());
    parameters.assign(string.parameters.begin(), string.parameters.end());
    const std::vector<std::size_t> first = parameter_offsets(string, alphabet);
    offsets.assign(first.begin(), first.end());
    Json names = Json::array();
    for (std::size_t i = 0; i < alphabet.size(); ++i) names.push_back(alphabet.name(static_cast<LetterId>(i)));
    return {{"names", std::move(names)},
            {"letters", array_of(letters)},
            {"offsets", array_of(offsets)},
            {"parameters", array_of(parameters)},
            {"text", to_text(string, alphabet)}};
}

Scene scene_of(const Json& asked) {
    const std::filesystem::path file = asked.at("open").get<std::string>();
    std::vector<std::pair<std::string, std::string>> values;
    for (const auto& [key, value] : asked.at("set").items()) values.emplace_back(key, value.get<std::string>());
    const std::optional<int> steps = asked.contains("steps") ? std::optional(asked["steps"].get<int>()) : std::nullopt;
    const std::optional<std::uint64_t> seed =
        asked.contains("seed") ? std::optional(asked["seed"].get<std::uint64_t>()) : std::nullopt;
    if (file.extension() == ".toml") {
        Scene scene = read_scene(file, {values, steps, seed});
        app::require_no_programs(scene);
        return scene;
    }
    Scene scene;
    scene.plants.push_back(plant_of_file(file, Defines(values.begin(), values.end())));
    scene.steps = steps;
    scene.seed = seed.value_or(0);
    return scene;
}

WorldOptions options_of(const Json& asked) {
    WorldOptions options;
    options.memory = asked.value("memory", std::size_t{1} << 30);
    options.printout = printout();
    return options;
}

class GrownWorld {
public:
    explicit GrownWorld(const Json& asked)
        : world_(scene_of(asked), options_of(asked)), statistics_(world_.scene().timeline) {
        world_.start();
        take_rows();
    }

    void step() {
        world_.step();
        take_rows();
    }

    Json state() const {
        Json names = Json::array(), warnings = Json::array(), fields = Json::array();
        for (const Plant& plant : world_.scene().plants) names.push_back(plant.name);
        for (const Diagnostic& one : world_.warnings()) warnings.push_back(json_of(one));
        for (const auto& [name, field] : world_.environment().fields().all()) {
            fields.push_back({{"name", name}, {"unit", field.unit}, {"meaning", field.meaning}});
        }
        return {{"step", world_.steps_done()},
                {"last", world_.last_step()},
                {"ended", world_.at_end()},
                {"modules", world_.modules()},
                {"plants", names},
                {"warnings", warnings},
                {"fields", fields},
                {"columns", columns_},
                {"rows", rows_}};
    }

    Json string(std::size_t plant) const {
        require_plant(plant);
        return columns_of(world_.string(plant), world_.model(plant).alphabet);
    }

    Json mesh(const Json& asked) {
        archive::MeshOptions options;
        options.sides = asked.value("sides", 8);
        if (asked.contains("triangles")) options.triangles = asked["triangles"].get<std::size_t>();
        if (asked.contains("plant")) {
            options.plant = asked["plant"].get<std::uint32_t>();
            require_plant(*options.plant);
        }
        if (options.sides < 3) throw UserError("a tube has 3 sides or more");
        Frame frame = world_.frame();
        frame.is_last = true;
        LastFrame last(world_.scene().timeline);
        last.record(frame);
        mesh_ = archive::mesh_of(*last.geometry(), options);
        Json parts = Json::array();
        for (const archive::MeshPart& part : mesh_.parts) {
            parts.push_back(
                {part.symbol, part.plant, std::to_string(part.identity), part.first_triangle, part.triangles});
        }
        return {
            {"points", array_of(mesh_.points)}, {"normals", array_of(mesh_.normals)},     {"uvs", array_of(mesh_.uvs)},
            {"rgb", array_of(mesh_.rgb)},       {"triangles", array_of(mesh_.triangles)}, {"parts", parts}};
    }

    Json field(const std::string& name) {
        const Field& field = world_.environment().fields().need(name);
        const std::shared_ptr<const FieldGrid> held = field.current ? field.current() : field.grid;
        const openvdb::FloatGrid& grid = *held->grid;
        const openvdb::CoordBBox box = held->box;
        const openvdb::Vec3d corner = grid.indexToWorld(box.min().asVec3d() - openvdb::Vec3d(0.5));
        const openvdb::Vec3d voxel = grid.voxelSize();
        values_.clear();
        const openvdb::FloatGrid::ConstAccessor accessor = grid.getConstAccessor();
        const openvdb::Coord low = box.min(), size = box.dim();
        for (int z = 0; z < size.z(); ++z) {
            for (int y = 0; y < size.y(); ++y) {
                for (int x = 0; x < size.x(); ++x) {
                    values_.push_back(accessor.getValue({low.x() + x, low.y() + y, low.z() + z}));
                }
            }
        }
        return {{"values", array_of(values_)},
                {"size", {size.x(), size.y(), size.z()}},
                {"origin", {corner.x(), corner.y(), corner.z()}},
                {"voxel", {voxel.x(), voxel.y(), voxel.z()}},
                {"unit", field.unit}};
    }

private:
    void require_plant(std::size_t plant) const {
        if (plant >= world_.size()) {
            throw UserError("there is no plant " + std::to_string(plant) + ": they count from 0 to " +
                            std::to_string(world_.size() - 1));
        }
    }

    void take_rows() {
        const Frame frame = world_.frame();
        if (frame.step == 0) statistics_.require_known(frame);
        columns_ = statistics_.columns(timeline::quantity_names(frame.plants.front()));
        rows_ = Json::array();
        for (const PlantFrame& plant : frame.plants) rows_.push_back(statistics_.of(plant));
        statistics_.end_step(frame);
    }

    World world_;
    timeline::PlantStatistics statistics_;
    std::vector<std::string> columns_;
    Json rows_;  ///< of this step, one a plant
    archive::FrameMesh mesh_;
    std::vector<float> values_;
};

std::map<int, std::unique_ptr<GrownWorld>> worlds;

GrownWorld& world_of(int number) {
    const auto found = worlds.find(number);
    if (found == worlds.end()) throw UserError("this world was freed");
    return *found->second;
}

Json derive(const Json& asked) {
    const std::filesystem::path file = asked.at("open").get<std::string>();
    Defines defines;
    for (const auto& [key, value] : asked.at("set").items()) defines[key] = value.get<std::string>();
    const Plant plant = plant_of_file(file, defines);
    const Model& model = source_of(*plant.model);
    DerivationSettings settings;
    settings.seed = asked.value("seed", std::uint64_t{0});
    settings.memory = asked.value("memory", std::size_t{1} << 30);
    settings.input_folder = folder_with(model);
    settings.printout = printout();
    Derivation derivation(plant.model, settings);
    if (asked.contains("steps")) derivation.set_length(asked["steps"].get<int>());
    ModuleString now, next;
    derivation.start(now);
    while (!derivation.stopped() && derivation.steps_done() < derivation.length()) {
        derivation.step(now, next);
        std::swap(now, next);
    }
    return columns_of(now, model.alphabet);
}

}  // namespace
}  // namespace espalier

using namespace espalier;

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* espalier_derive(const char* asked) {
    return answer([&] { return derive(Json::parse(asked)); });
}

EMSCRIPTEN_KEEPALIVE const char* espalier_world(int number, const char* asked) {
    return answer([&] {
        worlds[number] = std::make_unique<GrownWorld>(Json::parse(asked));
        return worlds[number]->state();
    });
}

EMSCRIPTEN_KEEPALIVE const char* espalier_step(int number) {
    return answer([&] {
        world_of(number).step();
        return world_of(number).state();
    });
}

EMSCRIPTEN_KEEPALIVE const char* espalier_string(int number, unsigned plant) {
    return answer([&] { return world_of(number).string(plant); });
}

EMSCRIPTEN_KEEPALIVE const char* espalier_mesh(int number, const char* asked) {
    return answer([&] { return world_of(number).mesh(Json::parse(asked)); });
}

EMSCRIPTEN_KEEPALIVE const char* espalier_field(int number, const char* name) {
    return answer([&] { return world_of(number).field(name); });
}

EMSCRIPTEN_KEEPALIVE void espalier_free(int number) {
    worlds.erase(number);
}
}
