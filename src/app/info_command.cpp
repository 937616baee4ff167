#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/timeline/csv_file.h"
#include "espalier/timeline/recorded_run.h"

#include "command.h"
#include "progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace espalier {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct InfoArguments {
    std::filesystem::path folder;
    bool json = false;
};

// The rows of the last step: column name to value, one object per plant.
Json last_statistics(const fs::path& file) {
    Json rows = Json::array();
    if (!fs::exists(file)) return rows;
    const RecordedTable table = read_table(file);
    for (const std::vector<double>& values : table.last_rows()) {
        Json row;
        for (std::size_t i = 0; i < values.size(); ++i) row[table.columns[i]] = csv_number(values[i]);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::size_t count_files(const fs::path& folder, const std::string& extension) {
    if (!fs::is_directory(folder)) return 0;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) count += entry.path().extension() == extension;
    return count;
}

Json fields_of(const fs::path& folder) {
    Json fields = Json::object();
    if (!fs::is_directory(folder)) return fields;
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.is_directory()) paths.push_back(entry.path());
    }
    std::sort(paths.begin(), paths.end());
    for (const fs::path& path : paths) fields[path.filename().string()] = count_files(path, ".vti");
    return fields;
}

Json read_run(const fs::path& folder) {
    const fs::path file = folder / "run.json";
    if (!fs::exists(file)) {
        throw UserError(fmt::format("{} holds no run: there is no run.json in it", folder.string()));
    }
    Json run = Json::parse(read_text(file), nullptr, false);
    if (!run.is_object() || !run.contains("exit")) {
        throw UserError(fmt::format("{} is not what a run writes", file.string()));
    }
    return run;
}

Json summary_of(const fs::path& folder) {
    const Json run = read_run(folder);
    Json summary;
    for (const char* key : {"exit", "version", "started", "seed", "threads", "steps", "steps_done", "time_unit"}) {
        summary[key] = run.value(key, Json());
    }
    summary["exit"] = exit_of_run(folder);
    summary["scene"] = run.value("scene", Json::object()).value("name", "");
    summary["seconds"] = run.value("timings", Json::object()).value("total", 0.0);
    summary["memory"] = run.value("memory", Json());
    summary["peak_memory"] = run.value("peak_memory", Json());
    summary["frames"] = count_files(folder / "plants", ".vtp");
    summary["fields"] = fields_of(folder / "fields");
    summary["plants"] = run.value("plants", Json::array());
    summary["last_step"] = last_statistics(folder / "statistics.csv");
    return summary;
}

// A table with aligned columns; long stands are cut after 20 plants.
void print_statistics(const Json& rows) {
    if (rows.empty()) return;
    constexpr std::size_t most_rows = 20;
    const std::size_t shown = std::min(rows.size(), most_rows);
    for (const auto& [column, first] : rows.front().items()) {
        std::string line = fmt::format("  {:24}", column);
        for (std::size_t i = 0; i < shown; ++i) line += fmt::format(" {:>12}", rows[i][column].get<std::string>());
        fmt::print("{}\n", line);
    }
    if (shown < rows.size()) fmt::print("  ... and {} plants more in statistics.csv\n", rows.size() - shown);
}

void print_summary(const fs::path& folder, const Json& summary) {
    const auto text = [&](const char* key) {
        const Json& value = summary[key];
        return value.is_string() ? value.get<std::string>() : value.dump();
    };
    fmt::print("{}: scene {}, seed {}, espalier {}\n", folder.string(), text("scene"), text("seed"), text("version"));
    fmt::print("ended: {}; {} of {} steps in {} on {} threads, begun {}\n", text("exit"), text("steps_done"),
               text("steps"), duration_text(summary["seconds"].get<double>()), text("threads"), text("started"));
    if (summary["peak_memory"].is_number() && summary["memory"].is_number()) {
        fmt::print("memory: at most {} MiB of {} MiB\n", summary["peak_memory"].get<std::uint64_t>() >> 20,
                   summary["memory"].get<std::uint64_t>() >> 20);
    }
    fmt::print("frames: {} of plants", text("frames"));
    for (const auto& [name, count] : summary["fields"].items()) fmt::print(", {} of field {}", count.dump(), name);
    fmt::print("\nlast step, one column a plant:\n");
    print_statistics(summary["last_step"]);
}

int info(const InfoArguments& arguments) {
    try {
        const Json summary = summary_of(arguments.folder);
        if (arguments.json) {
            fmt::print("{}\n", summary.dump(2, ' ', false, Json::error_handler_t::replace));
        } else {
            print_summary(arguments.folder, summary);
        }
    } catch (const Json::exception& error) {
        throw UserError(
            fmt::format("{} is not what a run writes: {}", (arguments.folder / "run.json").string(), error.what()));
    }
    return exit_code::done;
}

class Info final : public Command {
public:
    explicit Info(CLI::App& program) : Command(program, "info", "summarise what a run left in a folder") {
        app().add_option("folder", folder_, "an output folder")->required();
        add_json_flag("print it as JSON");
        app().footer("Example:\n  espalier info output/two-trees-20260101-120000");
    }

    int run() override { return info({folder_, wants_json()}); }

private:
    std::filesystem::path folder_;
};

const RegisteredCommand<Info> entry{40};

}  // namespace
}  // namespace espalier
