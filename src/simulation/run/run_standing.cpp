#include "simulation/run/run_standing.h"

#include "espalier/base/error.h"
#include "espalier/timeline/timeline.h"

#include "base/csv_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>
#include <utility>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;
using Kind = RunStanding::Kind;

// Why the run that is there is another one; "" if it is not.
std::string difference(const RecordedCommand& there, const std::vector<std::string>& arguments) {
    if (there.arguments != arguments) {
        return fmt::format("it was started as `espalier run {}`", fmt::join(there.arguments, " "));
    }
    if (there.folder != fs::current_path()) return fmt::format("it was started in {}", there.folder.string());
    const fs::path changed = changed_input(there);
    return changed.empty() ? "" : fmt::format("{} has changed since it began", changed.string());
}

RunStanding standing_of(RecordedCommand command, const fs::path& folder) {
    std::error_code unknown;
    if (command.exit == "done") {
        const fs::path missing = missing_of_complete(folder);
        if (missing.empty()) return {Kind::complete, "", std::move(command)};
        return {Kind::begun, fmt::format("{} is gone", (folder / missing).string()), std::move(command)};
    }
    const bool has_checkpoint = fs::exists(checkpoint_of(folder), unknown);
    return {has_checkpoint ? Kind::resumable : Kind::begun, "", std::move(command)};
}

}  // namespace

RunStanding standing_of(const fs::path& folder, const std::vector<std::string>& arguments) {
    std::error_code unknown;
    if (!fs::exists(folder / "run.json", unknown)) return {};
    RecordedCommand command;
    try {
        command = read_command(folder);
    } catch (const UserError& error) {
        return {Kind::other, error.what()};
    }
    if (std::string why = difference(command, arguments); !why.empty()) {
        return {Kind::other, std::move(why), std::move(command)};
    }
    return standing_of(std::move(command), folder);
}

void remove_checkpoint(const fs::path& folder) {
    std::error_code ignored;
    fs::remove(checkpoint_of(folder), ignored);
    for (const char* table : {"statistics.csv", "timings.csv"}) CsvFile::forget(folder / table);
}

void mark_complete(const fs::path& folder) {
    remove_checkpoint(folder);
    timeline::write_complete(folder);
}

fs::path changed_input(const RecordedCommand& command) {
    for (const auto& [path, file] : command.inputs) {
        if (!is_unchanged(path, file)) return path;
    }
    return {};
}

}  // namespace espalier::simulation
