#include "simulation/run/recorded_command.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/json_text.h"
#include "simulation/run/run_inputs.h"
#include "simulation/run/written_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The bytes of an input that run.json does not hold, from the disk.
std::string bytes_on_disk(const fs::path& path, const ReadLog::File& file) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        throw UserError(fmt::format("run.json does not hold {}, and it is no longer there", path.string()));
    }
    if (!is_unchanged(path, file)) {
        throw UserError(fmt::format("run.json does not hold {}, and it has changed since", path.string()));
    }
    return read_text(path);
}

std::string bytes_of(const fs::path& path, const ReadLog::File& file) {
    if (!file.kept) return bytes_on_disk(path, file);
    if (file.bytes.size() == file.size && digest(file.bytes) == file.digest) return file.bytes;
    throw UserError(fmt::format("run.json was changed: {} is not what its digest says", path.string()));
}

// As ReadLog notes them; no disk takes longer names.
bool is_absolute_path(const fs::path& path) {
    constexpr std::size_t longest_name = 255;
    return path.is_absolute() && std::all_of(path.begin(), path.end(),
                                             [](const fs::path& name) { return name.native().size() <= longest_name; });
}

void make_folder_below(const fs::path& root, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!error) return;
    const std::string name = folder.lexically_relative(root).string();
    if (error == std::errc::not_a_directory || error == std::errc::filename_too_long) {
        throw UserError(fmt::format("run.json was changed: there can be no folder /{}: {}", name, error.message()));
    }
    throw RunError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

bool tells_of_the_run(const fs::path& file) {
    return file == "run.json" || file == "timings.csv" || file == ".lock" || file == "checkpoint" || file == "complete";
}

// Other commands leave pictures, charts and exports in the folder of a run.
bool is_written_by_runs(const fs::path& file) {
    static const std::set<fs::path> names{"plants.pvd",    "plants",         "fields.pvd",     "fields",
                                          "lifespans.vtp", "statistics.csv", "background.vtp", "files"};
    return names.contains(*file.begin());
}

std::set<fs::path> timeline_files(const fs::path& folder) {
    std::set<fs::path> files = files_below(folder);
    std::erase_if(files, tells_of_the_run);
    return files;
}

AskedOptions asked_in(const Json& json) {
    AskedOptions asked;
    asked.memory = json.value("memory", asked.memory);
    asked.disk = json.value("disk", asked.disk);
    asked.blocks = json.value("blocks", asked.blocks);
    asked.resident = json.value("resident", asked.resident);
    asked.patience = json.value("timeout", asked.patience);
    return asked;
}

// The command line gives it with a word, which no run notes among those that start it again.
bool gives_consent(const std::string& argument) {
    return argument.starts_with("--trust");
}

std::vector<NamedProgram> programs_in(const Json& json, const fs::path& run) {
    std::vector<NamedProgram> programs;
    const Json processes = json.value("processes", Json::object());
    for (const auto& [name, process] : processes.items()) {
        if (process.value("process", "") != "external") continue;
        NamedProgram& program = programs.emplace_back();
        program.process = name;
        program.command = process.value("command", std::vector<std::string>());
        program.place.file = (run / "run.json").string();
        program.folder = resolved(run);
    }
    return programs;
}

}  // namespace

RecordedCommand read_command(const fs::path& run) {
    const fs::path file = run / "run.json";
    std::error_code error;
    if (!fs::exists(file, error)) {
        throw UserError(fmt::format("{} holds no run: there is no run.json in it", run.string()));
    }
    try {
        const Json json = read_json<Json>(read_text(file));
        RecordedCommand command;
        command.version = json.at("version").get<std::string>();
        command.exit = json.at("exit").get<std::string>();
        command.checkpoint_every = json.value("checkpoint_every", 0);
        command.asked = asked_in(json.value("asked", Json::object()));
        command.steps = json.at("steps").get<int>();
        command.steps_done = json.value("steps_done", 0);
        command.folder = json.at("command").at("folder").get<std::string>();
        command.arguments = json.at("command").at("arguments").get<std::vector<std::string>>();
        if (!is_absolute_path(command.folder)) {
            throw UserError(fmt::format("{}: the run was started in the folder '{}', which is no absolute path",
                                        file.string(), command.folder.string()));
        }
        if (std::any_of(command.arguments.begin(), command.arguments.end(), gives_consent)) {
            throw UserError(
                fmt::format("{} was changed: consent to start programs is no setting of a run", file.string()));
        }
        if (command.arguments.empty()) throw UserError(file.string() + " does not say how the run was started");
        for (const Json& input : json.at("inputs")) {
            const fs::path path = fs::path(input.at("path").get<std::string>()).lexically_normal();
            if (!is_absolute_path(path) || !path.has_filename()) {
                throw UserError(fmt::format("{}: input '{}' is no path of a file", file.string(), path.string()));
            }
            command.inputs.emplace(path, input_of(input));
        }
        command.programs = programs_in(json, run);
        return command;
    } catch (const Json::exception&) {
        throw UserError(fmt::format("{} does not say how to repeat the run", file.string()));
    }
}

bool is_unchanged(const fs::path& path, const ReadLog::File& file) {
    std::error_code error;
    if (!fs::is_regular_file(path, error) || fs::file_size(path, error) != file.size) return false;
    return digest(read_text(path)) == file.digest;
}

fs::path lay_out_inputs(const RecordedCommand& command, const fs::path& root) {
    for (const auto& [path, file] : command.inputs) {
        const fs::path place = root / path.relative_path();
        make_folder_below(root, place.parent_path());
        write_text(place, bytes_of(path, file));
        if (!file.kept) fs::permissions(place, fs::status(path).permissions());  // it may be a program
    }
    const fs::path folder = root / command.folder.lexically_normal().relative_path();
    make_folder_below(root, folder);
    return folder;
}

std::vector<std::string> arguments_below(const RecordedCommand& command, const fs::path& root) {
    std::vector<std::string> arguments = command.arguments;
    for (std::string& argument : arguments) {
        const fs::path path = fs::path(argument).lexically_normal();
        const fs::path there = root / path.relative_path();
        std::error_code ignored;
        if (path.is_absolute() && fs::exists(there, ignored)) argument = there.string();
    }
    return arguments;
}

std::vector<std::string> timeline_differences(const fs::path& before, const fs::path& after) {
    const std::set<fs::path> old_files = timeline_files(before), new_files = timeline_files(after);
    std::vector<std::string> differences;
    for (const fs::path& file : old_files) {
        if (!new_files.contains(file)) {
            if (is_written_by_runs(file)) differences.push_back(file.string() + " is missing");
            continue;
        }
        const std::string old_bytes = read_text(before / file), new_bytes = read_text(after / file);
        if (old_bytes == new_bytes) continue;
        const auto at = std::mismatch(old_bytes.begin(), old_bytes.end(), new_bytes.begin(), new_bytes.end()).first;
        differences.push_back(fmt::format("{} differs from byte {} on", file.string(), at - old_bytes.begin()));
    }
    for (const fs::path& file : new_files) {
        if (!old_files.contains(file)) differences.push_back(file.string() + " is new");
    }
    return differences;
}

std::vector<std::string> beside_timeline(const fs::path& run) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(run)) {
        const fs::path name = entry.path().filename();
        if (is_written_by_runs(name) || tells_of_the_run(name)) continue;
        names.push_back(name.string() + (entry.is_directory() ? "/" : ""));
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace espalier::simulation
