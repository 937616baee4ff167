#include "espalier/base/error.h"
#include "espalier/picture/table_charts.h"

#include "app/command.h"
#include "base/text.h"
#include "picture/charts/quantity.h"
#include "picture_options.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

// Names for the runs of one picture: of the scene, or of the folder where two runs have one scene.
std::vector<PlottedTable> read_tables(const std::vector<fs::path>& folders) {
    std::vector<PlottedTable> tables;
    std::map<std::string, int> scenes;
    for (const fs::path& folder : folders) {
        const RecordedRun run(folder);
        tables.push_back({run.scene(), run.statistics(), run.plants()});
        ++scenes[run.scene()];
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        if (scenes[tables[i].run] < 2) continue;
        const fs::path folder = fs::absolute(folders[i]).lexically_normal();
        tables[i].run = (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
    }
    return tables;
}

bool has_column(const RecordedTable& table, const std::string& name) {
    return std::find(table.columns.begin(), table.columns.end(), name) != table.columns.end();
}

// Time, where all runs measure it in one unit other than their steps.
std::string unit_of_time(const std::vector<fs::path>& folders, const std::vector<PlottedTable>& tables) {
    std::string unit;
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const std::string of_run = RecordedRun(folders[i]).time_unit();
        if (of_run == "step" || (i > 0 && of_run != unit) || !has_column(tables[i].table, "time")) return "";
        unit = of_run;
    }
    return unit;
}

// "water.uptake (m³)", where all runs that have a unit have this one.
std::map<std::string, std::string> titles_of(const std::vector<fs::path>& folders) {
    std::map<std::string, std::string> units, titles;
    for (const fs::path& folder : folders) {
        const RecordedRun run(folder);
        for (const auto& [column, unit] : run.units()) {
            const auto known = units.emplace(column, unit).first;
            if (known->second != unit) known->second.clear();
        }
    }
    for (const auto& [column, unit] : units) {
        if (!unit.empty()) titles[column] = fmt::format("{} ({})", column, picture::with_powers(unit));
    }
    return titles;
}

class Plot final : public Command {
public:
    explicit Plot(CLI::App& program) : Command(program, "plot", "draw charts of one run or several"), picture_(app()) {
        app().add_option("runs", runs_, "folders of runs; several runs are compared in each chart")->required();
        app()
            .add_option("--quantity", quantities_,
                        "columns of statistics.csv, one chart each: height,light.mean; default: the main columns")
            ->delimiter(',')
            ->allow_extra_args(false);
        app()
            .add_option(
                "--per", per_,
                "one line per plant, per species (model), or in total; default: depends on the number of plants")
            ->check(CLI::IsMember({"plant", "species", "total"}));
        app().add_option(
            "--against", against_,
            "a column of statistics.csv along the horizontal axis, such as leaves.internal; default: the time");
        app().add_option("--output", output_, "a .png or .svg; default: plot.png in the first run's folder");
        app().footer(R"(Examples:
  espalier plot output/two-trees
  espalier plot output/forest --quantity height,light.mean --per species --output light.svg
  espalier plot output/two-trees output/lone-tree --quantity organs --dark
  espalier plot output/leaf --quantity leaves.assimilation --against leaves.internal
`espalier info RUN` lists the quantities of a run. If a line stands for several plants, it shows the sum of counts, lengths and
volumes, the greatest of heights and maxima, and the mean of everything else.)");
    }

    int run() override {
        PlotOptions options;
        options.quantities = quantities_;
        options.dark = picture_.dark();
        if (per_ == "plant") options.lines = Lines::per_plant;
        if (per_ == "species") options.lines = Lines::per_species;
        if (per_ == "total") options.lines = Lines::total;
        options.titles = titles_of(runs_);
        const std::vector<PlottedTable> tables = read_tables(runs_);
        if (const std::string unit = unit_of_time(runs_, tables); !unit.empty()) {
            options.x = "time";
            options.titles["time"] = fmt::format("time ({})", unit);
        }
        if (!against_.empty()) {
            picture::require_quantity(tables, against_);
            options.x = against_;
        }
        const ChartPage page = chart_page(tables, options);
        const fs::path output = output_.empty() ? runs_.front() / "plot.png" : output_;
        write_picture(page, picture_.size(fitting_size(page)), output);
        fmt::print("{}\n", output.string());
        return exit_code::done;
    }

private:
    PictureOptions picture_;
    std::vector<fs::path> runs_;
    std::vector<std::string> quantities_;
    std::string per_, against_;
    fs::path output_;
};

const RegisteredCommand<Plot> plot_entry{34};

}  // namespace
}  // namespace espalier::app
