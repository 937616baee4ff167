#include "espalier/analysis/run_analysis.h"
#include "espalier/base/error.h"
#include "espalier/base/text.h"
#include "espalier/picture/table_charts.h"

#include "app/command.h"
#include "app/options.h"
#include "frame_option.h"
#include "picture_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

// The charts of analysis.png and of layers.png, as far as the plants have such a thing.
constexpr const char* over_steps[] = {"tips",        "strahler",          "branching_ratio", "pipe_exponent",
                                      "area_ratio",  "fractal_dimension", "leaf_area_index", "crown_volume",
                                      "asymmetry_x", "asymmetry_z",       "length",          "depth_in_ground"};
constexpr const char* over_heights[] = {"length", "density", "leaf_area"};

/// "crown volume (convex hull) (m³)"
std::string title_of(const MeasureDescription& measure) {
    if (measure.unit.empty()) return measure.meaning;
    std::string unit = measure.unit;
    if (unit.ends_with('2')) unit.replace(unit.size() - 1, 1, "²");
    if (unit.ends_with('3')) unit.replace(unit.size() - 1, 1, "³");
    return fmt::format("{} ({})", measure.meaning, unit);
}

bool has_values(const RecordedTable& table, const std::string& name) {
    const std::size_t column = table.column(name);
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return std::isfinite(row[column]) && row[column] != 0; });
}

/// Those of `names` that the plants have, drawn over `x`.
ChartPage page_of(const RecordedRun& run, RecordedTable table, std::span<const char* const> names, const std::string& x,
                  bool dark) {
    PlotOptions options;
    options.dark = dark;
    options.x = x;
    for (const char* name : names) {
        if (options.quantities.size() < 9 && has_values(table, name)) options.quantities.emplace_back(name);
    }
    for (const MeasureDescription& measure : measure_descriptions()) options.titles[measure.name] = title_of(measure);
    options.titles["density"] = "length density (m/m³)";
    if (x == "height") {
        options.titles["height"] = "height (m)";
        options.titles["length"] = "length in the layer (m)";
        options.titles["leaf_area"] = "leaf area in the layer (m²)";
    }
    const PlottedTable plotted{run.scene(), std::move(table), run.plants()};
    return options.quantities.empty() ? ChartPage{} : chart_page({&plotted, 1}, options);
}

// The rows of the last step, a column a plant; long stands are cut after 8 plants.
void print_last(const RecordedRun& run, const RecordedTable& table) {
    constexpr std::size_t most_plants = 8;
    std::vector<const std::vector<double>*> rows;
    for (const auto& row : table.rows) {
        if (row[0] == table.rows.back()[0]) rows.push_back(&row);
    }
    const std::size_t shown = std::min(rows.size(), most_plants);
    std::string line = fmt::format("{:22}", fmt::format("step {}", table.rows.back()[0]));
    for (std::size_t i = 0; i < shown; ++i) {
        std::string name = fmt::format("plant {}", (*rows[i])[1]);
        for (const RecordedPlant& plant : run.plants()) {
            if (plant.number == (*rows[i])[1] && !plant.name.empty()) name = plant.name;
        }
        line += fmt::format(" {:>12}", name);
    }
    fmt::print("{}\n", line);
    for (std::size_t column = 2; column < table.columns.size(); ++column) {
        const MeasureDescription& measure = measure_descriptions()[column - 2];
        line = fmt::format("{:22}", measure.name + (measure.unit.empty() ? "" : " " + measure.unit));
        for (std::size_t i = 0; i < shown; ++i) {
            const double value = (*rows[i])[column];
            line += fmt::format(" {:>12}", std::isnan(value) ? "-" : fmt::format("{:.5g}", value));
        }
        fmt::print("{}\n", line);
    }
    if (shown < rows.size()) fmt::print("... and {} more plants\n", rows.size() - shown);
}

class Analyse final : public Command {
public:
    explicit Analyse(CLI::App& program)
        : Command(program, "analyse", "measure the form of plants: branching, widths, crowns, roots"), picture_(app()) {
        app().add_option("run", run_, "the folder of a run")->required();
        app().add_option("--step", step_, std::string(frame_option_help) + "; default: all");
        app().add_option("--plant", plant_, "name of one plant; default: all plants");
        app()
            .add_option("--format", format_, "format of the tables: csv (default) or json")
            ->check(CLI::IsMember({"csv", "json"}));
        app().add_option("--output", output_, "output folder; default: 'analysis' in the folder of the run");
        app()
            .add_option("--leaf", leaves_, "symbols whose surfaces are leaves, such as L,~l; default: every surface")
            ->delimiter(',')
            ->allow_extra_args(false);
        app()
            .add_option("--layer", layer_,
                        "thickness of the layers of height and depth, m; default: about 20 layers per plant")
            ->check(above_zero());
        app()
            .add_option("--voxel", voxel_, "edge of the voxels of the crown, m; default: 1/32 of its largest extent")
            ->check(above_zero());
        app().add_flag("--no-picture", no_picture_, "draw no pictures");
        app().footer(
            R"(Writes analysis.csv with one row per step and plant, orders.csv (streams of each Strahler order), ramification.csv,
layers.csv (lengths and leaf areas by height or depth) and internodes.csv (lengths of internodes), or analysis.json with all
of these. Also draws analysis.png, the main measures over the steps, and layers.png, the layers of the last step.
Examples:
  espalier analyse output/two-trees
  espalier analyse output/two-roots --step last --layer 0.02 --format json
  espalier analyse output/two-trees --plant left --step 0:184:8 --leaf N --output tables)");
    }

    int run() override {
        const RecordedRun run(run_);
        std::vector<const RecordedFrame*> frames = chosen_frames(run, step_);
        std::erase_if(frames, [](const RecordedFrame* frame) { return frame->plants.empty(); });
        if (frames.empty()) throw UserError(fmt::format("{} has no plants at these steps", run_.string()));
        std::vector<std::uint32_t> plants;
        if (plant_.empty()) {
            for (const RecordedPlant& plant : run.plants()) plants.push_back(plant.number);
        } else {
            plants.push_back(run.plant(plant_));
        }
        AnalysisOptions options{{leaves_.begin(), leaves_.end()}, layer_, voxel_};
        const RunAnalysis analysis(run, frames, plants, options);
        write(run, analysis);
        return exit_code::done;
    }

private:
    void write(const RecordedRun& run, const RunAnalysis& analysis) {
        const fs::path folder = output_.empty() ? run_ / "analysis" : output_;
        std::error_code error;
        fs::create_directories(folder, error);
        if (error) throw RunError(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
        format_ == "json" ? analysis.write_json(folder) : analysis.write_csv(folder);
        const RecordedTable table = analysis.table();
        if (!table.rows.empty()) print_last(run, table);
        fmt::print("{}\n", (folder / "").string());
        if (no_picture_) return;
        try {
            const bool several_steps = !table.rows.empty() && table.rows.front()[0] != table.rows.back()[0];
            if (several_steps) draw(page_of(run, table, over_steps, "step", picture_.dark()), folder / "analysis.png");
            draw(page_of(run, analysis.last_layers(), over_heights, "height", picture_.dark()), folder / "layers.png");
        } catch (const RunError& no_picture) {
            // The tables are what was asked for; they are complete.
            fmt::print(stderr, "no picture: {}\n", no_picture.what());
        }
    }
    void draw(const ChartPage& page, const fs::path& path) const {
        if (!page.charts.empty()) write_picture(page, picture_.size(fitting_size(page)), path);
    }

    PictureOptions picture_;
    fs::path run_, output_;
    std::string step_ = "all", plant_, format_ = "csv";
    std::vector<std::string> leaves_;
    double layer_ = 0, voxel_ = 0;
    bool no_picture_ = false;
};

const RegisteredCommand<Analyse> entry{38};

}  // namespace
}  // namespace espalier::app
