#include "espalier/simulation/world.h"

#include "memory.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <exception>

namespace espalier {
namespace {

struct Plant {
    const PlantDescription* description = nullptr;
    const Model* model = nullptr;
    std::shared_ptr<const SymbolTable> symbols;
    Derivation derivation;
    ModuleString string, next;
    Interpretation interpretation;
};

class Stopwatch {
public:
    explicit Stopwatch(double& seconds) : seconds_(seconds), begin_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

private:
    double& seconds_;
    std::chrono::steady_clock::time_point begin_;
};

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

}  // namespace

struct World::State {
    Scene scene;
    MemoryShares shares;
    std::vector<Plant> plants;
    std::unique_ptr<Environment> environment;
    int step = 0;
    StageTimes times;
    std::vector<PlantFrame> frames;
    std::vector<Diagnostic> warnings;

    double time() const { return step * scene.dt; }
    template <class Action>
    void for_every_plant(const Action& action);
    void derive(const std::function<void(Plant&)>& rewrite);
    void interpret_and_exchange();
    void require_strings_fit() const;
    void make_frames();
    DerivationSettings settings_of(const PlantDescription& plant, const std::filesystem::path& files) const;
};

// All plants in parallel. Of several failures the first plant's is reported, whoever failed first.
template <class Action>
void World::State::for_every_plant(const Action& action) {
    std::vector<std::exception_ptr> failures(plants.size());
    tbb::parallel_for(std::size_t(0), plants.size(), [&](std::size_t i) {
        try {
            action(plants[i], static_cast<std::uint32_t>(i));
        } catch (const RunError& error) {
            const std::string who = plants.size() == 1 ? "" : fmt::format("plant '{}': ", scene.plants[i].name);
            failures[i] = std::make_exception_ptr(RunError(who + error.what()));
        } catch (...) {
            failures[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

void World::State::derive(const std::function<void(Plant&)>& rewrite) {
    const Stopwatch stopwatch(times.derive);
    for_every_plant([&](Plant& plant, std::uint32_t) { rewrite(plant); });
    require_strings_fit();
}

void World::State::interpret_and_exchange() {
    {
        const Stopwatch stopwatch(times.interpret);
        for_every_plant([&](Plant& plant, std::uint32_t number) {
            interpret(*plant.model, *plant.symbols, plant.string, plant.description->turtle, &plant.derivation,
                      {number}, plant.interpretation);
        });
    }
    const Stopwatch stopwatch(times.exchange);
    std::vector<PlantView> views;
    std::vector<ModuleString*> strings;
    for (Plant& plant : plants) {
        views.push_back({static_cast<std::uint32_t>(views.size()), plant.model, &plant.string, &plant.interpretation});
        strings.push_back(&plant.string);
    }
    environment->exchange({step, time(), scene.dt, views}, strings);
    make_frames();
}

// Every plant may take the whole share, so the sum is looked at after each step.
void World::State::require_strings_fit() const {
    std::size_t bytes = 0;
    for (const Plant& plant : plants) bytes += plant.string.bytes() + plant.next.bytes();
    if (bytes <= shares.strings) return;
    throw RunError(fmt::format("step {}: the strings of all plants take {} MiB, but --memory leaves them {} MiB", step,
                               bytes >> 20, shares.strings >> 20));
}

void World::State::make_frames() {
    frames.clear();
    for (const Plant& plant : plants) {
        const auto number = static_cast<std::uint32_t>(frames.size());
        frames.push_back({number, plant.description->name, plant.model, &plant.string, &plant.interpretation,
                          environment->statistics(number), plant.description->palette.get()});
    }
}

DerivationSettings World::State::settings_of(const PlantDescription& plant, const std::filesystem::path& files) const {
    DerivationSettings settings;
    settings.seed = scene.seed;
    settings.plant = plant.stream;
    settings.lineage = true;
    settings.memory = shares.strings;
    settings.input_folder = folder_with(source_of(*plant.model));
    if (!files.empty()) settings.output_folder = scene.plants.size() == 1 ? files : files / folder_of(plant.name);
    return settings;
}

std::filesystem::path folder_with(const Model& model) {
    const std::filesystem::path folder = model.path.parent_path();
    return folder.empty() ? "." : folder;
}

World::World(const Scene& scene, std::size_t memory, const std::filesystem::path& files)
    : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.scene = scene;
    state.shares = share_memory(memory, scene.processes.size());
    const EnvironmentContext context{"",
                                     scene.domain,
                                     scene.seed,
                                     static_cast<std::uint32_t>(scene.plants.size()),
                                     state.shares.process,
                                     &state.warnings};
    state.environment = std::make_unique<Environment>(scene.processes, context);
    for (const auto& process : scene.processes) process.second.reject_unread();
    if (!scene.default_process.empty()) state.environment->set_default(scene.default_process);
    if (scene.routed) state.environment->route_by_first_parameter();
    if (scene.keeps_unanswered) state.environment->keep_unanswered();

    std::map<const CompiledModel*, std::shared_ptr<const SymbolTable>> symbols;
    state.plants.reserve(scene.plants.size());
    for (const PlantDescription& description : state.scene.plants) {
        const Model& model = source_of(*description.model);
        state.environment->require_answers(model, description.name);
        auto& table = symbols[description.model.get()];
        if (!table) table = symbol_table(model);
        Derivation derivation(description.model, state.settings_of(description, files));
        if (scene.sets_length) derivation.set_length(scene.steps);
        state.plants.push_back({&description, &model, table, std::move(derivation), {}, {}, {}});
    }
}

World::~World() = default;

void World::start() {
    plant_axioms();
    exchange();
}

void World::step() {
    derive();
    exchange();
}

void World::plant_axioms() {
    state_->derive([](Plant& plant) { plant.derivation.start(plant.string); });
}

void World::exchange() {
    state_->interpret_and_exchange();
}

void World::derive() {
    ++state_->step;
    state_->derive([](Plant& plant) {
        plant.derivation.step(plant.string, plant.next);
        std::swap(plant.string, plant.next);
    });
}

int World::last_step() const {
    if (state_->scene.last_frame) return *state_->scene.last_frame;
    int longest = 0;
    for (const Plant& plant : state_->plants) longest = std::max(longest, plant.derivation.length());
    return longest;
}

int World::steps_done() const {
    return state_->step;
}

bool World::stopped() const {
    for (const Plant& plant : state_->plants) {
        if (plant.derivation.stopped()) return true;
    }
    return false;
}

std::size_t World::modules() const {
    std::size_t modules = 0;
    for (const Plant& plant : state_->plants) modules += plant.string.size();
    return modules;
}

const StageTimes& World::times() const {
    return state_->times;
}

Frame World::frame() const {
    return {state_->step, state_->time(), state_->frames, &state_->environment->fields()};
}

const ModuleString& World::string(std::size_t plant) const {
    return state_->plants[plant].string;
}

const Interpretation& World::interpretation(std::size_t plant) const {
    return state_->plants[plant].interpretation;
}

const Model& World::model(std::size_t plant) const {
    return *state_->plants[plant].model;
}

const Environment& World::environment() const {
    return *state_->environment;
}

const std::vector<Diagnostic>& World::warnings() const {
    return state_->warnings;
}

std::size_t World::size() const {
    return state_->plants.size();
}

}  // namespace espalier
