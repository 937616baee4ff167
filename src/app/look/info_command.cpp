#include "espalier/archive/recorded_run.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/simulation/simulation.h"

#include "app/child.h"
#include "app/command.h"
#include "app/measured_report.h"
#include "app/progress.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "base/number.h"
#include "base/text.h"
#include "picture/charts/quantity.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct InfoArguments {
    std::filesystem::path folder;
    bool json = false;
};

/// What statistics.csv says of the last step, a row a plant.
RecordedTable last_step_of(const fs::path& run) {
    const fs::path file = run / "statistics.csv";
    if (!fs::exists(file)) return {};
    RecordedTable table = read_table(file);
    table.rows = table.last_rows();
    return table;
}

// One object per plant; what a plant has not is null.
Json json_of(const RecordedTable& last) {
    Json rows = Json::array();
    for (const std::vector<double>& values : last.rows) {
        Json row;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double whole = std::trunc(values[i]);
            const bool counts = whole == values[i] && std::abs(whole) < 0x1p53;
            row[last.columns[i]] = counts ? Json(static_cast<std::int64_t>(whole)) : Json(values[i]);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Further files of a frame that is cut into several have a dash in their names.
std::size_t count_frames(const fs::path& folder, const std::string& extension) {
    if (!fs::is_directory(folder)) return 0;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const bool begins_frame = entry.path().stem().string().find('-') == std::string::npos;
        count += begins_frame && entry.path().extension() == extension;
    }
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
    for (const fs::path& path : paths) fields[path.filename().string()] = count_frames(path, ".vti");
    return fields;
}

Json read_run(const fs::path& folder) {
    const fs::path file = folder / "run.json";
    if (!fs::exists(file)) {
        throw UserError(fmt::format("{} is not the folder of a run: it has no run.json", folder.string()));
    }
    Json run = read_json<Json>(read_text(file));
    if (!run.is_object() || !run.contains("exit")) {
        throw UserError(fmt::format("{} was not written by a run", file.string()));
    }
    return run;
}

/// The step of the last whole row of timings.csv; nothing if there is none.
std::optional<int> timed_steps(const fs::path& folder) {
    if (!is_readable(folder / "timings.csv")) return std::nullopt;
    const std::string text = read_text(folder / "timings.csv");
    const std::size_t end = text.rfind('\n');
    if (end == std::string::npos || end == 0) return std::nullopt;
    const std::size_t begin = text.rfind('\n', end - 1) + 1;
    return whole_text_as<int>(std::string_view(text).substr(begin, text.find(',', begin) - begin));
}

Json summary_of(const fs::path& folder, const Json& run, const RecordedTable& last) {
    Json summary;
    for (const char* key : {"exit", "version", "started", "seed", "threads", "steps", "steps_done", "time_unit"}) {
        summary[key] = run.value(key, Json());
    }
    const std::string exit = exit_of_run(folder);
    summary["exit"] = exit;
    if (const std::optional<int> step = step_of_checkpoint(folder)) summary["checkpoint"] = *step;
    summary["scene"] = run.value("scene", Json::object()).value("name", "");
    summary["seconds"] = run.value("timings", Json::object()).value("total", 0.0);
    if (exit == "running" || exit == "killed") {  // its run.json was written when it began, or went on
        if (const std::optional<int> steps = timed_steps(folder)) summary["steps_done"] = *steps;
        summary["seconds"] = nullptr;
    }
    summary["memory"] = run.value("memory", Json());
    summary["peak_memory"] = run.value("peak_memory", Json());
    summary["frames"] = count_frames(folder / "plants", ".vtp");
    summary["fields"] = fields_of(folder / "fields");
    summary["plants"] = run.value("plants", Json::array());
    summary["bytes"] = bytes_below(folder);
    summary["last_step"] = json_of(last);
    return summary;
}

/// Columns of a printed table, each below its heading.
using Headed = std::vector<std::pair<std::string, std::vector<double>>>;

Headed one_each(const RecordedTable& last, const Json& plants) {
    Headed columns;
    for (std::size_t i = 0; i < last.rows.size(); ++i) {
        columns.emplace_back(i < plants.size() ? plants[i].value("name", "") : "", last.rows[i]);
    }
    return columns;
}

/// The least, the mean and the most of those plants that have a value. Means of answers count as much as was asked.
Headed of_all(const RecordedTable& last) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::size_t count = last.columns.size();
    const std::vector<double> none(count, std::numeric_limits<double>::quiet_NaN());
    Headed columns{{"least", none}, {"mean", none}, {"most", none}};
    for (std::size_t i = 0; i < count; ++i) {
        const picture::QuantityColumn column(last, last.columns[i]);
        double least = infinity, most = -infinity, sum = 0, weights = 0;
        for (const std::vector<double>& row : last.rows) {
            const double weight = column.weight(row);
            if (!std::isfinite(row[i]) || !(weight > 0)) continue;
            least = std::min(least, row[i]);
            most = std::max(most, row[i]);
            sum += weight * row[i];
            weights += weight;
        }
        if (weights == 0) continue;
        const double figures[] = {least, sum / weights, most};
        for (std::size_t k = 0; k < columns.size(); ++k) columns[k].second[i] = figures[k];
    }
    return columns;
}

/// A column for every plant of a few.
void print_statistics(const RecordedTable& last, const Json& plants) {
    if (last.rows.empty()) return;
    constexpr std::size_t most_columns = 6;
    const bool few = last.rows.size() <= most_columns;
    const Headed columns = few ? one_each(last, plants) : of_all(last);
    fmt::print("{:26}", few ? "last step" : fmt::format("last step, {} plants", last.rows.size()));
    for (const auto& column : columns) fmt::print(" {:>12}", column.first);
    fmt::print("\n");
    for (std::size_t i = 0; i < last.columns.size(); ++i) {
        if (last.columns[i] == "step" || last.columns[i] == "time" || last.columns[i] == "plant") continue;
        fmt::print("  {:24}", last.columns[i]);
        for (const auto& column : columns) {
            fmt::print(" {:>12}", std::isfinite(column.second[i]) ? format_general(column.second[i]) : "");
        }
        fmt::print("\n");
    }
}

void print_summary(const fs::path& folder, const Json& summary) {
    const auto text = [&](const char* key) {
        const Json& value = summary[key];
        return value.is_string() ? value.get<std::string>() : value.dump();
    };
    fmt::print("{}: scene {}, seed {}, espalier {}\n", folder.string(), text("scene"), text("seed"), text("version"));
    const Json& seconds = summary["seconds"];
    fmt::print("ended: {}; {} of {} steps{} on {} threads, begun {}\n", text("exit"), text("steps_done"), text("steps"),
               seconds.is_number() ? " in " + duration_text(seconds.get<double>()) : "", text("threads"),
               text("started"));
    if (summary["peak_memory"].is_number() && summary["memory"].is_number()) {
        fmt::print("memory: at most {} MiB of {} MiB\n", summary["peak_memory"].get<std::uint64_t>() >> 20,
                   summary["memory"].get<std::uint64_t>() >> 20);
    }
    if (summary.contains("checkpoint")) {
        fmt::print("checkpoint: of step {}, from which `espalier resume {}` goes on\n", text("checkpoint"),
                   quoted(folder.string()));
    }
    fmt::print("frames: {} of plants", text("frames"));
    for (const auto& [name, count] : summary["fields"].items()) fmt::print(", {} of field {}", count.dump(), name);
    fmt::print("\nsize: {:.1f} MB\n", static_cast<double>(summary["bytes"].get<std::uint64_t>()) / 1e6);
}

int info(const InfoArguments& arguments) {
    try {
        const Json run = read_run(arguments.folder);
        const RecordedTable last = last_step_of(arguments.folder);
        const Json summary = summary_of(arguments.folder, run, last);
        if (arguments.json) {
            fmt::print("{}\n", json_text(summary));
        } else {
            print_summary(arguments.folder, summary);
            print_statistics(last, summary["plants"]);
        }
    } catch (const Json::exception& error) {
        throw UserError(
            fmt::format("{} was not written by a run: {}", (arguments.folder / "run.json").string(), error.what()));
    }
    return exit_code::done;
}

class Info final : public Command {
public:
    explicit Info(CLI::App& program) : Command(program, "info", "summarise a run, or a file of measured plants") {
        app().add_option("folder", folder_, "the folder of a run, or a file (rsml, mtg, ...)")->required();
        add_json_flag("print as JSON");
        app().footer("Examples:\n  espalier info output/two-trees\n  espalier info root.rsml");
    }

    int run() override {
        if (!fs::is_regular_file(folder_)) return info({folder_, wants_json()});
        report_measured(read_measured_plants(folder_), wants_json());
        return exit_code::done;
    }

private:
    std::filesystem::path folder_;
};

const RegisteredCommand<Info> info_entry{40};

}  // namespace
}  // namespace espalier::app
