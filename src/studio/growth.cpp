#include "studio/growth.h"

#include "espalier/simulation/simulation.h"

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

}  // namespace

Growth::Growth(GrowthOrder order, GrowthListener& listener)
    : order_(std::move(order)),
      listener_(listener),
      steps_(order_.number, order_.scratch / fmt::format("growth-{}", order_.number)),
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

void Growth::ask(std::function<void(const World&)> question) {
    const std::lock_guard lock(mutex_);
    questions_.push_back(std::move(question));
    changed_.notify_all();
}

void Growth::live() {
    try {
        const ReadLog reads(std::size_t(64) << 20, order_.unsaved);
        const Scene scene = order_.read(order_.opened);
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
    start.last_step = world.last_step();
    start.seed = world.scene().seed;
    listener_.started(number(), std::move(start));
    world.start();
    note(world, folder / "statistics.csv");
    while (!cancelled_ && !stopped_ && !world.at_end()) {
        world.step();
        note(world, folder / "statistics.csv");
        answer(world);
    }
    if (!world.at_end() && !cancelled_) listener_.stopped(number());
    answer_to_the_end(world);
}

void Growth::note(const World& world, const fs::path& statistics) {
    const std::size_t internodes = steps_.add(world.frame());
    GrownStep step;
    step.step = world.steps_done();
    step.last_step = world.last_step();
    step.modules = world.modules();
    step.internodes = internodes;
    step.seconds = seconds();
    step.statistics = rows_behind(statistics, statistics_read_);
    statistics_read_ += step.statistics.size();
    step.is_end = world.at_end();
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

void Growth::answer_to_the_end(const World& world) {
    while (!cancelled_) {
        answer(world);
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return cancelled_ || !questions_.empty(); });
    }
}

}  // namespace espalier::studio
