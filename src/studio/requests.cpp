// The requests of docs/studio-protocol.md, and what pages are told of the document.
#include "espalier/base/file.h"
#include "espalier/environment/environment_process.h"
#include "espalier/formats/exporter.h"
#include "espalier/geometry/geometry_stage.h"
#include "espalier/language/notation.h"
#include "espalier/timeline/recorder.h"
#include "espalier/turtle/symbol.h"

#include "base/base64.h"
#include "base/text.h"
#include "language/parser/functions.h"
#include "studio/field_bytes.h"
#include "studio/graph_text.h"
#include "studio/inquiry.h"
#include "studio/session.h"
#include "studio/session_viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <tuple>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_text = std::size_t(1) << 20;
constexpr int most_steps = 100000000;

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

bool is_text(std::string_view bytes) {
    return bytes.size() <= most_text && bytes.find('\0') == std::string_view::npos &&
           Json(bytes).dump(-1, ' ', false, Json::error_handler_t::ignore) ==
               Json(bytes).dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool is_map(const fs::path& file) {
    return file.extension() == ".map";
}

/// The bytes of a file that a page may edit, from what it sends.
std::string bytes_of(const fs::path& file, const std::string& content) {
    std::vector<char> bytes;
    if (!is_map(file)) return content;
    if (!decode_base64(content, bytes)) throw UserError(fmt::format("{} is not in base64", file.string()));
    return {bytes.begin(), bytes.end()};
}

std::string language_of(const fs::path& file) {
    if (is_map(file)) return "map";
    if (const NotationType* notation = notation_of(file)) return notation->name;
    const std::string extension = file.extension().string();
    return extension == ".l" || extension == ".h" ? "cpfg" : extension == ".toml" ? "toml" : "plain";
}

std::string role_of(const fs::path& file, const fs::path& main) {
    const std::string extension = file.extension().string();
    if (file == main) return "main";
    if (extension == ".l" || notation_of(file)) return "model";
    return extension == ".v" ? "view" : "side";
}

std::string kind_of(const fs::path& path) {
    return path.extension() == ".toml" ? "scene" : fs::is_directory(path) ? "object" : "model";
}

std::optional<std::string> text_on_disk(const fs::path& file) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return std::nullopt;
    return read_text(file);
}

// A number or a switch as a page may write it.
void require_value(const WrittenNumber& number, const std::string& text) {
    if (number.is_switch) {
        if (text != "true" && text != "false") throw UserError(fmt::format("{} is true or false", number.name));
        return;
    }
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size() || !std::isfinite(value)) {
        throw UserError(fmt::format("{}: '{}' is not a number", number.name, text));
    }
    if (value < number.lowest || value > number.highest) {
        throw UserError(fmt::format("{} lies between {} and {}", number.name, format_general(number.lowest),
                                    format_general(number.highest)));
    }
}

Json optional_json(const std::optional<std::string>& text) {
    return text ? Json(*text) : Json();
}

// "crown width: of the ellipsoid of points" for CROWN_WIDTH; a summary that repeats the name is enough.
std::string label_of(const WrittenNumber& number) {
    const std::string last = number.name.substr(number.name.rfind('.') + 1);
    std::string words;
    for (const char c : last) words += c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool has_summary = number.label != last && number.label != number.name;
    if (!has_summary) return last;
    return number.label.starts_with(words) ? number.label : words + ": " + number.label;
}

Json bound(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

}  // namespace

Session::Request Session::request_named(const std::string& name) {
    static const std::map<std::string, Request> requests{
        {"hello", &Session::hello},     {"library", &Session::library},     {"help", &Session::help},
        {"open", &Session::open},       {"open-text", &Session::open_text}, {"change", &Session::change},
        {"undo", &Session::undo},       {"redo", &Session::redo},           {"grow", &Session::grow},
        {"stop", &Session::stop},       {"look", &Session::look},           {"frame", &Session::frame},
        {"column", &Session::column},   {"pick", &Session::pick},           {"field", &Session::field},
        {"graph", &Session::graph},     {"save", &Session::save},           {"export", &Session::export_run},
        {"dismiss", &Session::dismiss},
    };
    const auto found = requests.find(name);
    if (found == requests.end()) throw UserError(fmt::format("there is no request '{}'", name));
    return found->second;
}

Json Session::hello(Viewer&, const Json&) {
    return {{"version", ESPALIER_VERSION}, {"folder", options_.folder.string()}};
}

Json Session::library(Viewer&, const Json&) {
    Json models = Json::array(), scenes = Json::array(), files = Json::array();
    for (const LibraryEntry& entry : options_.library()) {
        Json json = {{"path", entry.path.string()},
                     {"folder", entry.path.parent_path().filename().string()},
                     {"name", entry.name},
                     {"summary", entry.summary},
                     {"picture", entry.picture.empty() ? Json() : Json(files_.number(entry.picture))}};
        if (entry.is_own) {
            files.push_back(std::move(json));
        } else {
            (entry.is_scene ? scenes : models).push_back(std::move(json));
        }
    }
    return {{"models", models}, {"scenes", scenes}, {"files", files}};
}

Json Session::help(Viewer&, const Json&) {
    return {{"symbols", symbols()},
            {"functions", names(language::function_names())},
            {"processes", parts<ProcessType>()},
            {"stages", parts<GeometryStageType>()},
            {"recorders", parts<RecorderType>()},
            {"notations", parts<NotationType>()},
            {"components", component_types_json()},
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

// A text of somebody else's becomes an unsaved file of the opened folder.
Json Session::open_text(Viewer&, const Json& request) {
    const fs::path name = fs::path(request.at("name").get<std::string>()).filename();
    const std::string content = request.at("content").get<std::string>();
    if (name.empty() || content.size() > most_text) throw UserError("the link holds no model");
    fs::path path = below_folder(options_.folder / name);
    for (int number = 2; fs::exists(path); ++number) {
        path = options_.folder / fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string());
    }
    write_text(path, content);
    Opened opened{path, {}, {}};
    if (request.contains("steps") && request["steps"].is_number()) opened.steps = request["steps"].get<int>();
    if (request.contains("seed") && request["seed"].is_number()) opened.seed = request["seed"].get<std::uint64_t>();
    apply({opened, {}}, fmt::format("open {}", path.filename().string()), false);
    return {{"version", document_.version()}, {"path", path.string()}};
}

Json Session::change(Viewer&, const Json& request) {
    if (!document_.is_open()) throw UserError("nothing is open");
    DocumentState state = document_.now();
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
            request["seed"].is_null() ? std::nullopt : std::optional(request["seed"].get<std::uint64_t>());
    }
    if (request.contains("steps")) {
        state.opened.steps = request["steps"].is_null()
                                 ? std::nullopt
                                 : std::optional(std::clamp(request["steps"].get<int>(), 0, most_steps));
    }
    apply(std::move(state), request.value("label", "change"), request.value("transient", false));
    return {{"version", document_.version()}};
}

Json Session::graph(Viewer&, const Json& request) {
    const fs::path file = request.at("path").get<std::string>();
    if (!texts().contains(file)) throw UserError(fmt::format("{} is not a text of this document", file.string()));
    DocumentState state = document_.now();
    state.unsaved[file] = edited_graph(file, text_of(file, state), request);
    apply(std::move(state), request.value("label", "graph"), request.value("transient", false));
    return {{"version", document_.version()}};
}

Json Session::undo(Viewer&, const Json&) {
    const fs::path before = document_.now().opened.path;
    if (document_.undo()) document_changed(before != document_.now().opened.path);
    return {{"version", document_.version()}};
}

Json Session::redo(Viewer&, const Json&) {
    const fs::path before = document_.now().opened.path;
    if (document_.redo()) document_changed(before != document_.now().opened.path);
    return {{"version", document_.version()}};
}

Json Session::grow(Viewer&, const Json& request) {
    if (!growth_) throw UserError("nothing grows");
    const int to = std::clamp(request.at("to").get<int>(), 0, most_steps);
    DocumentState state = document_.now();
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
        tell(document_json());
        tell(growth_json());
    } else {
        apply(std::move(state), label, false);
    }
    follow_from_ = known + 1;
    return {{"version", document_.version()}};
}

Json Session::stop(Viewer&, const Json&) {
    if (growth_) growth_->stop();
    return Json::object();
}

Json Session::look(Viewer& viewer, const Json& request) {
    viewer.step = request.at("step").is_number() ? std::optional(request["step"].get<int>()) : std::nullopt;
    const bool is_held = growth_ && request.value("held", Json()) == Json(growth_->number());
    if (!is_held) show(viewer);
    return {{"step", newest_.step}};
}

Growth& Session::grown_by(const Json& request) const {
    if (!growth_ || growth_->number() != request.at("growth").get<std::uint32_t>()) {
        throw UserError("this growth is gone; another has begun");
    }
    return *growth_;
}

Json Session::frame(Viewer& viewer, const Json& request) {
    const Growth& growth = grown_by(request);
    const int step = request.at("step").get<int>();
    if (!growth.steps().has(step)) throw UserError(fmt::format("step {} has not been grown", step));
    send_packet(viewer, step);
    return {{"step", step}};
}

Json Session::column(Viewer& viewer, const Json& request) {
    const Growth& growth = grown_by(request);
    viewer.page.send_bytes(studio::column(*growth.scene(), growth.steps(), growth.number(),
                                          request.at("step").get<int>(), request.at("name").get<std::string>()));
    return Json::object();
}

Json Session::pick(Viewer&, const Json& request) {
    const Growth& growth = grown_by(request);
    return what_is_known(*growth.scene(), growth.steps(), request.at("step").get<int>(),
                         request.at("module").get<std::uint32_t>());
}

// The field is read on the growth's thread, where it does not change meanwhile.
Json Session::field(Viewer& viewer, const Json& request) {
    Growth& growth = grown_by(request);
    const std::string name = request.at("name").get<std::string>();
    Page* page = &viewer.page;
    growth.ask([this, page, name, number = growth.number()](const World& world) {
        const Field* found = world.environment().fields().find(name);
        if (!found) return;
        post_([this, page, bytes = field_bytes(*found, number, world.steps_done())] {
            for (const auto& known : viewers_) {
                if (&known->page == page) page->send_bytes(bytes);
            }
        });
    });
    return Json::object();
}

Json Session::save(Viewer&, const Json& request) {
    if (!document_.is_open()) throw UserError("nothing is open");
    if (request.contains("path")) {
        save_as(below_folder(options_.folder / request["path"].get<std::string>()));
    } else {
        for (const auto& [file, text] : document_.now().unsaved) {
            if (text_on_disk(file) != text) write_text(below_folder(file), text);
        }
    }
    tell(document_json());
    return {{"path", document_.now().opened.path.string()}};
}

// With the files below its folder that it reads, at the same places beside it.
void Session::save_as(const fs::path& path) {
    const DocumentState now = document_.now();
    const fs::path main = now.opened.path, folder = main.parent_path();
    if (kind_of(main) == "object") throw UserError("save the folder of an object under its own name");
    if (fs::exists(path)) throw UserError(fmt::format("{} is there already", path.string()));
    for (const auto& [file, read] : read_) {
        const fs::path beside = file.lexically_relative(folder);
        if (file == main || folder == path.parent_path()) continue;
        if (beside.empty() || *beside.begin() == "..") {
            throw UserError(
                fmt::format("it reads {}, which is not below {}: save it there", file.string(), folder.string()));
        }
        const fs::path copy = below_folder(path.parent_path() / beside);
        if (fs::exists(copy)) continue;
        fs::create_directories(copy.parent_path());
        write_text(copy, text_of(file, now));
    }
    fs::create_directories(path.parent_path());
    write_text(path, text_of(main, now));
    Opened opened = now.opened;
    opened.path = path;
    apply({opened, {}}, fmt::format("save as {}", path.filename().string()), false);
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
    if (request.contains("step") && request["step"].is_number()) order.step = request["step"].get<int>();
    order.is_film = request.value("film", false);
    order.scratch = scratch;
    order.read = options_.read;
    const auto progressed = [this](double share) {
        post_([this, share] { tell({{"say", "progress"}, {"what", "export"}, {"done", share}}); });
    };
    const auto done = [this](std::vector<fs::path> files, std::string why) {
        post_([this, files = std::move(files), why = std::move(why)] { note_exported(files, why); });
    };
    export_ = std::make_unique<ExportRun>(std::move(order), progressed, done);
    return Json::object();
}

void Session::note_exported(const std::vector<fs::path>& files, const std::string& why) {
    Json list = Json::array();
    for (const fs::path& file : files) {
        list.push_back({{"number", files_.number(file)},
                        {"name", file.filename().string()},
                        {"bytes", static_cast<std::uint64_t>(fs::file_size(file))}});
    }
    tell({{"say", "exported"}, {"files", list}});
    if (!why.empty()) say("error", why);
}

Json Session::dismiss(Viewer&, const Json& request) {
    messages_.erase(request.at("message").get<std::uint32_t>());
    return Json::object();
}

// --- texts and numbers

fs::path Session::below_folder(const fs::path& path) const {
    const fs::path whole = fs::weakly_canonical(path), folder = fs::weakly_canonical(options_.folder);
    const fs::path below = whole.lexically_relative(folder);
    if (below.empty() || *below.begin() == "..") {
        throw UserError(fmt::format("{} is not below {}: the studio writes nowhere else. Save it under another name",
                                    path.string(), folder.string()));
    }
    return path.lexically_normal();
}

std::set<fs::path> Session::texts() const {
    std::set<fs::path> texts;
    for (const auto& [path, file] : read_) {
        if (file.kept && (is_map(path) || is_text(file.bytes))) texts.insert(path);
    }
    for (const auto& [path, text] : document_.now().unsaved) texts.insert(path);
    if (document_.is_open() && !fs::is_directory(document_.now().opened.path)) {
        texts.insert(document_.now().opened.path);
    }
    return texts;
}

std::map<std::string, std::pair<fs::path, WrittenNumber>> Session::numbers(const DocumentState& state) const {
    std::map<std::string, std::pair<fs::path, WrittenNumber>> all;
    for (const fs::path& file : texts()) {
        const std::string role = role_of(file, state.opened.path);
        if (role != "main" && role != "model") continue;
        for (WrittenNumber& number : written_numbers(file, text_of(file, state))) {
            std::string name = role == "main" ? number.name : file.filename().string() + ":" + number.name;
            all.try_emplace(std::move(name), file, std::move(number));
        }
    }
    return all;
}

void Session::set_numbers(const Json& values, DocumentState& state) const {
    for (const auto& [name, value] : values.items()) {
        const auto known = numbers(state);
        const auto found = known.find(name);
        if (found == known.end()) throw UserError(fmt::format("there is no setting '{}'", name));
        const auto& [file, number] = found->second;
        std::string text = value.is_null() ? default_of(name, file) : value.get<std::string>();
        require_value(number, text);
        state.unsaved[file] = with_number(text_of(file, state), number, text);
    }
}

// As the file on disk has it.
std::string Session::default_of(const std::string& name, const fs::path& file) const {
    const std::string own = name.substr(name.find(':') + 1);
    for (const WrittenNumber& number : written_numbers(file, text_on_disk(file).value_or(""))) {
        if (number.name == own) return number.text;
    }
    throw UserError(fmt::format("the file on disk has no setting '{}'", name));
}

Json Session::document_json() const {
    const Opened& opened = document_.now().opened;
    Json json = {{"say", "document"},
                 {"version", document_.version()},
                 {"path", opened.path.string()},
                 {"name", opened.path.filename().string()},
                 {"folder", options_.folder.string()},
                 {"undo", optional_json(document_.undo_label())},
                 {"redo", optional_json(document_.redo_label())}};
    if (!document_.is_open()) return json;
    json["kind"] = kind_of(opened.path);
    json["texts"] = texts_json();
    json["settings"] = settings_json();
    json["graphs"] = graphs_json();
    json["seed"] = opened.seed.value_or(own_seed_);
    json["steps"] = opened.steps.value_or(own_steps_);
    return json;
}

Json Session::graphs_json() const {
    Json graphs = Json::array();
    for (const fs::path& file : texts()) {
        if (language_of(file) != "pgraph") continue;
        Json graph = graph_json(file, text_of(file, document_.now()));
        if (!graph.is_null()) graphs.push_back(std::move(graph));
    }
    return graphs;
}

Json Session::texts_json() const {
    const DocumentState& now = document_.now();
    Json list = Json::array();
    for (const fs::path& file : texts()) {
        Json text = {{"path", file.string()},
                     {"role", role_of(file, now.opened.path)},
                     {"language", language_of(file)},
                     {"content", is_map(file) ? base64(text_of(file, now)) : text_of(file, now)},
                     {"changed", now.unsaved.contains(file) && text_on_disk(file) != now.unsaved.at(file)}};
        const bool is_main = text["role"] == "main";
        list.insert(is_main ? list.begin() : list.end(), std::move(text));
    }
    return list;
}

Json Session::settings_json() const {
    struct Row {
        std::string name;
        const fs::path* file;
        const WrittenNumber* number;
    };
    const auto all = numbers(document_.now());
    std::vector<Row> rows;
    for (const auto& [name, found] : all) rows.push_back({name, &found.first, &found.second});
    const fs::path& main = document_.now().opened.path;
    std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
        return std::tuple(*a.file != main, *a.file, a.number->offset) <
               std::tuple(*b.file != main, *b.file, b.number->offset);
    });
    Json list = Json::array();
    std::map<fs::path, std::vector<WrittenNumber>> on_disk;
    for (const Row& row : rows) {
        const WrittenNumber& number = *row.number;
        const auto [place, is_new] = on_disk.try_emplace(*row.file);
        if (is_new) place->second = written_numbers(*row.file, text_on_disk(*row.file).value_or(""));
        const auto saved = std::find_if(place->second.begin(), place->second.end(),
                                        [&](const WrittenNumber& other) { return other.name == number.name; });
        const std::string fallback = saved == place->second.end() ? number.text : saved->text;
        const std::string group = *row.file == main      ? number.group
                                  : number.group.empty() ? row.file->filename().string()
                                                         : row.file->filename().string() + ", " + number.group;
        list.push_back({{"name", row.name},
                        {"label", label_of(number)},
                        {"kind", number.is_switch ? "switch" : "number"},
                        {"value", number.value},
                        {"text", number.text},
                        {"default", fallback},
                        {"lowest", bound(number.lowest)},
                        {"highest", bound(number.highest)},
                        {"whole", number.whole},
                        {"unit", number.unit},
                        {"group", group},
                        {"changed", number.text != fallback}});
    }
    return list;
}

}  // namespace espalier::studio
