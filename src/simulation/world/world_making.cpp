// How a world is made of a scene.
#include "base/text.h"
#include "simulation/scene/expressions.h"
#include "simulation/scene/scene_keyframes.h"
#include "simulation/spread/plants_in_memory.h"
#include "simulation/spread/plants_on_disk.h"
#include "simulation/spread/plants_on_ranks.h"
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

std::vector<std::string> fields_read(const std::vector<GrowingPlant>& plants) {
    std::set<std::string> names;
    for (const GrowingPlant& plant : plants) {
        for (std::string& name : fields_read_by(plant.model())) names.insert(std::move(name));
    }
    return {names.begin(), names.end()};
}

}  // namespace

std::filesystem::path folder_with(const Model& model) {
    const std::filesystem::path folder = model.path.parent_path();
    return folder.empty() ? "." : folder;
}

World::State::State(const Scene& described, const WorldOptions& options)
    : scene(with_defaults(described)),
      printout(options.printout ? options.printout : std::make_shared<Printout>()),
      ranks(options.ranks),
      budget(options.memory),
      memory(share_memory(options.memory, 0).plants),
      recording(options.ranks),
      is_looked_at(options.is_looked_at) {
    make_environment();
    share_out_memory();
    std::vector<GrowingPlant> made = make_plants(options.files);
    fields.names = fields_read(made);
    review.warn_of_unasked(scene, *environment, fields.names);
    place(std::move(made), options);
}

// Where the plants are is decided here, and only here.
void World::State::place(std::vector<GrowingPlant> made, const WorldOptions& options) {
    if (const auto& blocks = options.blocks) {
        require_waiting();
        plants =
            std::make_unique<PlantsOnDisk>(std::move(made), blocks->folder, blocks->count, blocks->resident, memory,
                                           /*holds_queries=*/!environment->takes_parts());
    } else {
        plants = std::make_unique<PlantsInMemory>(std::move(made));
    }
    set_lengths();
    if (!ranks) return;
    auto spread = std::make_unique<Spread>(*ranks, scene, *environment, fields.names);
    for (const std::string& note : spread->notes(*environment)) review.warn(note);
    plants = std::make_unique<PlantsOnRanks>(std::move(plants), std::move(spread), memory);
}

void World::State::require_waiting() const {
    for (std::size_t process = 0; process < environment->size(); ++process) {
        const Spreading spreading = environment->spreading(process);
        if (spreading == Spreading::reach || spreading == Spreading::queries) continue;
        throw UserError(fmt::format("process '{}' reads whole plants, so none can wait on disk; run without --blocks",
                                    environment->name(process)));
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
    const EnvironmentContext context{"", scene.domain, scene.seed, count, budget / 2, &review.warnings};
    const MapOrigin::Scope of_files(scene.origin.get());
    try {
        environment = std::make_unique<Environment>(described.processes, context);
    } catch (const UserError& error) {
        throw explained(error, scene.computed);
    }
    if (scene.origin) {
        for (Diagnostic& warning : scene.origin->take_warnings()) review.warnings.push_back(std::move(warning));
    }
    for (const auto& process : described.processes) process.second.reject_unread();
    if (described.in_time) described.in_time->check(*environment);
    if (!described.default_process.empty()) environment->set_default(described.default_process);
    if (described.routed) environment->route_by_first_parameter();
    if (described.keeps_unanswered) environment->keep_unanswered();
}

std::vector<GrowingPlant> World::State::make_plants(const std::filesystem::path& files) {
    std::map<const CompiledModel*, std::shared_ptr<const SymbolTable>> symbols;
    std::vector<GrowingPlant> made;
    made.reserve(size());
    exchanges = environment->size() > 0;
    std::size_t held = 0;  // by arrays of the plants so far
    for (const Plant& plant : scene.plants) {
        const Model& model = source_of(*plant.model);
        environment->require_answers(model, plant.name);
        std::shared_ptr<const SymbolTable>& table = symbols[plant.model.get()];
        if (!table) {
            table = symbol_table(model);
            warn_of_likely_names(model, plant.name);
            review.add(model, table);
            exchanges = exchanges || has_queries(model.alphabet);
            may_stop = may_stop || has_order(*plant.model);
        }
        const auto number = static_cast<std::uint32_t>(made.size());
        DerivationSettings settings = derivation_settings(plant, files);
        settings.memory -= held;
        const GrowingPlant& last = made.emplace_back(number, plant, table, settings);
        held = std::min(held + last.derivation.working_memory({}), memory.bytes());
    }
    return made;
}

// A default must not hide that a name is misspelt.
void World::State::warn_of_likely_names(const Model& model, const std::string& plant) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < environment->size(); ++i) names.push_back(environment->name(i));
    for (const std::string& name : environment->answered_by_default(model)) {
        const std::string likely = did_you_mean(name, names);
        if (likely.empty()) continue;
        review.warn(fmt::format(
            "plant '{}': ?{} is answered the default of {}, because the scene has no process of that name{}", plant,
            name, model.name, likely));
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
    ends = ends_here();
    if (scene.steps || !scene.frames) {
        const int length = scene.steps.value_or(ends.longest);
        for (GrowingPlant& plant : plants->all()) plant.set_length(length);
        ends = ends_here();
    } else if (!scene.last_frame && ends.longest < scene.frames->first) {
        scene.last_frame = scene.frames->first;
    }
}

}  // namespace espalier::simulation
