// A growth that was followed: columns of statistics.csv over steps or over time.
#include "espalier/base/error.h"

#include "base/csv_rows.h"
#include "base/text.h"
#include "study/fit/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::study {
namespace {

namespace fs = std::filesystem;

class Course final : public Target {
public:
    Course(const fs::path& file, bool by_step, const std::vector<Observation>& observations)
        : file_(file), by_step_(by_step), observations_(observations) {
        for (const Observation& one : observations_) {
            statistics_.push_back(
                {fmt::format("{}@{:.6g}", one.column, one.at), one.value, scale_of(one.column, observations_)});
        }
    }

    const std::vector<Statistic>& statistics() const override { return statistics_; }
    Needs needs() const override { return {false, true}; }

    std::vector<double> of(std::span<const Grown> worlds) const override {
        std::vector<double> values(observations_.size(), 0);
        for (const Grown& world : worlds) {
            for (std::size_t i = 0; i < values.size(); ++i) {
                values[i] += value_of(world, observations_[i]) / static_cast<double>(worlds.size());
            }
        }
        return values;
    }

    MeasuredCourse course() const override { return {by_step_, observations_}; }

private:
    /// 5 % of the greatest value of the column.
    static double scale_of(const std::string& column, const std::vector<Observation>& all) {
        double greatest = 0;
        for (const Observation& one : all) {
            if (one.column == column) greatest = std::max(greatest, std::abs(one.value));
        }
        return greatest > 0 ? 0.05 * greatest : 1;
    }

    /// Between two steps what lies between.
    double value_of(const Grown& world, const Observation& observation) const {
        const auto column = std::find(world.columns.begin(), world.columns.end(), observation.column);
        if (column == world.columns.end()) {
            throw UserError(fmt::format("{}: statistics.csv has no column '{}'{}", file_.string(), observation.column,
                                        did_you_mean(observation.column, world.columns)));
        }
        const auto time = [&](std::size_t row) { return by_step_ ? world.steps[row] : world.times[row]; };
        std::size_t next = 0;
        while (next < world.course.size() && time(next) < observation.at) ++next;
        if (next == world.course.size()) {
            throw UserError(fmt::format("{}: measured at {} {:.6g}, but growth ends at {:.6g}: give more --steps",
                                        file_.string(), by_step_ ? "step" : "time", observation.at, time(next - 1)));
        }
        const auto value = [&](std::size_t row) {
            return world.course[row][static_cast<std::size_t>(column - world.columns.begin())];
        };
        if (next == 0 || time(next) == observation.at) return value(next);
        const double share = (observation.at - time(next - 1)) / (time(next) - time(next - 1));
        return value(next - 1) + share * (value(next) - value(next - 1));
    }

    fs::path file_;
    bool by_step_;
    std::vector<Observation> observations_;
    std::vector<Statistic> statistics_;
};

std::shared_ptr<Target> read_course(const fs::path& file) {
    if (file.extension() != ".csv" && file.extension() != ".tsv") return nullptr;
    const CsvRows table(file);
    if (table.rows().empty()) return nullptr;
    const std::vector<std::string>& header = table.rows().front().cells;
    const auto column_named = [&](const char* name) {
        return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
    };
    const bool by_time = column_named("time") < header.size();
    const std::size_t when = column_named(by_time ? "time" : "step");
    if (when == header.size()) return nullptr;
    std::vector<Observation> observations;
    for (std::size_t row = 1; row < table.rows().size(); ++row) {
        const CsvRow& cells = table.rows()[row];
        const auto at = cells.number(when);
        if (!at || *at < 0) throw UserError(table.place(cells, when), fmt::format("expected a {}", header[when]));
        for (std::size_t column = 0; column < header.size(); ++column) {
            const bool is_place = header[column] == "step" || header[column] == "time" || header[column] == "plant" ||
                                  header[column] == "name";
            if (is_place || cells.is_missing(column)) continue;
            const auto value = cells.number(column);
            if (!value) {
                throw UserError(
                    table.place(cells, column),
                    fmt::format("expected a number of '{}', or nothing where it was not measured", header[column]));
            }
            observations.push_back({header[column], *at, *value});
        }
    }
    if (observations.empty()) throw UserError(Place{file.string(), 1, 0}, "no value was measured");
    auto course = std::make_shared<Course>(file, !by_time, observations);
    for (const char* name : {by_time ? "step" : "time", "plant", "name"}) {
        if (column_named(name) == header.size()) continue;
        course->notes.push_back(
            fmt::format("column '{}' is not used: values are those of the mean over the plants", name));
    }
    return course;
}

const Registered<TargetType> course_entry{
    {"course", "a table (.csv) with a column `step` or `time` and columns of statistics.csv: means over the plants",
     read_course}};

}  // namespace
}  // namespace espalier::study
