#include "studio/session/session.h"

#include "espalier/base/file.h"

#include "base/csv_file.h"
#include "base/number.h"
#include "studio/document/document_files.h"
#include "studio/document/sharing.h"
#include "studio/growth/recording.h"
#include "studio/session/request_text.h"
#include "studio/session/session_viewer.h"

#include <climits>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A growth that takes longer shows its steps as they come, even if only something was edited.
constexpr double patience = 0.7;
/// While something is dragged, a growth may take so long before the next change replaces it.
constexpr double least_growth = 0.4;

Json json_of(const Diagnostic& diagnostic) {
    return {{"severity", diagnostic.severity == Diagnostic::Severity::error ? "error" : "warning"},
            {"file", diagnostic.place.file},
            {"line", diagnostic.place.line},
            {"column", diagnostic.place.column},
            {"message", diagnostic.message},
            {"source", diagnostic.source}};
}

bool same_files(const std::map<fs::path, ReadLog::File>& a, const std::map<fs::path, ReadLog::File>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
        return one.first == other.first && one.second.kept == other.second.kept;
    });
}

Json cell_json(const std::string& cell) {
    if (const std::optional<double> value = whole_text_as<double>(cell)) return *value;
    return cell.empty() ? Json() : Json(cell);
}

}  // namespace

Session::Session(const StudioOptions& options, Post post)
    : options_(options),
      post_([this, alive = std::weak_ptr(alive_), post = std::move(post)](std::function<void()> work) {
          post([this, alive, work = std::move(work)] {
              if (!alive.expired()) guard(work);
          });
      }) {
    restore();
    if (document_.is_open()) begin_growth();
}

Session::~Session() = default;

void Session::join(Page& page) {
    viewers_.push_back(std::make_unique<Viewer>(page));
}

void Session::leave(Page& page) {
    std::erase_if(viewers_, [&](const auto& viewer) { return &viewer->page == &page; });
    waiting_limbs_.erase(&page);
}

void Session::send_later(const Page* page, std::function<void(Page&)> send) {
    post_([this, page, send = std::move(send)] {
        for (const auto& known : viewers_) {
            if (&known->page == page) send(known->page);
        }
    });
}

void Session::receive(Page& page, const std::string& text) {
    const auto viewer =
        std::find_if(viewers_.begin(), viewers_.end(), [&](const auto& known) { return &known->page == &page; });
    if (viewer == viewers_.end()) return;
    Json reply = {{"reply", nullptr}};
    try {
        const Json request = read_request(text);
        reply["reply"] = request["id"];
        const Request answer = request_named(request.at("do").get<std::string>());
        reply.update((this->*answer)(**viewer, request));
    } catch (const Json::exception& error) {
        reply["error"] = fmt::format("the request cannot be understood: {}", error.what());
    } catch (const std::exception& error) {
        reply["error"] = error.what();
    }
    page.send_text(reply.dump(-1, ' ', false, Json::error_handler_t::replace));
    // What a page shows at first it is told behind the reply to its greeting.
    if ((*viewer)->is_new && !reply.contains("error")) guard([&] { send_state_to(**viewer); });
}

void Session::tick() {
    guard([this] {
        begin_next_growth();
        forget_ended();
        begin_limbs();
        look_at_disk_sometimes();
        if (unkept_) keep();
    });
}

// A file that has gone meanwhile must not end the studio.
void Session::guard(const std::function<void()>& work) {
    try {
        work();
    } catch (const std::exception& error) {
        notify("error", error.what());
    }
}

// --- the document

void Session::apply(DocumentState state, const std::string& label, bool transient) {
    const fs::path before = document_.now().opened.path;
    document_.change(std::move(state), label, transient);
    document_changed(before);
}

void Session::document_changed(const fs::path& before, std::optional<int> follow_from) {
    const bool is_other = before != document_.now().opened.path;
    if (is_other) {
        read_.clear();
        problems_.clear();
        recorded_from_.reset();
        watch_.forget();
        disputed_.clear();
    }
    follow_from_ = follow_from.value_or(is_other ? 0 : INT_MAX);
    unkept_ = true;
    // Nothing is known of another document before it has been read.
    is_document_told_ = false;
    if (!is_other) broadcast_document();
    begin_growth();
}

void Session::broadcast_document() {
    is_document_told_ = true;
    broadcast(document_json());
}

const DocumentState& Session::edited() const {
    if (!document_.is_open()) throw UserError("nothing is open");
    if (recorded_from_) return *recorded_from_;
    if (is_run(document_.now().opened.path))
        throw UserError("the run does not tell what it grew from: it can only be watched");
    return document_.now();
}

std::string Session::text_of(const fs::path& file, const DocumentState& state) const {
    const auto found = state.unsaved.find(file);
    return found != state.unsaved.end() ? found->second : read_text(file);
}

void Session::keep() {
    unkept_ = false;
    if (options_.state.empty()) return;
    try {
        fs::create_directories(options_.state.parent_path());
        Json state = document_.to_json();
        for (const auto& [file, text] : document_.now().unsaved) {
            if (watch_.knows(file)) state["on_disk"][file.string()] = watch_.digest_of(file);
        }
        write_private_text(options_.state, state.dump());
    } catch (const std::exception& error) {
        notify("warning", fmt::format("unsaved work cannot be kept: {}", error.what()));
    }
}

void Session::restore() {
    if (!options_.state.empty() && fs::exists(options_.state)) {
        try {
            const Json state = Json::parse(read_text(options_.state));
            document_ = Document::from_json(state);
            const Json on_disk = state.value("on_disk", Json::object());
            for (const auto& [file, digest] : on_disk.items()) watch_.know(file, digest);
        } catch (const std::exception&) {
            notify("warning", fmt::format("what {} kept of the last session cannot be read", options_.state.string()));
        }
    }
    if (options_.opened.path.empty() || (!options_.is_named && document_.is_open())) return;
    Opened opened = options_.opened;
    opened.path = fs::absolute(opened.path).lexically_normal();
    if (document_.now().opened.path == opened.path) return;
    watch_.forget();
    document_.change({opened, {}}, fmt::format("open {}", opened.path.filename().string()), false);
}

// --- growth

void Session::begin_growth() {
    waits_ = true;
    begin_next_growth();
}

void Session::begin_next_growth() {
    if (!waits_ || !document_.is_open()) return;
    // A drag shows what it passes, even if it changes faster than the plant grows.
    const std::unique_ptr<PlantSource>& latest = next_ ? next_ : growth_;
    if (document_.is_transient() && latest && is_busy_ && latest->seconds() < least_growth) return;
    waits_ = false;
    is_busy_ = true;
    forget_ended();
    if (next_) retire(std::move(next_));
    const DocumentState& now = document_.now();
    GrowthListener& listener = *this;
    GrowthOrder order{++last_growth_, document_.version(), now.opened, now.unsaved, options_.scratch, options_.read};
    if (growth_) {
        growth_->rest(true);
        order.before = growth_->shared_steps();
    }
    order.permission = permission_of(now.opened.path, options_.library_folder);
    order.unseen_to = follow_from_;
    for (const auto& viewer : viewers_) {
        if (viewer->step) order.looked_at.insert(*viewer->step);
    }
    if (is_run(now.opened.path)) {
        next_ = std::make_unique<Recording>(std::move(order), listener, workers_);
    } else {
        next_ = std::make_unique<Growth>(std::move(order), listener, workers_);
    }
}

void Session::started(std::uint32_t growth, GrowthStart start) {
    post_([this, growth, start = std::move(start)]() mutable { note_started(growth, std::move(start)); });
}

void Session::grown(std::uint32_t growth, GrownStep step) {
    post_([this, growth, step = std::move(step)] { note_grown(growth, step); });
}

void Session::drawn(std::uint32_t growth, int step, std::string statistics) {
    post_([this, growth, step, statistics = std::move(statistics)] { note_drawn(growth, step, statistics); });
}

void Session::printed(std::uint32_t growth, std::string text) {
    post_([this, growth, text = std::move(text)] { note_printed(growth, text); });
}

void Session::stopped(std::uint32_t growth) {
    post_([this, growth] { note_stopped(growth); });
}

void Session::failed(std::uint32_t growth, std::vector<Diagnostic> why) {
    post_([this, growth, why = std::move(why)] { note_failed(growth, why); });
}

void Session::retire(std::unique_ptr<PlantSource> growth) {
    if (!growth) return;
    growth->cancel();
    retired_.push_back(std::move(growth));
}

void Session::forget_ended() {
    std::erase_if(retired_, [](const auto& growth) { return growth->has_ended(); });
}

void Session::note_started(std::uint32_t growth, GrowthStart start) {
    if (!next_ || next_->number() != growth) return;
    retire(std::move(growth_));
    growth_ = std::move(next_);
    start_ = std::move(start);
    const std::uint64_t seed = growth_->opened().seed ? own_seed_ : start_.seed;
    const int steps = growth_->opened().steps ? own_steps_ : start_.last_step;
    const bool is_known =
        is_document_told_ && same_files(read_, start_.files) && own_seed_ == seed && own_steps_ == steps;
    read_ = start_.files;
    watch(read_);
    recorded_from_ = start_.recorded_from;
    own_seed_ = seed;
    own_steps_ = steps;
    problems_ = start_.warnings;
    printed_.clear();
    newest_ = {};
    newest_.step = -1;
    newest_.last_step = start_.last_step;
    state_ = "growing";
    reason_.clear();
    columns_.clear();
    rows_.clear();
    if (!is_known) broadcast_document();
    broadcast(problems_json());
    broadcast(growth_json());
    broadcast(columns_json());
    broadcast(fields_json());
    broadcast(view_json());
    for (const auto& viewer : viewers_) {
        viewer->awaits.clear();
        if (viewer->step) send_when_drawn(*viewer, *viewer->step);
    }
}

void Session::note_grown(std::uint32_t growth, const GrownStep& step) {
    if (!growth_ || growth_->number() != growth) return;
    newest_ = step;
    newest_.statistics.clear();
    add_statistics(step.statistics);
    state_ = step.is_end ? "done" : "growing";
    if (step.is_end) is_busy_ = false;
    const bool is_over = state_ != "growing";
    const auto now = std::chrono::steady_clock::now();
    if (is_over || now - told_ > std::chrono::milliseconds(40)) {
        told_ = now;
        broadcast(growth_json());
        broadcast_statistics();
    }
    for (const auto& viewer : viewers_) {
        const bool follows = step.step >= follow_from_ || step.seconds > patience;
        const bool wanted = viewer->step ? *viewer->step == step.step || (is_over && *viewer->step > step.step)
                                         : is_over || (follows && !viewer->page.is_behind());
        if (wanted) send_packet(*viewer, step.step);
    }
    begin_next_growth();
}

// A step that had to wait for the newest.
void Session::note_drawn(std::uint32_t growth, int step, const std::string& statistics) {
    if (!growth_ || growth_->number() != growth) return;
    add_statistics(statistics);
    const auto now = std::chrono::steady_clock::now();
    if (step == newest_.step || now - told_ > std::chrono::milliseconds(40)) {
        told_ = now;
        broadcast_statistics();
    }
    for (const auto& viewer : viewers_) {
        if (viewer->awaits.contains(step)) send_packet(*viewer, step);
    }
}

// All that the models of a growth print is one message, as long as it can be read.
void Session::note_printed(std::uint32_t growth, const std::string& text) {
    constexpr std::size_t most_shown = 4000;
    if (!growth_ || growth_->number() != growth || printed_.size() > most_shown) return;
    printed_ += text;
    const bool is_cut = printed_.size() > most_shown;
    if (printed_message_ == 0) printed_message_ = ++last_message_;
    notify_as(printed_message_, "note",
              "Printed by the model:\n" + printed_.substr(0, most_shown) +
                  (is_cut ? "\nMore is left out here; `espalier derive` prints it." : ""));
}

// Pages that wait for a later step get the last there is.
void Session::note_stopped(std::uint32_t growth) {
    if (!growth_ || growth_->number() != growth) return;
    state_ = "stopped";
    is_busy_ = false;
    broadcast(growth_json());
    broadcast_statistics();
    for (const auto& viewer : viewers_) show(*viewer);
    begin_next_growth();
}

void Session::note_failed(std::uint32_t growth, const std::vector<Diagnostic>& why) {
    is_busy_ = false;
    if (next_ && next_->number() == growth) {
        retire(std::move(next_));
        if (growth_) growth_->rest(false);
        problems_ = why;
        if (!is_document_told_) broadcast_document();
        broadcast(problems_json());
    } else if (growth_ && growth_->number() == growth) {
        state_ = "failed";
        for (const Diagnostic& diagnostic : why) reason_ += (reason_.empty() ? "" : "\n") + diagnostic.message;
        problems_ = why;
        broadcast(problems_json());
        broadcast(growth_json());
    }
    begin_next_growth();
}

void Session::add_statistics(const std::string& rows) {
    std::size_t begin = 0;
    for (std::size_t end; (end = rows.find('\n', begin)) != std::string::npos; begin = end + 1) {
        std::vector<std::string> cells = csv_cells(std::string_view(rows).substr(begin, end - begin));
        if (columns_.empty()) {
            columns_ = std::move(cells);
            untold_rows_ = 0;
        } else {
            rows_.push_back(std::move(cells));
        }
    }
}

void Session::broadcast_statistics() {
    if (untold_rows_ < rows_.size()) broadcast(statistics_json(untold_rows_));
    untold_rows_ = rows_.size();
}

void Session::show(Viewer& viewer) {
    if (!growth_ || newest_.step < 0) return;
    send_when_drawn(viewer, std::min(viewer.step.value_or(newest_.step), newest_.step));
}

void Session::send_when_drawn(Viewer& viewer, int step) {
    if (growth_->has_packet(step)) return send_packet(viewer, step);
    viewer.awaits.insert(step);
    growth_->draw(step);
}

void Session::send_packet(Viewer& viewer, int step) {
    viewer.awaits.erase(step);
    const std::vector<std::string> shapes = growth_->shapes();
    if (viewer.growth != growth_->number()) viewer.shapes = viewer.textures = 0;
    viewer.growth = growth_->number();
    const std::size_t textures = growth_->textures().size();
    if (std::exchange(viewer.textures, textures) < textures) viewer.page.send_text(textures_json().dump());
    for (; viewer.shapes < shapes.size(); ++viewer.shapes) viewer.page.send_bytes(shapes[viewer.shapes]);
    viewer.page.send_bytes(growth_->packet(step));
}

// --- what pages are told

void Session::broadcast(const Json& message) {
    const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (const auto& viewer : viewers_) viewer->page.send_text(text);
}

void Session::notify(const std::string& severity, const std::string& text) {
    notify_as(++last_message_, severity, text);
}

// Instead of what this message said before.
void Session::notify_as(std::uint32_t number, const std::string& severity, const std::string& text) {
    Json& message = messages_[number];
    message = {{"say", "message"}, {"number", number}, {"severity", severity}, {"text", text}};
    broadcast(message);
}

void Session::send_state_to(Viewer& viewer) {
    viewer.is_new = false;
    const auto send = [&](const Json& message) {
        viewer.page.send_text(message.dump(-1, ' ', false, Json::error_handler_t::replace));
    };
    send(document_json());
    send(problems_json());
    for (const auto& [number, message] : messages_) send(message);
    if (!growth_) return;
    send(growth_json());
    send(columns_json());
    send(fields_json());
    send(view_json());
    send(statistics_json(0));
    show(viewer);
}

Json Session::problems_json() const {
    Json problems = Json::array();
    for (const Diagnostic& problem : problems_) problems.push_back(json_of(problem));
    return {{"say", "problems"}, {"version", document_.version()}, {"problems", problems}};
}

Json Session::growth_json() const {
    return {{"say", "growth"},
            {"growth", growth_->number()},
            {"version", growth_->version()},
            {"state", state_},
            {"step", newest_.step},
            {"last", newest_.last_step},
            {"modules", newest_.modules},
            {"internodes", newest_.internodes},
            {"derived", newest_.derived},
            {"seconds", newest_.seconds},
            {"reason", reason_},
            {"plants", start_.plants}};
}

Json Session::columns_json() const {
    return {{"say", "columns"}, {"growth", growth_->number()}, {"columns", growth_->column_names()}};
}

Json Session::fields_json() const {
    Json fields = Json::array();
    for (const FieldDescription& field : start_.fields) {
        fields.push_back({{"name", field.name}, {"unit", field.unit}, {"meaning", field.meaning}});
    }
    return {{"say", "fields"}, {"growth", growth_->number()}, {"fields", fields}};
}

Json Session::textures_json() {
    Json files = Json::array(), reliefs = Json::array();
    const auto number = [this](const fs::path& file) { return file.empty() ? Json() : Json(files_.number(file)); };
    for (const BrowserTexture& texture : growth_->textures()) {
        files.push_back(number(texture.colours));
        reliefs.push_back(number(texture.normals));
    }
    return {{"say", "textures"}, {"growth", growth_->number()}, {"files", files}, {"reliefs", reliefs}};
}

Json Session::statistics_json(std::size_t first) const {
    Json rows = Json::array();
    for (std::size_t i = first; i < rows_.size(); ++i) {
        Json row = Json::array();
        for (const std::string& cell : rows_[i]) row.push_back(cell_json(cell));
        rows.push_back(std::move(row));
    }
    return {{"say", "statistics"}, {"growth", growth_->number()}, {"columns", columns_}, {"rows", rows}};
}

}  // namespace espalier::studio
