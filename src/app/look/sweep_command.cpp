// sweep: grows a scene once for every combination of values.
#include "espalier/base/error.h"

#include "app/child.h"
#include "app/command.h"
#include "app/options.h"
#include "picture/charts/quantity.h"
#include "picture_options.h"
#include "sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

class SweepCommand final : public Command {
public:
    explicit SweepCommand(CLI::App& program)
        : Command(program, "sweep", "grow a scene for every combination of values, several at a time"),
          model_(app(), "what", "a scene (.toml), a model (.l), or the folder of an object",
                 ModelOptions::Files::reading_and_drawing),
          sets_(app()),
          growth_(app()),
          intervals_(app()),
          disk_(app()),
          picture_(app()) {
        app()
            .add_option("--vary", vary_,
                        "KEY=FIRST:LAST:COUNT, KEY=FIRST..LAST, KEY=VALUE,VALUE... or KEY,KEY=VALUE:VALUE,...; may "
                        "be repeated")
            ->required()
            ->allow_extra_args(false);
        app().add_option("--output", output_, "output folder, with one folder per run; default: output/<scene>-sweep");
        app()
            .add_option("--jobs", jobs_, "number of simultaneous runs; default: the number of cores")
            ->check(CLI::Range(1, 4096));
        app()
            .add_option("--threads", threads_, "number of threads of each run; default: the cores divided by the jobs")
            ->check(CLI::Range(1, 4096));
        app()
            .add_option("--statistic", statistics_,
                        "draw these columns of sweep.csv over the varied values, one chart each: height,light.mean")
            ->delimiter(',')
            ->allow_extra_args(false);
        app().add_option("--plot", plot_,
                         "file for the charts, .png or .svg; default with --statistic: sweep.png in the folder");
        CLI::Option* const list =
            app().add_flag("--list", list_, "print the commands that are still to be run, and do not run them");
        app()
            .add_flag(
                "--table", table_,
                "make sweep.csv and the charts of the runs that are complete, say which are missing, and run none")
            ->excludes(list);
        app().add_flag("--quiet", quiet_, quiet_growth_help);
        app().footer(
            R"(A sweep continues where it stopped: complete runs whose files have not changed are kept, and others go on from their
last checkpoint. The commands of --list do so, too, when they start.
At the end, sweep.csv has one row for every run and plant: the values, then the last step of statistics.csv.
The chart shows the last step of the runs. One key is the x axis, and every value of the others is a line (or the chart is a
heat map). Runs that differ only in simulation.seed become a mean with its standard deviation.
For a model alone, a KEY without a dot is one of its #defines.
Examples:
  espalier sweep environments/two-trees.toml --vary environment.light.strength=0.2:1:5 --vary simulation.seed=1..4
  espalier sweep models/course/03-parameters.l --vary simulation.steps=1..6 --jobs 2
  espalier sweep environments/course-light.toml --vary environment.light.voxel=0.1:0.5:5 --statistic height,organs
  espalier sweep environments/course-light.toml --vary simulation.seed=1..100 --list > commands     for a cluster: docs/sweeps.md
  espalier sweep environments/course-light.toml --vary simulation.seed=1..100 --table)");
    }

    int run() override {
        std::error_code error;
        const fs::path what = model_.arguments().file;
        if (!fs::exists(what, error))
            throw UserError(fmt::format("cannot read {}: the file does not exist", what.string()));
        Sweep sweep(base(), variations(), folder());
        if (list_) {
            for (const study::SweepRun* run : sweep.folder().to_do()) print(sweep.command(*run));
            return exit_code::done;
        }
        if (table_) return make_table(sweep);
        sweep.agree_on_programs();
        require_statistics(sweep);
        const Sweep::Outcome outcome = sweep.run(jobs(), quiet_);
        if (outcome.interrupted) return exit_code::interrupted;
        show_results(sweep);
        if (outcome.failed > 0) throw RunError(fmt::format("{} runs failed", outcome.failed));
        return exit_code::done;
    }

private:
    int make_table(const Sweep& sweep) const {
        const std::vector<const study::SweepRun*> missing = sweep.folder().to_do();
        std::error_code unknown;
        if (fs::exists(folder(), unknown)) show_results(sweep);
        constexpr std::size_t most_named = 50;
        for (std::size_t i = 0; i < std::min(missing.size(), most_named); ++i) {
            fmt::print(stderr, "missing: {}: {}\n", missing[i]->variant.name, study::SweptFolder::state(*missing[i]));
        }
        if (missing.size() > most_named) fmt::print(stderr, "... and {} more\n", missing.size() - most_named);
        if (missing.empty()) return exit_code::done;
        throw RunError(fmt::format("{} of {} runs are missing", missing.size(), sweep.folder().runs().size()));
    }

    void show_results(const Sweep& sweep) const {
        const study::SweptFolder& runs = sweep.folder();
        runs.remove_old_complaints();
        const std::vector<study::SweepResult> results = runs.results();
        tell(runs.write_table(results));
        if (wants_plot() && !results.empty()) draw(runs.drawn(results));
    }

    void tell(const fs::path& file) const {
        if (!quiet_) fmt::print("{}\n", file.string());
    }
    // A name misspelt is told before the runs, which may take hours.
    void require_statistics(const Sweep& sweep) const {
        if (statistics_.empty()) return;
        const PlottedTable table{"", sweep.first_statistics(), {}};
        if (table.table.columns.empty()) return;
        for (const std::string& name : statistics_) picture::require_quantity({&table, 1}, name);
    }
    bool wants_plot() const { return !plot_.empty() || !statistics_.empty(); }
    void draw(const SweptRuns& runs) const {
        const fs::path path = plot_.empty() ? folder() / "sweep.png" : plot_;
        const ChartPage page = sweep_page(runs, statistics_, picture_.dark());
        write_picture(page, picture_.size(fitting_size(page)), path);
        tell(path);
    }

    // Those that a batch system or taskset leaves to this process.
    static int cores() { return std::max(1, tbb::this_task_arena::max_concurrency()); }
    int jobs() const { return jobs_ > 0 ? jobs_ : cores(); }

    RunArguments base() const {
        RunArguments arguments;
        arguments.model = model_.arguments();
        arguments.overrides = sets_.overrides();
        intervals_.add_to(arguments.overrides);
        arguments.checkpoint_every = intervals_.checkpoint_every();
        arguments.steps = growth_.steps();
        arguments.seed = growth_.seed();
        arguments.memory = growth_.memory();
        arguments.trust = growth_.trust();
        arguments.disk = disk_.bytes();
        arguments.quiet = quiet_;
        arguments.threads = threads_ > 0 ? threads_ : list_ ? 0 : std::max(1, cores() / jobs());
        return arguments;
    }

    std::vector<Variation> variations() const {
        std::vector<Variation> variations;
        for (const std::string& text : vary_) variations.push_back(parse_variation(text));
        return variations;
    }

    fs::path folder() const {
        if (!output_.empty()) return output_;
        const fs::path file = model_.arguments().file;
        const std::string name = (file.has_filename() ? file : file.parent_path()).stem().string();
        return fs::path("output") / (name + "-sweep");
    }

    static void print(const std::vector<std::string>& command) {
        std::vector<std::string> words;
        for (const std::string& word : command) words.push_back(quoted(word));
        fmt::print("{}\n", fmt::join(words, " "));
    }

    ModelOptions model_;
    SetOptions sets_;
    GrowthOptions growth_;
    IntervalOptions intervals_;
    DiskOption disk_;
    PictureOptions picture_;
    std::vector<std::string> vary_;
    fs::path output_, plot_;
    std::vector<std::string> statistics_;
    int jobs_ = 0, threads_ = 0;
    bool list_ = false, table_ = false, quiet_ = false;
};

const RegisteredCommand<SweepCommand> sweep_entry{16};

}  // namespace
}  // namespace espalier::app
