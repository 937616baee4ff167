// How a world is made of a scene.
#include "base/text.h"
#include "simulation/scene/expressions.h"
#include "simulation/scene/scene_keyframes.h"
#include "simulation/world/world_state.h"
#include "turtle/asking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

namespace espalier::simulation {
namespace {

// A plant's name as the name of a folder; names that differ stay different.
std::string folder_of(const std::string& name) {
    std::string folder;
    for (const char c : name) {
        const bool plain =
            std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || (c == '.' && !folder.empty());
        folder += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return folder;
}

// What a scene leaves open: plants draw by their number in the scene, and bear their model's name with a number.
Scene with_defaults(Scene scene) {
    std::set<std::string> names;
    for (const Plant& plant : scene.plants) names.insert(plant.name);
    for (std::size_t i = 0; i < scene.plants.size(); ++i) {
        Plant& plant = scene.plants[i];
        if (!plant.stream) plant.stream = static_cast<std::uint32_t>(i);
        if (!plant.name.empty()) continue;
        const std::string stem = std::filesystem::path(source_of(*plant.model).name).stem().string();
        plant.name = stem;
        for (int number = 2; !names.insert(plant.name).second; ++number)
            plant.name = fmt::format("{}-{}", stem, number);
    }
    return scene;
}

}  // namespace

std::filesystem::path folder_with(const Model& model) {
    const std::filesystem::path folder = model.path.parent_path();
    return folder.empty() ? "." : folder;
}

World::State::State(const Scene& described, std::size_t bytes, const std::filesystem::path& files,
                    std::shared_ptr<Printout> prints, Ranks* ranks)
    : printout(prints ? std::move(prints) : std::make_shared<Printout>()),
      scene(with_defaults(described)),
      budget(bytes),
      memory(share_memory(bytes, 0).plants) {
    make_environment();
    share_out_memory();
    make_plants(files);
    find_fields_read();
    warn_of_unasked();
    set_lengths();
    if (!ranks) return;
    spread = std::make_unique<Spread>(*ranks, scene, *environment, fields_read);
    spread->mark(plants);
    for (const std::string& note : spread->notes(*environment)) {
        warnings.push_back({Diagnostic::Severity::warning, Place(), note, ""});
    }
}

// Plants get what the fields leave, and fields what the plants leave.
void World::State::share_out_memory() {
    // Room for fields to double ends at half of the budget, which those that cannot grow never exceed.
    const std::size_t kept = environment->memory_kept();
    memory.set_bytes(share_memory(budget, std::min(kept, std::max(kept / 2, budget / 2))).plants);
    const std::size_t most = share_memory(budget, 0).plants;
    environment->limit_memory(most - std::min(most, memory.held()));
}

void World::State::make_environment() {
    const SceneEnvironment& described = scene.environment;
    const auto count = static_cast<std::uint32_t>(scene.plants.size());
    const EnvironmentContext context{"", scene.domain, scene.seed, count, budget / 2, &warnings};
    const MapOrigin::Scope of_files(scene.origin.get());
    try {
        environment = std::make_unique<Environment>(described.processes, context);
    } catch (const UserError& error) {
        throw explained(error, scene.computed);
    }
    if (scene.origin) {
        for (Diagnostic& warning : scene.origin->take_warnings()) warnings.push_back(std::move(warning));
    }
    for (const auto& process : described.processes) process.second.reject_unread();
    if (described.in_time) described.in_time->check(*environment);
    if (!described.default_process.empty()) environment->set_default(described.default_process);
    if (described.routed) environment->route_by_first_parameter();
    if (described.keeps_unanswered) environment->keep_unanswered();
}

void World::State::make_plants(const std::filesystem::path& files) {
    std::map<const CompiledModel*, std::shared_ptr<const SymbolTable>> symbols;
    plants.reserve(scene.plants.size());
    exchanges = environment->size() > 0;
    std::size_t held = 0;  // by arrays of the plants so far
    for (const Plant& plant : scene.plants) {
        const Model& model = source_of(*plant.model);
        environment->require_answers(model, plant.name);
        std::shared_ptr<const SymbolTable>& table = symbols[plant.model.get()];
        if (!table) {
            table = symbol_table(model);
            warn_of_likely_names(model, plant.name);
            known_models.push_back({&model, table});
            exchanges = exchanges || has_queries(model.alphabet);
        }
        const auto number = static_cast<std::uint32_t>(plants.size());
        DerivationSettings settings = derivation_settings(plant, files);
        settings.memory -= held;
        const GrowingPlant& made = plants.emplace_back(number, plant, table, settings);
        held = std::min(held + made.derivation.working_memory({}), memory.bytes());
    }
}

// A default must not hide that a name is misspelt.
void World::State::warn_of_likely_names(const Model& model, const std::string& plant) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < environment->size(); ++i) names.push_back(environment->name(i));
    for (const std::string& name : environment->answered_by_default(model)) {
        const std::string likely = did_you_mean(name, names);
        if (likely.empty()) continue;
        warnings.push_back({Diagnostic::Severity::warning, Place(),
                            fmt::format("plant '{}': ?{} is answered the default of {}, because the scene has no "
                                        "process of that name{}",
                                        plant, name, model.name, likely),
                            ""});
    }
}

DerivationSettings World::State::derivation_settings(const Plant& plant, const std::filesystem::path& files) const {
    DerivationSettings settings;
    settings.seed = scene.seed;
    settings.plant = *plant.stream;
    settings.lineage = true;
    settings.memory = memory.bytes();
    settings.printout = printout;
    settings.input_folder = folder_with(source_of(*plant.model));
    if (!files.empty()) settings.output_folder = scene.plants.size() == 1 ? files : files / folder_of(plant.name);
    return settings;
}

// The scene's steps are the derivation length of all plants; if it gives none, the longest of theirs is. An animation
// leaves them alone, but a run goes on to its first frame.
void World::State::set_lengths() {
    note_ends();
    if (scene.steps || !scene.frames) {
        const int length = scene.steps.value_or(longest);
        for (GrowingPlant& plant : plants) plant.set_length(length);
        note_ends();
    } else if (!scene.last_frame && longest < scene.frames->first) {
        scene.last_frame = scene.frames->first;
    }
}

World::World(const Scene& scene, std::size_t memory, const std::filesystem::path& files,
             std::shared_ptr<Printout> printout, Ranks* ranks) {
    together(ranks, [&] { state_ = std::make_unique<State>(scene, memory, files, std::move(printout), ranks); });
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

}  // namespace espalier::simulation
