#include "studio/growth.h"

#include "espalier/simulation/simulation.h"

#include "studio/derivation_length.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <new>
#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

std::vector<Diagnostic> said(const std::string& message) {
    Diagnostic diagnostic;
    diagnostic.message = message;
    return {diagnostic};
}

std::vector<Diagnostic> diagnostics_of(const std::exception& error) {
    if (const auto* user = dynamic_cast<const UserError*>(&error)) return user->diagnostics();
    return said(error.what());
}

std::unique_ptr<Recorder> statistics_of(const World& world, const fs::path& folder) {
    Settings settings;
    return registered<RecorderType>().at("statistics")->make(settings, {folder, world.last_step()});
}

std::string rows_behind(const fs::path& file, std::size_t offset) {
    std::ifstream in(file, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(offset));
    return {std::istreambuf_iterator<char>(in), {}};
}

// A growth that may be extended ends where the studio says.
Scene without_end(Scene scene) {
    scene.steps = 100000000;  // more than anybody sees
    return scene;
}

}  // namespace

Growth::Growth(GrowthOrder order, GrowthListener& listener)
    : order_(std::move(order)),
      listener_(listener),
      steps_(order_.number, order_.scratch / fmt::format("growth-{}", order_.number)),
      version_(order_.version),
      thread_([this] { live(); }) {}

Growth::~Growth() {
    cancel();
    thread_.join();
    std::error_code ignored;
    fs::remove_all(order_.scratch / fmt::format("files-{}", order_.number), ignored);
}

std::shared_ptr<const Scene> Growth::scene() const {
    const std::lock_guard lock(mutex_);
    return scene_;
}

double Growth::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Growth::cancel() {
    cancelled_ = true;
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
}

bool Growth::extend(int last_step, std::uint64_t version) {
    if (!may_extend_ || last_step < last_step_) return false;
    const std::lock_guard lock(mutex_);
    version_ = version;
    last_step_ = last_step;
    stopped_ = false;
    changed_.notify_all();
    return true;
}

void Growth::ask(std::function<void(const World&)> question) {
    const std::lock_guard lock(mutex_);
    questions_.push_back(std::move(question));
    changed_.notify_all();
}

void Growth::live() {
    try {
        const ReadLog reads(std::size_t(64) << 20, order_.unsaved);
        const Scene scene = order_.read(order_.opened);
        note_barks(scene);
        GrowthStart start;
        start.files = reads.files();
        start.warnings = scene.notes.diagnostics;
        if (!cancelled_) grow(scene, std::move(start));
    } catch (const std::bad_alloc&) {
        if (!cancelled_) listener_.failed(number(), said("the machine has no memory left"));
    } catch (const std::exception& error) {
        if (!cancelled_) listener_.failed(number(), diagnostics_of(error));
    }
    ended_ = true;
}

void Growth::grow(const Scene& scene, GrowthStart start) {
    const fs::path folder = order_.scratch / fmt::format("files-{}", number());
    fs::create_directories(folder);
    World world(scene, default_memory(), folder);
    last_step_ = world.last_step();
    may_extend_ = !depends_on_length(scene);
    if (may_extend_) world = World(without_end(scene), default_memory(), folder);
    const std::unique_ptr<Recorder> statistics = statistics_of(world, folder);
    world.attach(*statistics);
    {
        const std::lock_guard lock(mutex_);
        scene_ = std::make_shared<const Scene>(world.scene());
    }
    for (const Plant& plant : world.scene().plants) start.plants.push_back(plant.name);
    for (const auto& [name, field] : world.environment().fields().all()) {
        start.fields.push_back({name, field.unit, field.meaning});
    }
    start.last_step = last_step_;
    start.seed = world.scene().seed;
    listener_.started(number(), std::move(start));
    world.start();
    note(world, folder / "statistics.csv");
    for (bool grew = true; !cancelled_; grew = false) {
        for (; !cancelled_ && !stopped_ && !is_over(world); grew = true) {
            world.step();
            note(world, folder / "statistics.csv");
            answer(world);
        }
        if (grew && !is_over(world) && !cancelled_) listener_.stopped(number());
        wait_for_more(world);
        answer(world);
    }
}

void Growth::note(const World& world, const fs::path& statistics) {
    const std::size_t internodes = steps_.add(world.frame());
    GrownStep step;
    step.step = world.steps_done();
    step.last_step = last_step_;
    step.modules = world.modules();
    step.internodes = internodes;
    step.seconds = seconds();
    step.statistics = rows_behind(statistics, statistics_read_);
    statistics_read_ += step.statistics.size();
    step.is_end = is_over(world);
    if (!cancelled_) listener_.grown(number(), std::move(step));
}

void Growth::answer(const World& world) {
    std::deque<std::function<void(const World&)>> questions;
    {
        const std::lock_guard lock(mutex_);
        questions.swap(questions_);
    }
    for (const auto& question : questions) question(world);
}

// A question, an end, or more steps to grow.
void Growth::wait_for_more(const World& world) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return cancelled_ || !questions_.empty() || (!stopped_ && !is_over(world)); });
}

}  // namespace espalier::studio
