#include "espalier/archive/recorded_run.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/field_reader.h"
#include "archive/geometry_file.h"
#include "archive/joined_pieces.h"
#include "archive/xml.h"
#include "base/csv_file.h"
#include "base/json_text.h"
#include "base/number.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::archive {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw UserError(fmt::format("{} is damaged: {}", file.string(), what));
}

double number(const fs::path& file, const std::string& text) {
    const std::optional<double> value = finite_number(text);
    if (!value) fail(file, fmt::format("'{}' is no number", text));
    return *value;
}

struct CollectionEntry {
    double time;
    std::string name;
    fs::path file;
};

std::vector<CollectionEntry> entries_of(const fs::path& path, const std::string& text) {
    std::vector<CollectionEntry> entries;
    const XmlElement root = parse_xml(text);
    const XmlElement* collection = root.child("Collection");
    if (!collection) fail(path, "it has no element 'Collection'");
    for (const XmlElement& entry : collection->children) {
        if (entry.name != "DataSet") continue;
        if (entry.attribute("file").empty()) fail(path, "a data set has no file");
        entries.push_back({number(path, entry.attribute("timestep")), entry.attribute("name"),
                           path.parent_path() / entry.attribute("file")});
    }
    return entries;
}

// The entries of a .pvd in their order; none if there is no such file. A run that is going puts new ones over the
// file's end: who reads just then finds the old end and the new one, and reads once more.
std::vector<CollectionEntry> read_collection(const fs::path& path) {
    if (!fs::exists(path)) return {};
    std::string text = read_text(path);
    for (;;) {
        try {
            return entries_of(path, text);
        } catch (const XmlError& error) {
            std::string again = read_text(path);
            if (again == text) fail(path, error.what());
            text = std::move(again);
        }
    }
}

// Plants and fields of a step are written one after the other: a run that goes on, or was killed, may have but one.
void drop_unfinished(std::vector<RecordedFrame>& frames) {
    const auto holds = [&](auto member) {
        return std::any_of(frames.begin(), frames.end(),
                           [&](const RecordedFrame& of) { return !(of.*member).empty(); });
    };
    const bool has_plants = holds(&RecordedFrame::plants), has_fields = holds(&RecordedFrame::fields);
    const auto is_whole = [&](const RecordedFrame& frame) {
        return (!has_plants || !frame.plants.empty()) && (!has_fields || !frame.fields.empty());
    };
    if (frames.size() > 1 && !is_whole(frames.back()) && is_whole(frames[frames.size() - 2])) frames.pop_back();
}

std::vector<RecordedFrame> read_frames(const fs::path& folder, double dt) {
    std::map<int, RecordedFrame> frames;
    const auto frame_at = [&](const fs::path& path, double time) -> RecordedFrame& {
        const double step = std::round(time / dt);
        if (step < 0 || step > std::numeric_limits<int>::max()) fail(path, fmt::format("time {} is no step's", time));
        RecordedFrame& frame = frames[static_cast<int>(step)];
        frame.step = static_cast<int>(step);
        frame.time = time;
        return frame;
    };
    const fs::path plants = folder / "plants.pvd", fields = folder / "fields.pvd";
    for (const CollectionEntry& entry : read_collection(plants)) {
        RecordedFrame& frame = frame_at(plants, entry.time);
        if (frame.plants.empty())
            frame.plants = entry.file;
        else
            frame.more_plants.push_back(entry.file);
    }
    for (const CollectionEntry& entry : read_collection(fields)) {
        frame_at(fields, entry.time).fields[entry.name] = entry.file;
    }
    std::vector<RecordedFrame> sorted;
    for (auto& [step, frame] : frames) sorted.push_back(std::move(frame));
    drop_unfinished(sorted);
    return sorted;
}

std::string read_record(const fs::path& folder) {
    const fs::path file = folder / "run.json";
    std::error_code error;
    if (!fs::exists(file, error)) {
        throw UserError(fmt::format("{} holds no run: there is no run.json in it", folder.string()));
    }
    return read_text(file);
}

Json parse_record(const fs::path& folder, const std::string& record) {
    Json run = read_json<Json>(record);
    if (!run.is_object() || !run.contains("exit")) {
        throw UserError(fmt::format("{} is not what a run writes", (folder / "run.json").string()));
    }
    return run;
}

std::string written_exit(const fs::path& folder) {
    const Json run = parse_record(folder, read_record(folder));
    if (!run["exit"].is_string()) {
        throw UserError(fmt::format("{} is not what a run writes", (folder / "run.json").string()));
    }
    return run["exit"].get<std::string>();
}

glm::dvec3 vector_of(const fs::path& file, const Json& json) {
    const auto numbers = json.get<std::array<double, 3>>();
    const glm::dvec3 vector(numbers[0], numbers[1], numbers[2]);
    if (!std::isfinite(vector.x + vector.y + vector.z)) fail(file, "a direction is not finite");
    return vector;
}

RecordedView view_of(const fs::path& file, const Json& json) {
    constexpr double most = 255;
    const glm::dvec3 none(0);
    RecordedView view;
    if (const glm::dvec3 eye = vector_of(file, json.at("towards_eye")); eye != none) view.towards_eye = eye;
    view.twist = json.at("twist").get<double>();
    view.perspective = json.at("perspective").get<bool>();
    view.angle = json.at("angle").get<double>();
    if (json.contains("towards_light")) {
        if (const glm::dvec3 light = vector_of(file, json["towards_light"]); light != none) view.towards_light = light;
    }
    if (json.contains("background")) {
        const glm::dvec3 colour = glm::clamp(vector_of(file, json["background"]), 0.0, 1.0) * most;
        view.background.emplace();
        for (int k = 0; k < 3; ++k) {
            (*view.background)[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(colour[k]));
        }
    }
    return view;
}

std::map<std::array<std::uint8_t, 3>, RecordedMaterial> materials_of(const fs::path& file, const Json& json) {
    std::map<std::array<std::uint8_t, 3>, RecordedMaterial> materials;
    for (const Json& material : json) {
        const glm::dvec3 emission = glm::clamp(vector_of(file, material.at("emission")), 0.0, 1.0);
        const double opacity = std::clamp(material.at("opacity").get<double>(), 0.0, 1.0);
        materials.emplace(material.at("rgb").get<std::array<std::uint8_t, 3>>(), RecordedMaterial{emission, opacity});
    }
    return materials;
}

double cell_value(const fs::path& file, const std::string& text) {
    if (text.empty() || text == "nan" || text == "-nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf" || text == "-inf") return std::numeric_limits<double>::infinity() * (text[0] == '-' ? -1 : 1);
    return number(file, text);
}

/// Returns the area of the scene's domain, or of that of the first process that has one.
std::optional<double> ground_area_of(const Json& run) {
    std::vector<Json> tables;
    if (run.contains("parameters")) tables.push_back(run["parameters"].value("simulation", Json::object()));
    if (run.contains("processes")) tables.insert(tables.end(), run["processes"].begin(), run["processes"].end());
    for (const Json& table : tables) {
        if (!table.contains("domain")) continue;
        const Json &lower = table["domain"].at("lower"), &upper = table["domain"].at("upper");
        const double area = (upper.at(0).get<double>() - lower.at(0).get<double>()) *
                            (upper.at(2).get<double>() - lower.at(2).get<double>());
        if (area > 0) return area;
    }
    return std::nullopt;
}

}  // namespace

fs::path folder_of_run(const fs::path& path) {
    constexpr std::array extensions{".json", ".pvd", ".vtp", ".vti", ".vdb", ".csv"};
    std::error_code error;
    const bool may_be_of_run = fs::is_regular_file(path, error) &&
                               std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
    if (!may_be_of_run) return path;
    constexpr int deepest = 3;  // RUN/fields/light/0012.vti
    fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    for (int depth = 0; depth < deepest; ++depth, folder = folder / "..") {
        if (fs::exists(folder / "run.json", error)) return folder.lexically_normal();
    }
    return path;
}

RecordedRun::RecordedRun(const fs::path& path) : folder_(folder_of_run(path)) {
    take(read_record(folder_));
    exit_ = exit_of_run(folder_);
    frames_ = read_frames(folder_, dt_);
}

RecordedRun::RecordedRun(const std::string& record, std::vector<RecordedFrame> frames) : frames_(std::move(frames)) {
    take(record);
}

void RecordedRun::take(const std::string& record) {
    const fs::path file = folder_ / "run.json";
    const Json run = parse_record(folder_, record);
    try {
        exit_ = run.at("exit").get<std::string>();
        scene_ = run.at("scene").at("name").get<std::string>();
        time_unit_ = run.at("time_unit").get<std::string>();
        dt_ = run.at("dt").get<double>();
        for (const Json& plant : run.at("plants")) {
            plants_.push_back({static_cast<std::uint32_t>(plants_.size()), plant.at("name").get<std::string>(),
                               plant.at("model").get<std::string>()});
        }
        if (run.contains("units")) units_ = run["units"].get<std::map<std::string, std::string>>();
        ground_area_ = ground_area_of(run);
        if (run.contains("origin")) {
            const auto origin = run["origin"].get<std::array<double, 3>>();
            origin_ = glm::dvec3(origin[0], origin[1], origin[2]);
        }
        if (run.contains("view")) view_ = view_of(file, run["view"]);
        if (run.contains("materials")) materials_ = materials_of(file, run["materials"]);
    } catch (const Json::exception& error) {
        throw UserError(fmt::format("{} is not what a run writes: {}", file.string(), error.what()));
    }
    if (!(dt_ > 0) || !std::isfinite(dt_)) fail(file, fmt::format("a step cannot last {}", dt_));
}

RecordedMaterial RecordedRun::material(const std::array<std::uint8_t, 3>& rgb) const {
    const auto found = materials_.find(rgb);
    return found == materials_.end() ? RecordedMaterial{} : found->second;
}

// Who is killed cannot say so, but holds no lock any more.
std::string exit_of_run(const fs::path& folder) {
    const std::string exit = written_exit(folder);
    if (exit != "running" || is_locked(folder)) return exit;
    const std::string again = written_exit(folder);  // it may have ended just then
    return again == "running" ? "killed" : again;
}

std::uint32_t RecordedRun::plant(const std::string& name) const {
    std::vector<std::string> names;
    for (const RecordedPlant& plant : plants_) {
        if (plant.name == name) return plant.number;
        names.push_back(plant.name);
    }
    constexpr std::size_t most_shown = 20;
    const std::size_t shown = std::min(names.size(), most_shown);
    throw UserError(fmt::format("{} has no plant '{}'{}; its plants are {}{}", folder_.string(), name,
                                did_you_mean(name, names), fmt::join(names.begin(), names.begin() + shown, ", "),
                                names.size() > shown ? ", ..." : ""));
}

const RecordedFrame& RecordedRun::frame(int step) const {
    const auto after = std::lower_bound(frames_.begin(), frames_.end(), step,
                                        [](const RecordedFrame& frame, int wanted) { return frame.step < wanted; });
    if (after != frames_.end() && after->step == step) return *after;
    if (frames_.empty()) throw UserError(fmt::format("{} has no frames", folder_.string()));
    std::string nearest;
    if (after != frames_.begin()) nearest += fmt::format(" {}", std::prev(after)->step);
    if (after != frames_.end()) nearest += fmt::format("{} {}", nearest.empty() ? "" : " and", after->step);
    throw UserError(fmt::format("{} has no frame of step {}; the nearest:{}", folder_.string(), step, nearest));
}

std::vector<std::string> RecordedRun::field_names() const {
    std::vector<std::string> names;
    if (frames_.empty()) return names;
    for (const auto& [name, file] : frames_.back().fields) names.push_back(name);
    return names;
}

std::vector<RecordedFrame> RecordedFrame::pieces() const {
    std::vector<RecordedFrame> pieces{*this};
    pieces.front().more_plants.clear();
    for (const fs::path& file : more_plants) {
        pieces.push_back(pieces.front());
        pieces.back().plants = file;
    }
    return pieces;
}

FrameGeometry RecordedRun::geometry(const RecordedFrame& frame) const {
    if (frame.geometry) return *frame.geometry;
    if (frame.plants.empty()) {
        throw UserError(fmt::format("{} holds no plants of step {}: its recorder 'skeleton' was off", folder_.string(),
                                    frame.step));
    }
    std::vector<FrameGeometry> pieces{read_geometry(frame.plants)};
    for (const fs::path& piece : frame.more_plants) pieces.push_back(read_geometry(piece));
    FrameGeometry geometry = joined(std::move(pieces));
    for (const FrameAttributes* attributes : {&geometry.of_points, &geometry.of_cells}) {
        for (const std::uint32_t plant : attributes->plants) {
            if (plant >= plants_.size()) fail(frame.plants, fmt::format("the run has no plant {}", plant));
        }
    }
    return geometry;
}

RecordedField RecordedRun::field(const RecordedFrame& frame, const std::string& name) const {
    const auto found = frame.fields.find(name);
    if (found != frame.fields.end()) return read_field(found->second, name);
    std::vector<std::string> names = field_names();
    throw UserError(fmt::format("{} has no field '{}' of step {}{}; recorded: {}", folder_.string(), name, frame.step,
                                did_you_mean(name, names),
                                names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

std::optional<RecordedBackground> RecordedRun::background() const {
    const fs::path file = folder_ / "background.vtp";
    std::error_code error;
    if (!fs::exists(file, error)) return std::nullopt;
    return read_background(file);
}

RecordedTable RecordedRun::statistics() const {
    return read_table(folder_ / "statistics.csv");
}

RecordedTable read_table(const fs::path& file) {
    const std::string text = read_text(file);
    RecordedTable table;
    std::size_t columns = 0, names = 0;
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
        std::vector<std::string> cells = csv_cells(std::string_view(text).substr(at, end - at));
        if (at == 0) {
            columns = cells.size();
            names = static_cast<std::size_t>(std::find(cells.begin(), cells.end(), "name") - cells.begin());
        }
        if (cells.size() != columns) {
            fail(file, fmt::format("row {} has {} cells, not {}", table.rows.size() + 1, cells.size(), columns));
        }
        if (names < columns) cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(names));
        if (at == 0) {
            table.columns = cells;
            continue;
        }
        std::vector<double>& row = table.rows.emplace_back();
        for (const std::string& cell : cells) row.push_back(cell_value(file, cell));
    }
    if (table.columns.empty()) fail(file, "it has no header");
    return table;
}

RecordedLives RecordedRun::lifespans() const {
    return read_lives(folder_ / "lifespans.vtp");
}

std::size_t RecordedTable::column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
    throw UserError(fmt::format("statistics.csv has no column '{}'{}; it has {}", name, did_you_mean(name, columns),
                                fmt::join(columns, ", ")));
}

std::vector<std::vector<double>> RecordedTable::last_rows() const {
    std::vector<std::vector<double>> last = rows;
    if (rows.empty()) return last;
    const std::size_t step = column("step");
    std::erase_if(last, [&](const std::vector<double>& row) { return row[step] != rows.back()[step]; });
    return last;
}

}  // namespace espalier::archive
