// What pages are told of the document, and the numbers that they may change in its texts.
#include "espalier/base/file.h"
#include "espalier/base/read_log.h"

#include "base/folder.h"
#include "base/number.h"
#include "base/text.h"
#include "studio/document/document_files.h"
#include "studio/document/graph_text.h"
#include "studio/document/plain_name.h"
#include "studio/document/sharing.h"
#include "studio/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A number or a switch as a page may write it.
void require_value(const WrittenNumber& number, const std::string& text) {
    if (number.is_switch) {
        if (text != "true" && text != "false") throw UserError(fmt::format("{} is true or false", number.name));
        return;
    }
    const std::optional<double> value = finite_number(text);
    if (!value) throw UserError(fmt::format("{}: '{}' is not a number", number.name, text));
    if (*value < number.lowest || *value > number.highest) {
        throw UserError(fmt::format("{} lies between {} and {}", number.name, format_general(number.lowest),
                                    format_general(number.highest)));
    }
}

Json optional_json(const std::optional<std::string>& text) {
    return text ? Json(*text) : Json();
}

// "leaves: mean number of leaves on an internode" for LEAVES; a summary that repeats the name is enough.
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

fs::path Session::below_folder(const fs::path& path) const {
    if (path.native().find('\0') != std::string::npos) throw UserError("the path holds a zero byte");
    std::error_code unknown;
    if (resolved_below(path, options_.folder, unknown).empty()) {
        throw UserError(fmt::format("{} is not below {}: the studio writes nowhere else. Save it under another name",
                                    path.string(), options_.folder.string()));
    }
    return path.lexically_normal();
}

fs::path Session::writable(const fs::path& path) const {
    const fs::path place = below_folder(path);
    require_plain_name(place.lexically_relative(options_.folder));
    return place;
}

std::map<fs::path, std::string> Session::contents(const DocumentState& state) const {
    std::map<fs::path, std::string> files;
    for (const auto& [file, read] : read_) files[file] = text_of(file, state);
    for (const auto& [file, text] : state.unsaved) files[file] = text;
    files.try_emplace(state.opened.path, text_of(state.opened.path, state));
    return files;
}

std::set<fs::path> Session::texts() const {
    std::set<fs::path> texts;
    for (const auto& [path, file] : read_) {
        if (file.kept && !is_mesh(path) && (is_palette(path) || is_text(file.bytes))) texts.insert(path);
    }
    const DocumentState& now = edited();
    for (const auto& [path, text] : now.unsaved) texts.insert(path);
    if (!fs::is_directory(now.opened.path)) texts.insert(now.opened.path);
    return texts;
}

std::map<std::string, std::pair<fs::path, WrittenNumber>> Session::numbers(const DocumentState& state) const {
    std::map<std::string, std::pair<fs::path, WrittenNumber>> all;
    // Their words are read from other files too.
    const ReadLog reads(0, state.unsaved, permission_of(state.opened.path, options_.library_folder));
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
    if (json["kind"] == "run" && !recorded_from_) {
        json.update({{"texts", Json::array()}, {"settings", Json::array()}, {"graphs", Json::array()}});
        json.update({{"seed", own_seed_}, {"steps", own_steps_}});
        return json;
    }
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
        Json graph = graph_json(file, text_of(file, edited()));
        if (!graph.is_null()) graphs.push_back(std::move(graph));
    }
    return graphs;
}

Json Session::texts_json() const {
    const DocumentState& now = edited();
    Json list = Json::array();
    for (const fs::path& file : texts()) {
        Json text = {{"path", file.string()},
                     {"role", role_of(file, now.opened.path)},
                     {"language", language_of(file)},
                     {"content", content_of(file, text_of(file, now))},
                     {"changed", now.unsaved.contains(file) && text_on_disk(file) != now.unsaved.at(file)},
                     {"disputed", disputed_.contains(file)}};
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
    const auto all = numbers(edited());
    std::vector<Row> rows;
    for (const auto& [name, found] : all) rows.push_back({name, &found.first, &found.second});
    const fs::path& main = edited().opened.path;
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
