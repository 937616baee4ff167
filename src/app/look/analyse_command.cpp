#include "espalier/analysis/run_analysis.h"
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/picture/table_charts.h"

#include "app/command.h"
#include "app/options.h"
#include "archive/chosen_frames.h"
#include "base/folder.h"
#include "base/number.h"
#include "base/text.h"
#include "field_profile.h"
#include "picture/charts/quantity.h"
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
constexpr const char* over_heights[] = {"length", "density", "ground_density", "leaf_area", "uptake"};

/// "crown volume (convex hull) (m³)"
std::string title_of(const MeasureDescription& measure) {
    if (measure.unit.empty()) return measure.meaning;
    return fmt::format("{} ({})", measure.meaning, picture::with_powers(measure.unit));
}

bool has_values(const RecordedTable& table, const std::string& name) {
    const std::size_t column = table.column(name);
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return std::isfinite(row[column]) && row[column] != 0; });
}

/// "time (day)"
std::string time_title(const RecordedRun& run) {
    return fmt::format("time ({})", run.time_unit());
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
    options.titles["time"] = time_title(run);
    options.titles["density"] = "length per volume below the hull (m/m³)";
    options.titles["ground_density"] = "length per volume of soil (m/m³)";
    if (x == "height") {
        options.upright = true;
        options.titles["height"] = "height (m)";
        options.titles["length"] = "length in the layer (m)";
        options.titles["leaf_area"] = "leaf area in the layer (m²)";
        options.titles["uptake"] = "uptake in the layer (cm³/d)";
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
        const double number = (*rows[i])[table.column("plant")];
        std::string name = fmt::format("plant {}", number);
        for (const RecordedPlant& plant : run.plants()) {
            if (plant.number == number && !plant.name.empty()) name = plant.name;
        }
        line += fmt::format(" {:>12}", name);
    }
    fmt::print("{}\n", line);
    const std::size_t first = table.columns.size() - measure_descriptions().size();
    for (std::size_t column = first; column < table.columns.size(); ++column) {
        const MeasureDescription& measure = measure_descriptions()[column - first];
        line = fmt::format("{:22}", measure.name + (measure.unit.empty() ? "" : " " + measure.unit));
        for (std::size_t i = 0; i < shown; ++i) {
            const double value = (*rows[i])[column];
            line += fmt::format(" {:>12}", std::isnan(value) ? "-" : fmt::format("{:.5g}", value));
        }
        fmt::print("{}\n", line);
    }
    if (shown < rows.size()) fmt::print("... and {} more plants\n", rows.size() - shown);
}

/// "first stress of root at 31.5 day, 12% of its demand was not met"
void print_stress(const RecordedRun& run, const RecordedTable& stress) {
    for (const std::vector<double>& row : stress.rows) {
        const auto plant = static_cast<std::uint32_t>(row[stress.column("plant")]);
        const double first = row[stress.column("first_time")];
        const double lacked = 1 - row[stress.column("transpired")] / row[stress.column("demanded")];
        std::string name = fmt::format("plant {}", plant);
        for (const RecordedPlant& each : run.plants()) {
            if (each.number == plant && !each.name.empty()) name = each.name;
        }
        if (std::isnan(first)) {
            fmt::print("{} transpired as much as it could at all times\n", name);
        } else {
            fmt::print("{} lacked water first at {} {}, in all {:.3g}% of its demand\n", name, format_general(first),
                       run.time_unit(), 100 * lacked);
        }
    }
}

class Analyse final : public Command {
public:
    explicit Analyse(CLI::App& program)
        : Command(program, "analyse",
                  "measure the form of plants: branching, widths, crowns, roots; and fields over depth"),
          picture_(app()),
          profile_(app()) {
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
                        "thickness of the layers of height and depth, m; default: about 20 layers in all")
            ->check(above_zero());
        app().add_option(
            "--range", range_,
            "heights that the layers cover at least, LOW:HIGH, m, as in -1.2:0; so that runs have the same");
        app()
            .add_option("--area", area_,
                        "area of the ground for length densities, m2; default: that of the scene's domain")
            ->check(above_zero());
        app()
            .add_option("--voxel", voxel_, "edge of the voxels of the crown, m; default: 1/32 of its largest extent")
            ->check(above_zero());
        app().add_flag("--no-picture", no_picture_, "draw no pictures");
        profile_.exclude({"--plant", "--format", "--leaf", "--layer", "--range", "--area", "--voxel"});
        app().footer(
            R"(Writes analysis.csv with one row per step and plant, orders.csv (streams of each Strahler order), ramification.csv,
layers.csv (lengths, leaf areas and, where timeline.organs has an uptake, that, by height or depth), internodes.csv (lengths of
internodes) and, of plants that transpire, stress.csv (when they first lacked water), or analysis.json with all of these. Also draws analysis.png, the main measures over the steps, and layers.png, the layers of the last step.
With --field, writes water-y.csv with mean, deviation, minimum and maximum of each layer of voxels, and draws water-y.png.
Examples:
  espalier analyse output/two-trees
  espalier analyse output/two-roots --step last --layer 0.02 --format json
  espalier analyse output/two-roots --field water --profile y
  espalier analyse output/two-trees --plant left --step 0:184:8 --leaf N --output tables)");
    }

    int run() override {
        const RecordedRun run(run_);
        std::vector<const RecordedFrame*> frames = chosen_frames(run, step_);
        if (profile_.is_asked()) {
            write_profile(run, profile_.table(run, frames));
            return exit_code::done;
        }
        std::erase_if(frames, [](const RecordedFrame* frame) { return frame->plants.empty(); });
        if (frames.empty()) throw UserError(fmt::format("{} has no plants at these steps", run_.string()));
        std::vector<std::uint32_t> plants;
        if (plant_.empty()) {
            for (const RecordedPlant& plant : run.plants()) plants.push_back(plant.number);
        } else {
            plants.push_back(run.plant(plant_));
        }
        const auto [low, high] = range();
        const AnalysisOptions options{{leaves_.begin(), leaves_.end()}, layer_, low, high, area_, voxel_};
        const RunAnalysis analysis(run, frames, plants, options);
        write(run, analysis);
        return exit_code::done;
    }

private:
    std::pair<double, double> range() const {
        if (range_.empty()) return {0, 0};
        const std::size_t colon = std::min(range_.find(':'), range_.size() - 1);
        const auto low = finite_number(range_.substr(0, colon)), high = finite_number(range_.substr(colon + 1));
        if (low && high && *low < *high) return {*low, *high};
        throw UserError(fmt::format("--range {}: expected two heights such as -1.2:0, the lower first", range_));
    }

    fs::path made_folder() const {
        if (output_.empty()) {
            make_folder_below(run_, "analysis");
            return run_ / "analysis";
        }
        make_folder(output_);
        return output_;
    }

    void write_profile(const RecordedRun& run, const RecordedTable& table) const {
        const fs::path stem = made_folder() / profile_.name();
        write_text(stem.string() + ".csv", csv_of(table));
        fmt::print("{}.csv\n", stem.string());
        draw(profile_.page(run, table, picture_.dark()), stem.string() + ".png");
    }

    void write(const RecordedRun& run, const RunAnalysis& analysis) {
        const fs::path folder = made_folder();
        format_ == "json" ? analysis.write_json(folder) : analysis.write_csv(folder);
        const RecordedTable table = analysis.table();
        if (!table.rows.empty()) print_last(run, table);
        print_stress(run, analysis.stress());
        fmt::print("{}\n", (folder / "").string());
        const bool several_steps = !table.rows.empty() && table.rows.front()[0] != table.rows.back()[0];
        if (several_steps) {
            draw(page_of(run, table, over_steps, run.time_unit() == "step" ? "step" : "time", picture_.dark()),
                 folder / "analysis.png");
        }
        draw(page_of(run, analysis.last_layers(), over_heights, "height", picture_.dark()), folder / "layers.png");
    }

    // The tables are what was asked for; they are complete.
    void draw(const ChartPage& page, const fs::path& path) const {
        if (no_picture_ || page.charts.empty()) return;
        try {
            write_picture(page, picture_.size(fitting_size(page)), path);
        } catch (const RunError& no_picture) {
            fmt::print(stderr, "no picture: {}\n", no_picture.what());
        }
    }

    PictureOptions picture_;
    FieldProfile profile_;
    fs::path run_, output_;
    std::string step_ = "all", plant_, format_ = "csv";
    std::vector<std::string> leaves_;
    double layer_ = 0, area_ = 0, voxel_ = 0;
    std::string range_;
    bool no_picture_ = false;
};

const RegisteredCommand<Analyse> analyse_entry{38};

}  // namespace
}  // namespace espalier::app
