#include "studio/growth/growth.h"

#include "espalier/simulation/simulation.h"

#include "base/reason.h"
#include "simulation/run/allowed_memory.h"
#include "studio/growth/derivation_length.h"
#include "studio/growth/inquiry.h"
#include "studio/growth/organ_columns.h"
#include "studio/growth/reuse_plan.h"
#include "studio/packets/field_bytes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
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
    return said(reason_of(error));
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

std::optional<environment::SceneSky> sky_of(const Scene& scene) {
    auto processes = nlohmann::ordered_json::object();
    for (const auto& [name, table] : scene.environment.processes) {
        processes[name] = nlohmann::ordered_json::parse(table.resolved_json());
    }
    return environment::sky_of_processes(processes, scene.dt, scene.path.parent_path());
}

/// Seconds that a growth may go on before it shows a step.
constexpr double most_unseen = 0.3;

}  // namespace

/// What the growth is at; of its own thread.
struct Growth::Work {
    Work(const Scene& grown, std::size_t bytes, const fs::path& folder, std::shared_ptr<Printout> prints)
        : scene(grown),
          memory(bytes),
          files(folder),
          printout(std::move(prints)),
          world(grown, memory, folder, printout),
          statistics(statistics_of(world, folder)),
          statistics_file(folder / "statistics.csv") {}

    /// The rows that the frame adds.
    std::string record(const Frame& frame) {
        statistics->record(frame);
        for (const PlantFrame& plant : frame.plants) {
            for (const Quantity& one : plant.quantities) units[one.name] = one.unit;
        }
        std::string rows = rows_behind(statistics_file, statistics_read);
        statistics_read += rows.size();
        return rows;
    }

    /// Instead of one that was left in the midst of a step.
    void renew_world() {
        world = StagedWorld(scene, memory, files, printout);
        at = -1;
    }

    const Scene& scene;
    const std::size_t memory;
    const fs::path files;
    const std::shared_ptr<Printout> printout;
    StagedWorld world;
    std::unique_ptr<Recorder> statistics;
    fs::path statistics_file;
    std::size_t statistics_read = 0;
    std::map<std::string, std::string> units;  ///< of what processes told of plants
    std::shared_ptr<const Origin> origin;      ///< null: what is drawn comes back to the strings
    bool draws_apart = false;                  ///< steps may be drawn in any order, or not at all
    int at = -1;                               ///< the step that the world is at
    int derived = -1;                          ///< the last step that there is
    int own_steps = 0;                         ///< that were derived here
    int drawn = -1;                            ///< up to it all steps have been drawn in order, with their statistics
    int told = -1;                             ///< the last step that the listener knows
    bool is_ended = false;                     ///< the model has stopped
    bool told_stop = false;                    ///< or that it asks
    std::size_t modules = 0;                   ///< of the last step that was derived here
    double factor = 0;                         ///< by which they multiplied in it; 0: not known
    std::size_t expected = 0;                  ///< of the next step, as far as two steps tell
    bool is_deriving = false;
    bool is_whole = true;        ///< the world is not in the midst of a step
    bool draws_in_order = true;  ///< until it was told to stop while it did
};

Growth::Growth(GrowthOrder order, GrowthListener& listener, Workers& workers)
    : before_(std::move(order.before)),
      order_(std::move(order)),
      listener_(listener),
      printed_([this](std::string text) {
          if (!cancelled_) listener_.printed(number(), std::move(text));
      }),
      steps_(std::make_shared<KeptSteps>(order_.number, order_.scratch / fmt::format("growth-{}", order_.number))),
      version_(order_.version),
      may_be_large_(order_.may_be_large),
      wanted_(order_.looked_at),
      running_(workers.run(*this)) {}

Growth::~Growth() {
    cancel();
    running_.wait();
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
    request_.ask();
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
}

bool Growth::extend(int last_step, std::uint64_t version) {
    if (!may_extend_ || last_step < last_step_) return false;
    const std::lock_guard lock(mutex_);
    version_ = version;
    last_step_ = last_step;
    stopped_ = false;
    request_.withdraw();
    changed_.notify_all();
    return true;
}

void Growth::stop() {
    stopped_ = true;
    request_.ask(patience_with_steps);
}

void Growth::go_on() {
    may_be_large_ = true;
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
}

std::vector<std::string> Growth::column_names() const {
    std::vector<std::string> names = studio::column_names(*scene());
    const std::lock_guard lock(mutex_);
    std::vector<std::string> organs;
    for (const OrganColumn& column : organ_columns_) organs.push_back(column.name);
    names.insert(names.begin(), organs.begin(), organs.end());
    return names;
}

std::string Growth::column(int step, const std::string& name) const {
    return steps_->organs().has(name) ? steps_->organs().message(name, step, number())
                                      : studio::column(*scene(), *steps_, number(), step, name);
}

Picked Growth::module_info(int step, std::uint32_t module) const {
    std::vector<OrganColumn> organs;
    {
        const std::lock_guard lock(mutex_);
        organs = organ_columns_;
    }
    return studio::module_info(*scene(), *steps_, organs, step, module);
}

void Growth::pause_drawing(bool pauses) {
    const std::lock_guard lock(mutex_);
    rests_ = pauses;
    changed_.notify_all();
}

void Growth::draw(int step) {
    const std::lock_guard lock(mutex_);
    wanted_.insert(step);
    changed_.notify_all();
}

// One piece of its life: it is read, it grows by a step, or it draws one.
Growth::Then Growth::next() {
    const StopRequest::Scope stops(&request_);
    const ReadLog::Scope reads(reads_.get());
    try {
        return work_ ? grow(*work_) : open();
    } catch (const Stopped&) {
        return fail(said("it was stopped before the first step"));
    } catch (const std::bad_alloc&) {
        return fail(said("the machine has no memory left"));
    } catch (const std::exception& error) {
        return fail(diagnostics_of(error));
    }
}

Growth::Then Growth::fail(const std::vector<Diagnostic>& why) {
    printed_.send();
    if (!cancelled_) listener_.failed(number(), why);
    return end();
}

Growth::Then Growth::end() {
    work_.reset();
    read_scene_.reset();
    reads_.reset();
    return Then::ended;
}

Growth::Then Growth::open() {
    reads_ = std::make_unique<ReadLog>(std::size_t(64) << 20, order_.unsaved, order_.permission);
    read_scene_ = std::make_unique<const Scene>(order_.read(order_.opened));
    note_texture_files(*read_scene_);
    GrowthStart start;
    start.warnings = read_scene_->notes.diagnostics;
    if (cancelled_) return end();
    const fs::path folder = order_.scratch / fmt::format("files-{}", number());
    fs::create_directories(folder);
    work_ = std::make_unique<Work>(*read_scene_, allowed_memory(order_.memory, order_.opened.path), folder,
                                   printed_.printout());
    start.files = reads_->files();  // processes have read theirs, such as meshes
    begin(*work_, std::move(start));
    return Then::goes_on;
}

void Growth::begin(Work& work, GrowthStart start) {
    StagedWorld& world = work.world;
    last_step_ = world.last_step();
    may_extend_ = !depends_on_length(world.scene());
    if (draws_apart(world.scene())) {
        work.origin = std::make_shared<const Origin>(Origin{world.scene(), start.files, last_step_});
        work.draws_apart = true;
    } else if (stages_draw_apart(world)) {
        work.origin = std::make_shared<const Origin>(Origin{world.scene(), start.files, last_step_, true});
    }
    if (work.origin) steps_->expect(world.scene());
    if (may_extend_) world.set_steps(most_steps);
    const std::vector<OrganColumn> columns = organ_columns(world.scene(), world.environment());
    const std::shared_ptr<const KeptSteps> before = std::move(before_);
    const auto knows = [&](const OrganColumn& organ) { return before->organs().has(organ.name); };
    const bool serves =
        work.origin && before && (!work.origin->exchanges || std::all_of(columns.begin(), columns.end(), knows));
    if (serves) work.derived = steps_->inherit(*before, *work.origin);
    if (!work.draws_apart && work.derived >= 0) {
        work.draws_apart = true;
        may_extend_ = false;
    }
    {
        const std::lock_guard lock(mutex_);
        scene_ = std::make_shared<const Scene>(world.scene());
        organ_columns_ = columns;
    }
    for (const Plant& plant : world.scene().plants) start.plants.push_back(plant.name);
    for (const auto& [name, field] : world.environment().fields().all()) {
        start.fields.push_back({name, field.unit, field.meaning});
    }
    start.sky = sky_of(world.scene());
    start.last_step = last_step_;
    start.seed = world.scene().seed;
    listener_.started(number(), std::move(start));
    if (work.derived >= 0) go_to(work, work.derived);
    work.is_ended = world.stopped();
}

Growth::Then Growth::grow(Work& work) {
    if (cancelled_) return end();
    printed_.send();
    try {
        if (advance(work)) return Then::goes_on;
    } catch (const Stopped&) {
        drop(work);
        return Then::goes_on;
    }
    const bool is_over = work.is_ended || work.derived >= last_step_;
    if (is_over || std::exchange(work.told_stop, true)) return Then::waits;
    if (stopped_) {
        listener_.stopped(number());
    } else {
        listener_.asks(number(), work.expected);
    }
    return Then::waits;
}

// It was meant for other work than what follows; not so a request by cancel().
void Growth::forget_stop() {
    request_.withdraw();
    if (cancelled_) request_.ask();
}

// The step at hand, or its picture. Of a world with processes nothing remains to go on from.
void Growth::drop(Work& work) {
    if (cancelled_) return;
    forget_stop();
    if (!std::exchange(work.is_deriving, false)) work.draws_in_order = false;
    if (work.draws_apart) {
        work.renew_world();
        if (may_extend_) work.world.set_steps(most_steps);
        return;
    }
    const std::lock_guard lock(mutex_);
    may_extend_ = work.is_whole = false;
    stopped_ = true;
}

bool Growth::may_grow(const Work& work) const {
    return !stopped_ && !work.is_ended && work.derived < last_step_ && !must_ask(work);
}

bool Growth::must_ask(const Work& work) const {
    return !may_be_large_ && work.expected > most_unasked;
}

// One piece of work; false if there is none.
bool Growth::advance(Work& work) {
    const bool grows = may_grow(work);
    if (!grows && stopped_) forget_stop();  // what was derived is still drawn
    if (!work.draws_apart) {
        forget_wanted();
        if (grows) step(work);
        return grows;
    }
    const bool is_unseen = work.derived < order_.unseen_to && seconds() < most_unseen;
    if (grows && (is_unseen || work.drawn == work.derived)) {
        derive(work);
        return true;
    }
    if (draw_wanted(work)) return true;
    if (!may_draw_in_order(work)) return false;
    draw_in_order(work);
    return true;
}

void Growth::note_derived(Work& work) {
    work.at = work.derived = work.world.steps_done();
    ++work.own_steps;
    work.is_ended = work.world.stopped();
    const std::size_t before = std::exchange(work.modules, work.world.modules());
    const double factor = before > 0 ? double(work.modules) / double(before) : 0;
    // An axiom that becomes a whole plant in one step does not go on like that.
    work.expected =
        static_cast<std::size_t>(std::min(factor, std::exchange(work.factor, factor)) * double(work.modules));
    work.told_stop = false;
    work.draws_in_order = true;
    if (!may_extend_) last_step_ = work.world.last_step();  // models may change it
}

void Growth::step(Work& work) {
    if (work.derived < 0) {
        work.world.start();
    } else {
        work.world.step();
    }
    note_derived(work);
    if (work.is_ended) steps_->note_stop(work.at);
    const Frame frame = work.world.frame();
    std::string rows = work.record(frame);
    for (const auto& [name, field] : frame.fields->all()) {
        steps_->fields().add(name, work.at, field_bytes(field, number(), 0));
    }
    for (const auto& [name, unit] : organ_columns_) {
        steps_->organs().add(name, work.at, organ_column(frame, number(), name));
    }
    if (work.origin) steps_->add_derived(work.world.derived(), work.origin);
    note_grown(work, steps_->add(frame), std::move(rows));
}

void Growth::derive(Work& work) {
    work.is_deriving = true;
    go_to(work, work.derived);
    if (work.derived < 0) {
        work.world.write_axioms();
    } else {
        work.world.derive();
    }
    work.is_deriving = false;
    note_derived(work);
    steps_->add_derived(work.world.derived(), work.origin);
}

void Growth::go_to(Work& work, int step) {
    if (work.at != step) work.world.take(steps_->derived(step));
    work.at = step;
}

// The steps that pages look at, and the last step.
bool Growth::draw_wanted(Work& work) {
    if (const std::optional<int> wanted = next_wanted(work)) {
        if (!steps_->has_packet(*wanted)) {
            steps_->add(frame_at(work, *wanted));
            listener_.drawn(number(), *wanted, "");
        }
        return true;
    }
    if (!work.draws_in_order || work.told == work.derived || work.drawn + 1 == work.derived) return false;
    note_grown(work, steps_->add(frame_at(work, work.derived)), "");
    return true;
}

// Every step was drawn when it was grown.
void Growth::forget_wanted() {
    const std::lock_guard lock(mutex_);
    wanted_.clear();
}

std::optional<int> Growth::next_wanted(const Work& work) {
    const std::lock_guard lock(mutex_);
    if (!may_grow(work)) wanted_.erase(wanted_.upper_bound(work.derived), wanted_.end());
    if (wanted_.empty() || *wanted_.begin() > work.derived) return std::nullopt;
    return wanted_.extract(wanted_.begin()).value();
}

bool Growth::may_draw_in_order(const Work& work) const {
    return work.draws_in_order && work.drawn < work.derived && (!rests_ || work.told < work.derived);
}

void Growth::draw_in_order(Work& work) {
    const int step = ++work.drawn;
    const Frame frame = frame_at(work, step);
    std::string rows = work.record(frame);
    if (step > work.told) {
        note_grown(work, steps_->add(frame), std::move(rows));
    } else {
        if (!steps_->has_packet(step)) steps_->add(frame);
        if (!cancelled_) listener_.drawn(number(), step, std::move(rows));
    }
}

Frame Growth::frame_at(Work& work, int step) {
    go_to(work, step);
    work.world.interpret();
    if (work.origin->exchanges) return answered_frame(work, step);
    work.world.exchange();
    return work.world.frame();
}

// Its string has the answers already, and what processes told of it was kept.
Frame Growth::answered_frame(const Work& work, int step) const {
    Frame frame = work.world.frame_of_plants();
    const std::vector<std::vector<Quantity>> quantities = steps_->quantities(step);
    for (std::size_t i = 0; i < frame.plants.size(); ++i) frame.plants[i].quantities = quantities[i];
    return frame;
}

// The newest step has been drawn.
void Growth::note_grown(Work& work, std::size_t internodes, std::string statistics) {
    work.told = work.at;
    if (!work.draws_apart) work.drawn = work.at;
    GrownStep step;
    step.step = work.at;
    step.last_step = last_step_;
    step.modules = work.world.modules();
    step.internodes = internodes;
    step.derived = work.own_steps;
    step.seconds = seconds();
    step.statistics = std::move(statistics);
    step.units = work.units;
    step.is_end = work.is_ended || work.at >= last_step_;
    if (!cancelled_) listener_.grown(number(), std::move(step));
}

// For an end, or steps to grow or to draw.
void Growth::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock,
                  [&] { return cancelled_ || !wanted_.empty() || may_grow(*work_) || may_draw_in_order(*work_); });
}

}  // namespace espalier::studio
