// The requests of docs/studio-protocol.md.
#include "espalier/base/file.h"
#include "espalier/environment/environment_process.h"
#include "espalier/formats/exporter.h"
#include "espalier/language/notation.h"
#include "espalier/timeline/recorder.h"
#include "espalier/turtle/geometry_stage.h"
#include "espalier/turtle/symbol.h"

#include "base/text.h"
#include "language/parser/functions.h"
#include "studio/document/document_files.h"
#include "studio/document/graph_text.h"
#include "studio/document/saved_places.h"
#include "studio/document/sharing.h"
#include "studio/session/notation_help.h"
#include "studio/session/request_text.h"
#include "studio/session/session.h"
#include "studio/session/session_viewer.h"

#include <climits>
#include <fmt/format.h>

#include <algorithm>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

template <class Kind>
Json parts() {
    Json list = Json::array();
    for (const auto& [name, part] : registered<Kind>()) {
        list.push_back({{"name", name}, {"summary", part->summary}, {"help", part->help}});
    }
    return list;
}

Json symbols() {
    Json list = Json::array();
    for (const auto& [name, symbol] : registered<Symbol>()) {
        list.push_back({{"name", name}, {"summary", symbol->help}, {"help", ""}});
    }
    return list;
}

Json names(const std::vector<std::string>& all) {
    Json list = Json::array();
    for (const std::string& name : all) list.push_back({{"name", name}, {"summary", ""}, {"help", ""}});
    return list;
}

bool has_number(const Json& request, const char* key) {
    return request.contains(key) && request[key].is_number();
}

}  // namespace

Session::Request Session::request_named(const std::string& name) {
    static const std::map<std::string, Request> requests{
        {"hello", &Session::hello},       {"library", &Session::library},     {"help", &Session::help},
        {"open", &Session::open},         {"open-text", &Session::open_text}, {"change", &Session::change},
        {"undo", &Session::undo},         {"redo", &Session::redo},           {"grow", &Session::grow},
        {"stop", &Session::stop},         {"look", &Session::look},           {"frame", &Session::frame},
        {"column", &Session::column},     {"pick", &Session::pick},           {"field", &Session::field},
        {"graph", &Session::graph},       {"save", &Session::save},           {"export", &Session::export_run},
        {"new-file", &Session::new_file}, {"limbs", &Session::limbs},         {"dismiss", &Session::dismiss},
        {"share", &Session::share},       {"read-link", &Session::read_link}, {"settle", &Session::settle},
    };
    const auto found = requests.find(name);
    if (found == requests.end()) throw UserError(fmt::format("there is no request '{}'", name));
    return found->second;
}

Json Session::hello(Viewer&, const Json&) {
    return {{"version", ESPALIER_VERSION}, {"opened", document_.now().opened.path.string()}};
}

Json Session::library(Viewer&, const Json&) {
    Json shipped = Json::array(), files = Json::array();
    for (const LibraryEntry& entry : options_.library()) {
        (entry.is_own ? files : shipped)
            .push_back({{"path", entry.path.string()},
                        {"shelf", entry.shelf},
                        {"name", entry.name},
                        {"summary", entry.summary},
                        {"picture", entry.picture.empty() ? Json() : Json(files_.number(entry.picture))}});
    }
    return {{"library", shipped}, {"files", files}};
}

Json Session::help(Viewer&, const Json&) {
    return {{"symbols", symbols()},
            {"functions", names(language::function_names())},
            {"processes", parts<ProcessType>()},
            {"stages", parts<GeometryStageType>()},
            {"recorders", parts<RecorderType>()},
            {"notations", parts<NotationType>()},
            {"components", component_types_json()},
            {"view", view_settings_json()},
            {"words", words_json()},
            {"exporters", parts<ExporterType>()},
            {"keys",
             Json::array({{{"name", "scene"}, {"summary", "the tables of a scene file"}, {"help", scene_help()}}})}};
}

Json Session::open(Viewer&, const Json& request) {
    const fs::path path = fs::absolute(request.at("path").get<std::string>()).lexically_normal();
    const std::vector<LibraryEntry> entries = options_.library();
    const bool is_offered =
        std::any_of(entries.begin(), entries.end(), [&](const LibraryEntry& entry) { return entry.path == path; });
    if (!is_offered) below_folder(path);
    if (!fs::exists(path)) throw UserError(fmt::format("{} does not exist", path.string()));
    apply({{path, {}, {}}, {}}, fmt::format("open {}", path.filename().string()), false);
    return {{"version", document_.version()}};
}

// What `open-text` would write, and where.
Json Session::read_link(Viewer&, const Json& request) {
    const SharedDocument shared = read_shared(request, options_.library_folder);
    Json files = Json::array();
    for (const auto& [path, bytes] : shared.files) {
        const auto known = shared.of_library.find(path);
        const Json library = known == shared.of_library.end() ? Json() : Json(known->second.generic_string());
        files.push_back({{"path", path.generic_string()}, {"bytes", bytes.size()}, {"library", library}});
    }
    return {{"folder", place_of_shared(shared, options_.folder).string()}, {"files", files}};
}

// Texts of another user's become files of a folder of their own.
Json Session::open_text(Viewer&, const Json& request) {
    Opened opened;
    if (has_number(request, "steps")) opened.steps = whole(request, "steps", 0, most_steps);
    if (has_number(request, "seed")) opened.seed = whole<std::uint64_t>(request, "seed");
    const fs::path path = opened.path = write_shared(read_shared(request, options_.library_folder), options_.folder);
    apply({opened, {}}, fmt::format("open {}", path.filename().string()), false);
    return {{"version", document_.version()}, {"path", path.string()}};
}

Json Session::share(Viewer&, const Json&) {
    const DocumentState& state = edited();
    if (fs::is_directory(state.opened.path)) throw UserError("a link holds a model or a scene, not a folder of files");
    Json shared = shared_files(state.opened.path, contents(state), options_.library_folder);
    shared.update(
        {{"seed", state.opened.seed.value_or(own_seed_)}, {"steps", state.opened.steps.value_or(own_steps_)}});
    return shared;
}

Json Session::change(Viewer&, const Json& request) {
    DocumentState state = edited();
    const std::set<fs::path> known = texts();
    if (request.contains("texts")) {
        for (const auto& [path, text] : request["texts"].items()) {
            if (!known.contains(path)) throw UserError(fmt::format("{} is not a text of this document", path));
            if (text.get_ref<const std::string&>().size() > most_text) throw UserError("the text is too long");
            state.unsaved[path] = bytes_of(path, text.get<std::string>());
        }
    }
    if (request.contains("settings")) set_numbers(request["settings"], state);
    if (request.contains("seed")) {
        state.opened.seed =
            request["seed"].is_null() ? std::nullopt : std::optional(whole<std::uint64_t>(request, "seed"));
    }
    if (request.contains("steps")) {
        state.opened.steps =
            request["steps"].is_null() ? std::nullopt : std::optional(whole(request, "steps", 0, most_steps));
    }
    apply(std::move(state), request.value("label", "change"), request.value("transient", false));
    return {{"version", document_.version()}};
}

Json Session::graph(Viewer&, const Json& request) {
    const fs::path file = request.at("path").get<std::string>();
    if (!texts().contains(file)) throw UserError(fmt::format("{} is not a text of this document", file.string()));
    DocumentState state = edited();
    state.unsaved[file] = edited_graph(file, text_of(file, state), request);
    apply(std::move(state), request.value("label", "graph"), request.value("transient", false));
    return {{"version", document_.version()}};
}

Json Session::undo(Viewer&, const Json&) {
    const fs::path before = document_.now().opened.path;
    if (document_.undo()) document_changed(before);
    return {{"version", document_.version()}};
}

Json Session::redo(Viewer&, const Json&) {
    const fs::path before = document_.now().opened.path;
    if (document_.redo()) document_changed(before);
    return {{"version", document_.version()}};
}

Json Session::grow(Viewer&, const Json& request) {
    if (!growth_) throw UserError("nothing grows");
    const int to = whole(request, "to", 0, most_steps);
    DocumentState state = edited();
    state.opened.steps = to;
    const int known = newest_.step;
    const std::string label = fmt::format("grow to step {}", to);
    const bool is_present = !next_ && !waits_ && growth_->version() == document_.version();
    if (is_present && to > known && growth_->extend(to, document_.version() + 1)) {
        document_.change(std::move(state), label, false);
        unkept_ = true;
        newest_.last_step = to;
        state_ = "growing";
        is_busy_ = true;
        broadcast(document_json());
        broadcast(growth_json());
        follow_from_ = known + 1;
    } else {
        const fs::path before = document_.now().opened.path;
        document_.change(std::move(state), label, false);
        document_changed(before, known + 1);
    }
    return {{"version", document_.version()}};
}

Json Session::stop(Viewer&, const Json&) {
    if (growth_) growth_->stop();
    if (next_) next_->stop();
    return Json::object();
}

Json Session::look(Viewer& viewer, const Json& request) {
    viewer.step = request.at("step").is_number() ? std::optional(whole<int>(request, "step")) : std::nullopt;
    const bool is_held = growth_ && request.value("held", Json()) == Json(growth_->number());
    if (!is_held) show(viewer);
    return {{"step", newest_.step}};
}

PlantSource& Session::grown_by(const Json& request) const {
    if (!growth_ || growth_->number() != whole<std::uint32_t>(request, "growth")) {
        throw UserError("this growth is gone; another has begun");
    }
    return *growth_;
}

Json Session::frame(Viewer& viewer, const Json& request) {
    const PlantSource& growth = grown_by(request);
    const int step = whole<int>(request, "step");
    if (!growth.has(step)) throw UserError(fmt::format("step {} has not been grown", step));
    send_when_drawn(viewer, step);
    return {{"step", step}};
}

Json Session::column(Viewer& viewer, const Json& request) {
    viewer.page.send_bytes(
        grown_by(request).column(whole<int>(request, "step"), request.at("name").get<std::string>()));
    return Json::object();
}

Json Session::pick(Viewer&, const Json& request) {
    return grown_by(request).module_info(whole<int>(request, "step"), whole<std::uint32_t>(request, "module"));
}

Json Session::field(Viewer& viewer, const Json& request) {
    viewer.page.send_bytes(grown_by(request).field(whole<int>(request, "step"), request.at("name").get<std::string>()));
    return Json::object();
}

// A side file beside the document, which its texts may then name.
Json Session::new_file(Viewer&, const Json& request) {
    if (!document_.is_open()) throw UserError("nothing is open");
    const fs::path main = document_.now().opened.path,
                   name = fs::path(request.at("name").get<std::string>()).filename();
    const fs::path path = writable((fs::is_directory(main) ? main : main.parent_path()) / name);
    const std::string& content = request.at("content").get_ref<const std::string&>();
    if (content.size() > most_text) throw UserError("the text is too long");
    if (fs::exists(path)) throw UserError(fmt::format("{} is there already", path.string()));
    write_text(path, bytes_of(path, content));
    begin_growth();
    return {{"path", path.string()}};
}

Json Session::save(Viewer&, const Json& request) {
    if (!document_.is_open()) throw UserError("nothing is open");
    std::vector<fs::path> written;
    if (request.contains("path")) {
        written = save_as(writable(options_.folder / request["path"].get<std::string>()));
    } else {
        written = save_changes();
        broadcast(document_json());
    }
    Json files = Json::array();
    for (const fs::path& file : written) files.push_back(file.string());
    return {{"version", document_.version()}, {"path", document_.now().opened.path.string()}, {"files", files}};
}

std::vector<fs::path> Session::save_changes() {
    const UnsavedTexts unsaved = document_.now().unsaved;
    std::vector<fs::path> written;
    for (const auto& [file, text] : unsaved) {
        if (text_on_disk(file) != text) written.push_back(writable(file));
    }
    look_at_disk();
    for (const fs::path& file : written) {
        if (!disputed_.contains(file)) continue;
        throw UserError(
            fmt::format("another program has written {}: say first which text is to stay", file.filename().string()));
    }
    for (const fs::path& file : written) {
        if (const std::optional<std::string> before = text_on_disk(file)) document_.keep_text(file, *before);
        write_text(file, unsaved.at(file));
        watch_.know(file, digest(unsaved.at(file)));
    }
    return written;
}

// With the files that it reads, at the same places beside it.
std::vector<fs::path> Session::save_as(const fs::path& path) {
    const DocumentState now = edited();
    const fs::path main = now.opened.path;
    if (kind_of(main) == "object") throw UserError("save the folder of an object under its own name");
    const std::map<fs::path, std::string> files = contents(now);
    const std::map<fs::path, fs::path> places = saved_places(main, files, path, options_.folder);
    if (!places.contains(main)) throw UserError(fmt::format("{} is there already", path.string()));
    std::vector<fs::path> written;
    for (const auto& [file, place] : places) {
        const std::optional<std::string> there = text_on_disk(writable(place));
        if (fs::exists(place) && (file == main || there != files.at(file))) {
            throw UserError(fmt::format("{} is there already{}", place.string(),
                                        file == main ? "" : ", and is another file: save into another folder"));
        }
        if (!there) written.push_back(file);
    }
    for (fs::path& file : written) {
        const fs::path place = places.at(file);
        fs::create_directories(place.parent_path());
        write_text(place, files.at(file));
        file = place;
    }
    DocumentState saved{now.opened, {}};
    saved.opened.path = places.at(main);
    for (const auto& [file, text] : now.unsaved) {
        if (!places.contains(file)) saved.unsaved[file] = text;
    }
    apply(std::move(saved), fmt::format("save as {}", path.filename().string()), false);
    return written;
}

Json Session::export_run(Viewer&, const Json& request) {
    if (!document_.is_open()) throw UserError("nothing is open");
    if (export_ && !export_->has_ended()) throw UserError("another export is going on");
    const fs::path scratch = options_.scratch / fmt::format("export-{}", ++exports_);
    ExportOrder order;
    order.opened = document_.now().opened;
    order.unsaved = document_.now().unsaved;
    order.format = request.at("format").get<std::string>();
    if (!registered<ExporterType>().contains(order.format)) throw UserError("there is no such format");
    if (has_number(request, "step")) order.step = whole<int>(request, "step");
    order.is_film = request.value("film", false);
    order.is_smooth = request.value("smooth", false);
    order.has_instances = request.value("instances", false);
    if (has_number(request, "triangles")) order.triangles = whole(request, "triangles", 1, INT_MAX);
    if (order.is_smooth && order.triangles) throw UserError("a smooth skin has as many triangles as it needs");
    order.scratch = scratch;
    order.read = options_.read;
    order.permission = permission_of(order.opened.path, options_.library_folder);
    const auto progressed = [this](double share) {
        post_([this, share] { broadcast({{"say", "progress"}, {"what", "export"}, {"done", share}}); });
    };
    const auto done = [this, scratch](std::vector<fs::path> files, std::string why) {
        post_([this, scratch, files = std::move(files), why = std::move(why)] {
            note_exported(files, export_folder(scratch), why);
        });
    };
    export_ = std::make_unique<ExportRun>(std::move(order), progressed, done);
    return Json::object();
}

void Session::note_exported(const std::vector<fs::path>& files, const fs::path& folder, const std::string& why) {
    Json list = Json::array();
    for (const fs::path& file : files) {
        list.push_back({{"number", files_.number(file)},
                        {"name", file.lexically_relative(folder).generic_string()},
                        {"bytes", static_cast<std::uint64_t>(fs::file_size(file))}});
    }
    broadcast({{"say", "exported"}, {"files", list}});
    if (!why.empty()) notify("error", why);
}

Json Session::dismiss(Viewer&, const Json& request) {
    messages_.erase(whole<std::uint32_t>(request, "message"));
    return Json::object();
}

}  // namespace espalier::studio
