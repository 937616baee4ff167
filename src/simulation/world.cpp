#include "espalier/simulation/world.h"

#include "espalier/base/bytes.h"
#include "espalier/timeline/timeline.h"

#include "growing_plant.h"
#include "memory_budget.h"
#include "string_checkpoint.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace espalier {
namespace {

constexpr std::uint64_t checkpoint_signature = 0x32'646c'726f'57;  // "World2"

/// What is asked of all plants together after each stage.
struct Totals {
    PlantMemory memory;
    std::size_t modules = 0;
    int longest = 0;
    bool stopped = false;

    void add(const Plant& plant) {
        memory.add(plant.memory);
        modules += plant.string->size();
        longest = std::max(longest, plant.length);
        stopped = stopped || plant.stopped;
    }
    Totals plus(const Totals& others) const {
        Totals sum = *this;
        sum.memory.add(others.memory);
        sum.modules += others.modules;
        sum.longest = std::max(longest, others.longest);
        sum.stopped = stopped || others.stopped;
        return sum;
    }
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
    SpareStrings spares;
    std::vector<Plant> plants;  ///< stay where they are: views and strings point to them
    // They stay where they are until the first frame shares them; then as the last interpretation left them.
    std::vector<PlantView> views;
    std::vector<ModuleString*> strings;
    std::map<const CompiledModel*, std::shared_ptr<const SymbolTable>> symbols;
    std::unique_ptr<Environment> environment;
    const Timeline* timeline = nullptr;
    int step = 0;
    StageTimes times;
    std::vector<Diagnostic> warnings;
    Totals totals;  ///< as the last stage left them
    // Of the step that was asked for last.
    std::vector<PlantFrame> frames;
    int frames_of = -1;

    double time() const { return step * scene.dt; }
    using Prefetch = void (Plant::*)() const;
    template <class Action>
    Totals for_every_plant(Prefetch prefetch, const Action& action);
    template <class Rewrite>
    void derive(const Rewrite& rewrite);
    void interpret_and_exchange();
    void limit_strings(Plant& plant) const;
    void draw(Plant& plant);
    void count_memory(Plant& plant) const;
    [[noreturn]] void refuse_strings(bool passed_on) const;
    void take_derived(const Totals& derived);
    void require_memory(const PlantMemory& needed) const;
    void make_frames();
    void release_frames();
    DerivationSettings settings_of(const PlantDescription& plant, const std::filesystem::path& files) const;
};

// All plants in parallel, with a string whose memory they may pass on; `prefetch` tells of a plant some time before. Of
// several failures the first plant's is reported, whoever failed first.
template <class Action>
Totals World::State::for_every_plant(Prefetch prefetch, const Action& action) {
    constexpr std::size_t ahead = 2;
    std::mutex failing;
    std::exception_ptr failure;
    std::size_t failed = plants.size();
    const auto act = [&](const tbb::blocked_range<std::size_t>& range, Totals sum) {
        SpareString spare(spares);
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            if (range.end() - i > 2 * ahead) espalier::prefetch(&plants[i + 2 * ahead], sizeof(Plant));
            if (range.end() - i > ahead) (plants[i + ahead].*prefetch)();
            try {
                action(plants[i], spare.string);
            } catch (...) {
                const std::lock_guard lock(failing);
                if (i > failed) continue;
                failed = i;
                failure = std::current_exception();
            }
            sum.add(plants[i]);
        }
        return sum;
    };
    const Totals sum = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, plants.size()), Totals(), act,
                                            [](const Totals& a, const Totals& b) { return a.plus(b); });
    if (!failure) return sum;
    try {
        std::rethrow_exception(failure);
    } catch (const RunError& error) {
        if (plants.size() == 1) throw;
        throw RunError(fmt::format("plant '{}': {}", scene.plants[failed].name, error.what()));
    }
}

// Strings never give memory back: as soon as those that are there take too much, the others need not be made.
template <class Rewrite>
void World::State::derive(const Rewrite& rewrite) {
    const Stopwatch stopwatch(times.derive);
    release_frames();
    // While memory is plentiful nobody will ask for strings of before.
    constexpr std::size_t plentiful = 16;
    const std::size_t besides = totals.memory.total() - totals.memory.strings;
    const bool passes_on = totals.memory.total() <= shares.plants / plentiful;
    std::atomic<std::size_t> held = totals.memory.strings;
    const auto is_too_much = [&] { return held + besides > shares.plants; };
    std::atomic<bool> full = is_too_much();
    const Totals derived = for_every_plant(&Plant::prefetch_derivation, [&](Plant& plant, ModuleString& spare) {
        if (full) return;
        limit_strings(plant);
        plant.rewrite(rewrite, passes_on ? &spare : nullptr);
        const std::size_t bytes = plant.bytes_of_strings();
        if (bytes != plant.memory.strings) {
            held += bytes - plant.memory.strings;
            plant.memory.strings = bytes;
            if (is_too_much()) full = true;
        }
        plant.length = plant.derivation.length();
        plant.stopped = plant.derivation.stopped();
    });
    if (plants.size() > 1 && is_too_much()) refuse_strings(passes_on);
    take_derived(derived);
}

// As much as is left, with the strings there are.
void World::State::limit_strings(Plant& plant) const {
    const std::size_t others = totals.memory.total() - plant.memory.strings;
    const std::size_t working = plant.derivation.working_memory(*plant.string);
    const std::size_t taken = others + working;
    plant.derivation.set_memory(shares.plants - std::min(taken, shares.plants));
}

/// Which plants were rewritten when the others were given up depends on the threads: tells of the strings before.
void World::State::refuse_strings(bool passed_on) const {
    const auto is_done = [&](const Plant& plant) { return plant.derivation.steps_done() == step; };
    const auto before = [&](const Plant& plant) {
        return is_done(plant) ? std::size_t{plant.modules_before} : plant.string->size();
    };
    const auto largest = std::max_element(plants.begin(), plants.end(),
                                          [&](const Plant& a, const Plant& b) { return before(a) < before(b); });
    const bool is_kept = step > 0 && (!passed_on || before(*largest) > most_passed_on);
    const std::string commonest =
        is_kept ? commonest_module(*largest->model, is_done(*largest) ? **largest->next : *largest->string) : "";
    throw RunError(fmt::format(
        "step {}: {} modules grow beyond the {} MiB that --memory leaves for plants; the largest was '{}' "
        "with {} modules{}",
        step, totals.modules, shares.plants >> 20, largest->description->name, before(*largest), commonest));
}

void World::State::take_derived(const Totals& derived) {
    // Nobody knows what will be drawn of strings before it is: as much of a module as in the step before.
    const double growth =
        totals.modules == 0 ? 1 : static_cast<double>(derived.modules) / static_cast<double>(totals.modules);
    totals = derived;
    require_memory(totals.memory.grown(std::max(growth, 1.0), timeline != nullptr));
}

void World::State::require_memory(const PlantMemory& needed) const {
    if (needed.total() <= shares.plants) return;
    const auto largest = std::max_element(plants.begin(), plants.end(), [](const Plant& a, const Plant& b) {
        return a.string->size() < b.string->size();
    });
    throw RunError(
        fmt::format("step {}: {} modules take {} MiB, with what is drawn and recorded of them, but --memory "
                    "leaves {} MiB for plants; the largest is '{}' with {} modules{}",
                    step, totals.modules, needed.total() >> 20, shares.plants >> 20, largest->description->name,
                    largest->string->size(), commonest_module(*largest->model, *largest->string)));
}

void World::State::interpret_and_exchange() {
    release_frames();
    {
        const Stopwatch stopwatch(times.interpret);
        totals = for_every_plant(&Plant::prefetch_interpretation, [&](Plant& plant, const ModuleString&) {
            draw(plant);
            count_memory(plant);
        });
        require_memory(totals.memory);
    }
    const Stopwatch stopwatch(times.exchange);
    environment->exchange({step, time(), scene.dt, views}, strings);
}

void World::State::draw(Plant& plant) {
    Interpretation& interpretation = plant.interpretation.for_writing();
    interpret(*plant.model, *plant.symbols, *plant.string, plant.description->turtle,
              plant.has_pictures ? &plant.derivation : nullptr, {plant.number}, interpretation);
    views[plant.number].asks = interpretation.asks();
    if (frames.empty()) return;
    views[plant.number].string = strings[plant.number] = &*plant.string;
    views[plant.number].interpretation = &interpretation;
}

void World::State::count_memory(Plant& plant) const {
    const Interpretation& interpretation = *plant.interpretation;
    const std::size_t before = plant.memory.drawn;
    plant.memory.set_drawn(interpretation, plants.size() > 1);
    if (timeline) plant.memory.set_recorded(timeline->memory(step, *plant.string, interpretation), before);
}

// Lets go of what they hold, so that it can be written into if nobody else does.
void World::State::release_frames() {
    if (frames_of < 0) return;
    frames_of = -1;
    for (PlantFrame& frame : frames) {
        frame.string.reset();
        frame.interpretation.reset();
    }
}

// Nothing of a frame but what the processes say of a plant changes from step to step.
void World::State::make_frames() {
    if (frames_of == step) return;
    if (frames.empty()) {
        for (const Plant& plant : plants) {
            frames.push_back(
                {plant.number, plant.description->name, plant.model, {}, {}, {}, plant.description->palette.get()});
        }
    }
    for (PlantFrame& frame : frames) {
        frame.string = plants[frame.plant].string.share();
        frame.interpretation = plants[frame.plant].interpretation.share();
        frame.quantities = environment->statistics(frame.plant);
    }
    frames_of = step;
}

DerivationSettings World::State::settings_of(const PlantDescription& plant, const std::filesystem::path& files) const {
    DerivationSettings settings;
    settings.seed = scene.seed;
    settings.plant = plant.stream;
    settings.lineage = true;
    settings.memory = shares.plants;
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

    state.plants.reserve(scene.plants.size());
    for (const PlantDescription& description : state.scene.plants) {
        const Model& model = source_of(*description.model);
        state.environment->require_answers(model, description.name);
        auto& table = state.symbols[description.model.get()];
        if (!table) table = symbol_table(model);
        Derivation derivation(description.model, state.settings_of(description, files));
        if (scene.sets_length) derivation.set_length(scene.steps);
        const auto number = static_cast<std::uint32_t>(state.plants.size());
        state.totals.longest = std::max(state.totals.longest, derivation.length());
        Plant& plant =
            state.plants.emplace_back(Plant{number, 0, &description, &model, table.get(), std::move(derivation)});
        state.views.push_back({number, &model, &*plant.string, &*plant.interpretation});
        state.strings.push_back(&*plant.string);
    }
}

World::~World() = default;

void World::save(std::ostream& out) const {
    put(out, checkpoint_signature);
    put(out, static_cast<std::int32_t>(state_->step));
    put(out, static_cast<std::uint64_t>(state_->plants.size()));
    for (const Plant& plant : state_->plants) {
        plant.derivation.save(out);
        save_string(*plant.string, out);
        put(out, plant.memory);
    }
    state_->environment->save(out);
}

void World::restore(std::istream& in) {
    if (get<std::uint64_t>(in) != checkpoint_signature) throw RunError("this is not the checkpoint of a world");
    const auto step = get<std::int32_t>(in);
    if (get<std::uint64_t>(in) != state_->plants.size()) throw RunError("the checkpoint is of another scene");
    for (Plant& plant : state_->plants) {
        plant.derivation.restore(in);
        restore_string(*plant.string, state_->shares.plants, in);
        plant.memory = get<PlantMemory>(in);
        plant.length = plant.derivation.length();
        plant.stopped = plant.derivation.stopped();
    }
    state_->environment->restore(in);
    state_->step = step;
    state_->frames_of = -1;
    Totals restored;
    for (const Plant& plant : state_->plants) restored.add(plant);
    state_->totals = restored;
    state_->require_memory(state_->totals.memory);
}

void World::count_recording(const Timeline& timeline) {
    state_->timeline = &timeline;
}

std::size_t World::bytes_for_frames() const {
    return state_->shares.frames;
}

void World::start() {
    plant_axioms();
    exchange();
}

void World::step() {
    derive();
    exchange();
}

void World::plant_axioms() {
    state_->derive([](Plant& plant, ModuleString& to) { plant.derivation.start(to); });
}

void World::exchange() {
    state_->interpret_and_exchange();
}

void World::derive() {
    ++state_->step;
    state_->derive([](Plant& plant, ModuleString& to) { plant.derivation.step(*plant.string, to); });
}

int World::last_step() const {
    return state_->scene.last_frame.value_or(state_->totals.longest);
}

int World::steps_done() const {
    return state_->step;
}

bool World::stopped() const {
    return state_->totals.stopped;
}

std::size_t World::modules() const {
    return state_->totals.modules;
}

const StageTimes& World::times() const {
    return state_->times;
}

Frame World::frame() const {
    state_->make_frames();
    return {state_->step, state_->time(), state_->frames, &state_->environment->fields()};
}

const ModuleString& World::string(std::size_t plant) const {
    return *state_->plants[plant].string;
}

const Interpretation& World::interpretation(std::size_t plant) const {
    return *state_->plants[plant].interpretation;
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
