#include "studio/session/fits.h"

#include "espalier/base/file.h"

#include "base/reason.h"
#include "studio/document/sharing.h"
#include "studio/session/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_points = 20'000;               // that pages draw
constexpr std::size_t most_bytes = std::size_t(1) << 30;  // of a file
constexpr std::chrono::milliseconds between_words{100};

struct MeasuredNumber {
    static constexpr TypeName type{"MeasuredNumber", "a number that was measured"};
    std::string name;
    double value = 0, scale = 1;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "what was measured");
        field("value", self.value, "in its unit");
        field("scale", self.scale, "the difference that counts as 1");
    }
};

struct MeasuredMoment {
    static constexpr TypeName type{"MeasuredMoment", "a value of a growth that was followed"};
    std::string column;
    double at = 0, value = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("column", self.column, "of the statistics");
        field("at", self.at, "a step or a time");
        field("value", self.value, "in the unit of the column");
    }
};

struct MeasuredFile {
    static constexpr TypeName type{"MeasuredFile", "what a file holds of measured plants"};
    std::uint32_t number = 0;
    std::string name, by;
    std::vector<MeasuredNumber> values;
    std::vector<std::string> notes;
    std::vector<double> points;
    std::vector<std::vector<double>> lines;
    bool has_scale = true;
    std::vector<MeasuredMoment> course;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("number", self.number, "to forget it");
        field("name", self.name, "of the file");
        field("values", self.values, "what is compared");
        field("notes", self.notes, "what is not used, what was guessed");
        field("points", self.points, "x, y, z one after the other, m, y upwards, the plant's foot at 0; some of many");
        field("lines", self.lines, "axes, each as x, y, z one after the other");
        field("has_scale", self.has_scale, "false: only ratios of lengths count");
        field("course", self.course, "a growth that was followed");
        field("by", self.by, "what `at` of the course is", one_of("step time"));
    }
};

struct MeasuredFiles {
    static constexpr TypeName type{"MeasuredFiles", "what the document is compared with"};
    std::vector<MeasuredFile> files;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("files", self.files, "in the order in which they came");
    }
};

struct FitState {
    static constexpr TypeName type{"FitState", "how far a fit has come"};
    std::size_t done = 0, all = 0;
    double residual = 0;
    std::map<std::string, double> best;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("done", self.done, "comparisons that were made");
        field("all", self.all, "at most so many will be");
        field("residual", self.residual, "of the best, root mean square in the scales of what was measured");
        field("best", self.best, "the best values so far, by the names of settings");
    }
};

struct FittedSetting {
    static constexpr TypeName type{"FittedSetting", "what a fit tells of a setting"};
    std::string name;
    double value = 0;
    Nullable<double> error;
    bool decided = false;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("name", self.name, "of the setting");
        field("value", self.value, "the best");
        field("error", self.error, "standard error; null: a small change moves nothing");
        field("decided", self.decided, "by what was measured");
    }
};

struct FitEnd {
    static constexpr TypeName type{"FitEnd", "what came of a fit"};
    std::string end;
    std::vector<FittedSetting> settings;
    std::vector<Nullable<double>> predicted;
    std::vector<std::string> remarks;
    double residual = 0;
    std::size_t worlds = 0;

    template <class Self, class Fields>
    static void declare(Self& self, const Fields& field) {
        field("end", self.end, "a note says why it failed", one_of("done stopped failed"));
        field("settings", self.settings, "empty unless it is done");
        field("predicted", self.predicted, "of the best, beside the values of all files; null: it has none");
        field("remarks", self.remarks, "what cannot be told apart, or is not decided");
        field("residual", self.residual, "as that of the state");
        field("worlds", self.worlds, "that were grown");
    }
};

const Message<MeasuredFiles> measured_message{"measured", "after `measure` and `forget-measured`, and to a new page"};
const Message<FitState> fitting_message{"fitting", "while a fit goes on, ten times a second at most"};
const Message<FitEnd> fitted_message{"fitted", "a fit has ended"};

void append(std::vector<double>& numbers, const glm::dvec3& point) {
    constexpr double of_a_metre = 1e5;  // what pages can show
    for (int i = 0; i < 3; ++i) numbers.push_back(std::round(point[i] * of_a_metre) / of_a_metre);
}

MeasuredFile shown(std::uint32_t number, const fs::path& file, const Measurement& measured) {
    MeasuredFile shown;
    shown.number = number;
    shown.name = file.filename().string();
    shown.by = measured.course_is_by_step ? "step" : "time";
    for (const MeasuredValue& one : measured.values) shown.values.push_back({one.name, one.value, one.scale});
    shown.notes = measured.notes;
    const std::size_t every = 1 + measured.points.size() / most_points;
    for (std::size_t i = 0; i < measured.points.size(); i += every) append(shown.points, measured.points[i]);
    for (const auto& line : measured.lines) {
        std::vector<double>& numbers = shown.lines.emplace_back();
        for (const glm::dvec3& point : line) append(numbers, point);
    }
    shown.has_scale = measured.has_scale;
    for (const CourseValue& one : measured.course) shown.course.push_back({one.column, one.at, one.value});
    return shown;
}

Nullable<double> if_finite(double value) {
    return std::isfinite(value) ? Nullable<double>(value) : Nullable<double>();
}

/// Numbers of a document, each written where it stands in its text.
class WrittenValues {
public:
    WrittenValues(DocumentState state, std::vector<DocumentTexts::Placed> places)
        : state_(std::move(state)), places_(std::move(places)) {
        for (const auto& [file, number] : places_) state_.unsaved[file] = text_of(file, state_);
        for (std::size_t i = 0; i < places_.size(); ++i) from_behind_.push_back(i);
        // What stands behind stays where it is.
        std::sort(from_behind_.begin(), from_behind_.end(),
                  [&](std::size_t a, std::size_t b) { return places_[a].second.offset > places_[b].second.offset; });
    }

    DocumentState with(std::span<const std::pair<std::string, double>> values) const {
        DocumentState state = state_;
        for (const std::size_t i : from_behind_) {
            const auto& [file, number] = places_[i];
            std::string& text = state.unsaved[file];
            text = with_number(text, number, fmt::format("{:.17g}", values[i].second));
        }
        return state;
    }

private:
    DocumentState state_;
    std::vector<DocumentTexts::Placed> places_;
    std::vector<std::size_t> from_behind_;
};

}  // namespace

Fits::Fits(const StudioOptions& options, Pages& pages, const OpenDocument& document, Workers& workers, Post post)
    : options_(options), pages_(pages), document_(document), workers_(workers), post_(std::move(post)) {}

Fits::~Fits() {
    stop_.ask();
    stop_reading_.ask();
    for (RunningWork& work : running_) work.wait();
}

void Fits::require_fitting() const {
    if (!can_fit()) throw UserError("this studio cannot fit: that needs the program on a machine");
}

void Fits::add(const fs::path& file) {
    require_fitting();
    if (!fs::is_regular_file(file)) throw UserError(fmt::format("there is no file {}", file.string()));
    read(file, permission_of(document_.path(), options_.library_folder));
}

void Fits::add_sent(const std::string& name, const std::string& bytes) {
    require_fitting();
    const fs::path plain = fs::path(name).filename();
    if (plain.empty() || plain.string().front() == '.') throw UserError(fmt::format("'{}' is no name of a file", name));
    if (plain.extension() == ".toml") {
        throw UserError("a table names a file of points: give its place below the opened folder instead");
    }
    const fs::path folder = options_.scratch / fmt::format("measured-{}", ++sent_);
    fs::create_directories(folder);
    write_text(folder / plain, bytes);
    read(folder / plain, ReadPermission{{folder}, most_bytes});
}

void Fits::read(const fs::path& file, std::optional<ReadPermission> permission) {
    run([this, file, permission = std::move(permission)] {
        const StopRequest::Scope scope(&stop_reading_);
        const ReadLog reads(0, {}, permission);
        try {
            auto content = std::make_shared<Measurement>(options_.fitting.read(file));
            post_([this, file, content] { note_read(file, std::move(*content)); });
        } catch (const Stopped&) {
        } catch (const std::exception& error) {
            post_([this, why = reason_of(error)] { pages_.notify("error", why); });
        }
    });
}

void Fits::run(std::function<void()> work) {
    std::erase_if(running_, [](const RunningWork& before) { return before.has_ended(); });
    running_.push_back(workers_.run(std::move(work)));
}

void Fits::note_read(const fs::path& file, Measurement content) {
    measured_[++last_number_] = {file, std::move(content)};
    pages_.broadcast(list_message());
}

void Fits::remove(std::uint32_t number) {
    if (measured_.erase(number) == 0) throw UserError(fmt::format("nothing measured has the number {}", number));
    pages_.broadcast(list_message());
}

SoughtNumber Fits::sought(const Range& range, const DocumentTexts::Placed& placed) const {
    const WrittenNumber& number = placed.second;
    if (number.is_switch) throw UserError(fmt::format("{} is a switch: a fit seeks numbers", range.name));
    if (!(range.lowest < range.highest) || range.lowest < number.lowest || range.highest > number.highest) {
        throw UserError(
            fmt::format("{}: from {:.6g} to {:.6g} is no range of it", range.name, range.lowest, range.highest));
    }
    return {range.name, std::clamp(number.value, range.lowest, range.highest), range.lowest, range.highest,
            number.whole};
}

void Fits::begin(const std::vector<Range>& ranges, std::size_t search) {
    require_fitting();
    if (is_fitting_) throw UserError("another fit is going on");
    if (measured_.empty()) throw UserError("nothing was measured: choose a file first");
    if (ranges.empty()) throw UserError("no setting is sought: choose one");
    const DocumentState state = document_.edited();
    const auto known = document_.texts().numbers(state);
    FitOrder order;
    order.search = search;
    std::vector<DocumentTexts::Placed> places;
    for (const Range& range : ranges) {
        const auto found = known.find(range.name);
        if (found == known.end()) throw UserError(fmt::format("there is no setting '{}'", range.name));
        const auto is_it = [&](const SoughtNumber& other) { return other.name == range.name; };
        if (std::any_of(order.sought.begin(), order.sought.end(), is_it)) {
            throw UserError(fmt::format("{} is sought twice", range.name));
        }
        order.sought.push_back(sought(range, found->second));
        places.push_back(found->second);
    }
    for (const auto& [number, one] : measured_) order.measured.push_back(one.content.read);
    const auto permission = permission_of(state.opened.path, options_.library_folder);
    order.scene = [this, texts = WrittenValues(state, places), permission](const auto values) {
        const DocumentState changed = texts.with(values);
        const ReadLog reads(0, changed.unsaved, permission);
        return options_.read(changed.opened);
    };
    names_.clear();
    for (const SoughtNumber& one : order.sought) names_.push_back(one.name);
    best_ = {};
    is_fitting_ = true;
    stop_.withdraw();
    run([this, order = std::move(order), unsaved = state.unsaved, permission]() mutable {
        const ReadLog reads(0, unsaved, permission);  // side files
        order.progress = [this, last = std::chrono::steady_clock::time_point()](const BestSoFar& best) mutable {
            const auto now = std::chrono::steady_clock::now();
            if (now - last < between_words) return;
            last = now;
            post_([this, best] {
                best_ = best;
                pages_.broadcast(state_message());
            });
        };
        work(order);
    });
}

void Fits::work(const FitOrder& order) {
    const StopRequest::Scope scope(&stop_);
    FitEnd end;
    std::string why;
    try {
        const FitOutcome outcome = options_.fitting.fit(order);
        end.end = "done";
        for (std::size_t i = 0; i < outcome.numbers.size(); ++i) {
            const FittedNumber& one = outcome.numbers[i];
            end.settings.push_back({order.sought[i].name, one.value, if_finite(one.error), one.is_decided});
        }
        for (const double value : outcome.predicted) end.predicted.push_back(if_finite(value));
        end.remarks = outcome.remarks;
        end.residual = outcome.residual;
        end.worlds = outcome.worlds;
    } catch (const Stopped&) {
        end.end = "stopped";
    } catch (const std::exception& error) {
        end.end = "failed";
        why = reason_of(error);
    }
    post_([this, message = fitted_message(end), why] {
        if (!why.empty()) pages_.notify("error", why);
        is_fitting_ = false;
        pages_.broadcast(message);
    });
}

void Fits::stop() {
    stop_.ask();
}

Json Fits::list_message() const {
    MeasuredFiles all;
    for (const auto& [number, one] : measured_) all.files.push_back(shown(number, one.file, one.content));
    return measured_message(all);
}

Json Fits::state_message() const {
    FitState state{best_.done, best_.all, best_.residual, {}};
    for (std::size_t i = 0; i < best_.values.size(); ++i) state.best[names_[i]] = best_.values[i];
    return fitting_message(state);
}

void Fits::send_to(Viewer& viewer) const {
    if (!measured_.empty()) Pages::send(viewer, list_message());
    if (is_fitting_) Pages::send(viewer, state_message());
}

}  // namespace espalier::studio
