#include "studio/growth/recording.h"

#include "espalier/base/file.h"

#include "base/json_text.h"
#include "base/reason.h"
#include "simulation/run/recorded_command.h"
#include "studio/growth/inquiry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_frames = 4;  ///< that are kept as they were read
constexpr std::size_t most_packet_bytes = std::size_t(512) << 20;
constexpr std::chrono::seconds longest_history{1};  ///< that a page waits for

// The model or scene that the run was started with; nothing if it is not among what it read.
std::optional<fs::path> main_file(const RecordedCommand& command) {
    for (const std::string& argument : command.arguments) {
        const fs::path path = (command.folder / argument).lexically_normal();
        if (!argument.starts_with("-") && (command.inputs.contains(path) || fs::is_directory(path))) return path;
    }
    return std::nullopt;
}

// Options whose effect the texts do not show.
std::vector<std::string> other_options(const RecordedCommand& command) {
    std::vector<std::string> options;
    for (const std::string& argument : command.arguments) {
        const std::string name = argument.substr(0, argument.find('='));
        if (name.starts_with("--") && name != "--steps" && name != "--seed") options.push_back(name);
    }
    return options;
}

std::vector<Nullable<double>> recorded_numbers(const OrganHistory& known, const OrganMoment& moment,
                                               const std::vector<std::string>& names) {
    std::vector<Nullable<double>> row;
    for (const std::string& name : names) {
        const auto at = std::find(known.parameters.begin(), known.parameters.end(), name);
        const auto number = static_cast<std::size_t>(at - known.parameters.begin());
        row.push_back(number < moment.parameters.size() ? Nullable<double>(moment.parameters[number])
                                                        : Nullable<double>());
    }
    return row;
}

Diagnostic warning(const std::string& message) {
    Diagnostic diagnostic;
    diagnostic.severity = Diagnostic::Severity::warning;
    diagnostic.message = message;
    return diagnostic;
}

/// The model, or a file that it reads and that the run has kept.
bool has_lost_files(const fs::path& main, const RecordedCommand& command) {
    return !fs::exists(main) || std::any_of(command.inputs.begin(), command.inputs.end(), [](const auto& input) {
        return input.second.kept && !fs::exists(input.first);
    });
}

// What the run grew from, as it was then: inputs that have changed become unsaved texts, and if one has gone, all are
// written below `scratch`. Returns the folder below which the inputs lie by their absolute paths; empty: the root.
fs::path find_source(const fs::path& folder, const fs::path& scratch, GrowthStart& start) {
    const RecordedCommand command = read_command(folder);
    const Json json = read_json<Json>(read_text(folder / "run.json"));
    std::optional<fs::path> main = main_file(command);
    if (!main) return {};
    fs::path root;
    if (has_lost_files(*main, command)) {
        root = scratch;
        lay_out_inputs(command, root);
        main = root / main->relative_path();
    }
    DocumentState source;
    source.opened = {*main, json.at("steps").get<int>(), json.at("seed").get<std::uint64_t>()};
    for (const auto& [path, file] : command.inputs) {
        const fs::path here = root.empty() ? path : root / path.relative_path();
        start.files[here] = file;
        if (file.kept && fs::exists(here) && !is_unchanged(here, file)) source.unsaved[here] = file.bytes;
    }
    start.seed = *source.opened.seed;
    start.recorded_from = std::move(source);
    if (const std::vector<std::string> options = other_options(command); !options.empty()) {
        start.warnings.push_back(
            warning(fmt::format("the run was started with {}, which its texts do not say: grown again it may differ",
                                fmt::join(options, ", "))));
    }
    return root;
}

/// The light of all steps up to the last, from files as they were; nothing, with a warning, where one is missing.
void find_sky(const fs::path& folder, const fs::path& root, GrowthStart& start) {
    const ReadLog reads(0, start.recorded_from ? start.recorded_from->unsaved : UnsavedTexts());
    try {
        start.sky = environment::sky_of_run(folder, root);
        if (start.sky) start.sky->at_step(start.last_step);
    } catch (const std::exception& error) {
        start.sky.reset();
        start.warnings.push_back(warning(fmt::format("the scene's sun does not show: {}", reason_of(error))));
    }
}

std::string hexadecimal(std::uint64_t identity) {
    return fmt::format("{:016x}", identity);
}

std::vector<std::size_t> siblings_of(const DrawnFrame& frame, std::uint32_t module) {
    const RecordedModule& one = frame.modules()[module];
    std::vector<std::size_t> siblings;
    for (std::size_t i = 0; i < frame.modules().size(); ++i) {
        const RecordedModule& other = frame.modules()[i];
        const bool is_sibling = other.organ.plant == one.organ.plant && other.parent == one.parent &&
                                other.birth == one.birth && i != module;
        if (is_sibling) siblings.push_back(i);
    }
    return siblings;
}

Nullable<PickedParent> parent_of(const DrawnFrame& frame, const RecordedModule& one) {
    if (one.parent == 0) return {};
    PickedParent parent;
    parent.identity = hexadecimal(one.parent);
    for (std::size_t i = 0; i < frame.modules().size(); ++i) {
        const RecordedModule& other = frame.modules()[i];
        if (other.organ != OrganKey{one.organ.plant, one.parent}) continue;
        parent.module = i;
        parent.symbol = frame.symbol_name(other.symbol);
        parent.born = other.birth;
    }
    return parent;
}

}  // namespace

Recording::Recording(GrowthOrder order, GrowthListener& listener, Workers& workers)
    : order_(std::move(order)),
      listener_(listener),
      wanted_(order_.looked_at),
      running_(workers.run([this] { live(); })) {}

Recording::~Recording() {
    cancel();
    running_.wait();
}

double Recording::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Recording::cancel() {
    cancelled_ = true;
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
}

void Recording::draw(int step) {
    const std::lock_guard lock(mutex_);
    wanted_.insert(step);
    changed_.notify_all();
}

void Recording::live() {
    try {
        begin();
        while (!cancelled_) {
            draw_wanted();
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return cancelled_ || !wanted_.empty(); });
        }
    } catch (const std::exception& error) {
        Diagnostic why;
        why.message = reason_of(error);
        if (!cancelled_) listener_.failed(number(), {why});
    }
}

void Recording::begin() {
    run_ = std::make_unique<const RecordedRun>(order_.opened.path);
    const auto& frames = run_->frames();
    if (frames.empty() || std::any_of(frames.begin(), frames.end(), [](const auto& one) { return one.plants.empty(); }))
        throw UserError(fmt::format("{} has no recorded plants to show", run_->folder().string()));
    GrowthStart start;
    for (const RecordedPlant& plant : run_->plants()) start.plants.push_back(plant.name);
    start.last_step = frames.back().step;
    try {
        const fs::path scratch = order_.scratch / fmt::format("run-{}", number());
        find_sky(run_->folder(), find_source(run_->folder(), scratch, start), start);
    } catch (const std::exception& error) {
        start.warnings.push_back(warning(fmt::format("it can be watched, but not edited: {}", reason_of(error))));
    }
    const std::shared_ptr<const DrawnFrame> last = frame(frames.size() - 1);
    columns_ = last->columns();
    draw(start.last_step);
    GrownStep step;
    step.step = step.last_step = start.last_step;
    step.modules = last->modules().size();
    step.internodes = last->internodes();
    const fs::path statistics = run_->folder() / "statistics.csv";
    if (fs::exists(statistics)) step.statistics = read_text(statistics);
    step.units = run_->units();
    step.is_end = true;
    if (cancelled_) return;
    listener_.started(number(), std::move(start));
    draw_wanted();
    listener_.grown(number(), std::move(step));
}

void Recording::draw_wanted() {
    while (!cancelled_) {
        int step = 0;
        {
            const std::lock_guard lock(mutex_);
            if (wanted_.empty()) return;
            step = wanted_.extract(wanted_.begin()).value();
        }
        if (!has(step)) continue;
        if (!has_packet(step)) {
            const std::size_t at = frame_at(step);
            std::string bytes = frame(at)->packet(number(), run_->frames()[at].step);
            const std::lock_guard lock(mutex_);
            packet_bytes_ += bytes.size();
            packets_[at] = std::move(bytes);
            while (packet_bytes_ > most_packet_bytes && packets_.size() > 1) {
                const auto oldest = packets_.begin()->first == at ? std::prev(packets_.end()) : packets_.begin();
                packet_bytes_ -= oldest->second.size();
                packets_.erase(oldest);
            }
        }
        listener_.drawn(number(), step, "");
    }
}

bool Recording::has(int step) const {
    return step >= 0 && run_ && step <= run_->frames().back().step;
}

std::size_t Recording::frame_at(int step) const {
    if (!has(step)) throw UserError(fmt::format("step {} was not recorded", step));
    const auto& frames = run_->frames();
    const auto behind = std::upper_bound(frames.begin(), frames.end(), step,
                                         [](int wanted, const RecordedFrame& one) { return wanted < one.step; });
    return behind == frames.begin() ? 0 : static_cast<std::size_t>(behind - frames.begin()) - 1;
}

bool Recording::has_packet(int step) const {
    if (!has(step)) return false;
    const std::lock_guard lock(mutex_);
    return packets_.contains(frame_at(step));
}

// Under the step that was asked for: pages wait for that.
std::string Recording::packet(int step) const {
    const std::lock_guard lock(mutex_);
    return PacketParts::of_step(step, packets_.at(frame_at(step)));
}

std::shared_ptr<const DrawnFrame> Recording::frame(std::size_t number) const {
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [known, frame] : frames_) {
            if (known == number) return frame;
        }
    }
    auto read = std::make_shared<const DrawnFrame>(*run_, run_->frames()[number]);
    const std::lock_guard lock(mutex_);
    frames_.emplace_front(number, read);
    if (frames_.size() > most_frames) frames_.pop_back();
    return read;
}

std::string Recording::column(int step, const std::string& name) const {
    return frame(frame_at(step))->column(number(), step, name);
}

std::string Recording::field(int /*step*/, const std::string& name) const {
    throw UserError(fmt::format("there is no field '{}': those of recorded runs are not shown", name));
}

Picked Recording::module_info(int step, std::uint32_t module) const {
    const std::shared_ptr<const DrawnFrame> shown = frame(frame_at(step));
    if (module >= shown->modules().size()) throw UserError(fmt::format("step {} has no module {}", step, module));
    const RecordedModule& one = shown->modules()[module];
    Picked picked;
    picked.symbol = picked.text = shown->symbol_name(one.symbol);
    picked.identity = hexadecimal(one.organ.identity);
    picked.born = one.birth;
    picked.order = one.order;
    picked.parent = parent_of(*shown, one);
    picked.siblings = siblings_of(*shown, module);
    picked.places.emplace();
    for (const RecordedPlant& plant : run_->plants()) {
        if (plant.number == one.organ.plant) picked.plant = plant.name;
    }
    picked.children = static_cast<std::size_t>(
        std::count_if(shown->modules().begin(), shown->modules().end(), [&](const RecordedModule& other) {
            return other.organ.plant == one.organ.plant && other.parent == one.organ.identity;
        }));
    for (const auto& [name, value] : shown->parameters(one)) {
        picked.names.push_back(name);
        picked.parameters.push_back(value);
    }
    const auto known = moments(one.organ, step);
    picked.history = known ? history(*known, step, picked.names) : PickedHistory();
    if (known) picked.day = day(*known, step, picked.names, shown->units());
    return picked;
}

// As far as it can be read while a page waits.
std::optional<OrganHistory> Recording::moments(const OrganKey& organ, int step) const {
    const auto end = std::chrono::steady_clock::now() + longest_history;
    const auto in_time = [end](const OrganHistory&, std::size_t, std::size_t) {
        return std::chrono::steady_clock::now() < end;
    };
    return histories_.history(*run_, organ, run_->frames()[frame_at(step)].step, in_time);
}

PickedHistory Recording::history(const OrganHistory& known, int step, const std::vector<std::string>& names) const {
    PickedHistory found;
    for (const OrganMoment& moment : known.moments) {
        if (moment.step > step) break;
        found.steps.push_back(moment.step);
        found.parameters.push_back(recorded_numbers(known, moment, names));
    }
    return found;
}

// What processes know has a name with a dot.
std::optional<PickedDay> Recording::day(const OrganHistory& known, int step, const std::vector<std::string>& names,
                                        const std::map<std::string, std::string>& units) const {
    const std::optional<StepsOfDay> of_day = steps_of_day(run_->dt(), run_->time_unit(), step);
    PickedDay course;
    for (const std::string& name : names) {
        if (name.find('.') == std::string::npos) continue;
        course.names.push_back(name);
        const auto unit = units.find(name);
        course.units.push_back(unit == units.end() ? "" : unit->second);
    }
    if (!of_day || course.names.empty()) return std::nullopt;
    course.values.resize(course.names.size());
    for (const OrganMoment& moment : known.moments) {
        if (moment.step < of_day->first || moment.step > of_day->last) continue;
        course.steps.push_back(moment.step);
        course.hours.push_back(of_day->hour_at_end_of(moment.step));
        const std::vector<Nullable<double>> row = recorded_numbers(known, moment, course.names);
        for (std::size_t i = 0; i < row.size(); ++i) course.values[i].push_back(row[i]);
    }
    return course;
}

}  // namespace espalier::studio
