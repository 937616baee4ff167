#include "espalier/base/error.h"
#include "espalier/base/text.h"
#include "espalier/picture/table_charts.h"

#include "app/command.h"
#include "picture_options.h"

#include <fmt/format.h>

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
        app().add_option("--output", output_, "a .png or .svg; default: plot.png in the first run's folder");
        app().footer(R"(Examples:
  espalier plot output/two-trees
  espalier plot output/forest --quantity height,light.mean --per species --output light.svg
  espalier plot output/two-trees output/lone-tree --quantity organs --dark
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
        const ChartPage page = chart_page(read_tables(runs_), options);
        const fs::path output = output_.empty() ? runs_.front() / "plot.png" : output_;
        write_picture(page, picture_.size(fitting_size(page)), output);
        fmt::print("{}\n", output.string());
        return exit_code::done;
    }

private:
    PictureOptions picture_;
    std::vector<fs::path> runs_;
    std::vector<std::string> quantities_;
    std::string per_;
    fs::path output_;
};

const RegisteredCommand<Plot> entry{34};

}  // namespace
}  // namespace espalier::app
