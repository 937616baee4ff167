// dataset: labelled plants in one command: grown with drawn values, scanned, drawn and described.
#include "espalier/base/error.h"
#include "espalier/base/stop.h"

#include "app/child.h"
#include "app/command.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_command.h"
#include "app/trust.h"
#include "base/json_text.h"
#include "base/platform.h"
#include "living_line.h"
#include "part_option.h"
#include "study/dataset/dataset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <chrono>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

class DatasetCommand final : public Command {
public:
    explicit DatasetCommand(CLI::App& program)
        : Command(program, "dataset", "grow many plants with drawn values, scan and draw them, and describe them"),
          part_(app(), "make") {
        app().add_option("file", file_, "the data set, a .toml file")->required();
        app().add_option("--output", output_, "folder of the data set; default: output/<file>");
        app()
            .add_option("--samples", samples_, "number of samples, in place of the file's")
            ->check(CLI::Range(std::size_t{1}, std::size_t{10'000'000}));
        app()
            .add_option("--seed", seed_, "seed of values, splits and growth, in place of the file's")
            ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{9'000'000'000'000'000}));
        app().add_flag("--trust", trust_, "start the programs that the scene names without asking");
        app().add_flag("--quiet", quiet_, "print errors only");
        add_json_flag("print the numbers of samples, points and pictures as JSON");
        app().footer(
            R"(The file says what grows, which values are drawn from which ranges, the instrument and the pictures.
A data set continues where it stopped, to the same bytes. The folder gets dataset.csv, a row for each plant, samples/,
and a card: README.md and card.json.
Examples:
  espalier dataset docs/examples/trees.toml
  espalier dataset docs/examples/trees.toml --samples 1000 --seed 7 --output output/thousand
  espalier dataset docs/examples/trees.toml --list 20 > commands          for a cluster
docs/datasets.md tells what the file may say, and shows how programs that learn read a data set.)");
    }

    int run() override {
        const study::Dataset dataset(plan(), folder());
        if (part_.wants_list()) return print_commands();
        agree_on_programs(dataset.plan());
        const InterruptibleRun interruptible(quiet_);
        try {
            make(dataset);
        } catch (const Stopped&) {
            return exit_code::interrupted;
        }
        const std::size_t missing = dataset.to_do({}).size();
        if (missing > 0) {  // a part
            if (!quiet_) fmt::print(stderr, "{} of {} samples are still missing\n", missing, dataset.samples().size());
            return exit_code::done;
        }
        print(dataset.write_card());
        return exit_code::done;
    }

private:
    study::DatasetPlan plan() const { return study::read_dataset(file_, {samples_, seed_}); }
    fs::path folder() const { return output_.empty() ? fs::path("output") / file_.stem() : output_; }

    void agree_on_programs(const study::DatasetPlan& plan) const {
        const study::Subject& subject = plan.growth.subject();
        const Scene scene = plan.growth.scene(plan.named(study::samples_of(plan).front().values));
        print_warnings(scene.notes.diagnostics, quiet_);
        if (!subject.is_scene()) return;
        RunArguments arguments;
        arguments.model.file = subject.file;
        arguments.overrides = subject.values;
        require_trust(programs_of(arguments), trust_);
    }

    int print_commands() const {
        for (int part = 1; part <= part_.parts(); ++part) {
            std::vector<std::string> words{quoted(platform::program_file().string()), "dataset", quoted(file_.string()),
                                           "--output", quoted(folder().string())};
            if (samples_) words.insert(words.end(), {"--samples", std::to_string(*samples_)});
            if (seed_) words.insert(words.end(), {"--seed", std::to_string(*seed_)});
            if (trust_) words.emplace_back("--trust");
            fmt::print("{} --part {}/{} --quiet\n", fmt::join(words, " "), part, part_.parts());
        }
        return exit_code::done;
    }

    void make(const study::Dataset& dataset) const {
        const auto start = std::chrono::steady_clock::now();
        LivingLine line(quiet_ || wants_json());
        dataset.make({part_.number(), part_.of()}, [&](std::size_t done, std::size_t all) {
            line.show(done >= all, [&] {
                const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
                const double left = passed.count() * static_cast<double>(all - done) / static_cast<double>(done);
                return fmt::format("sample {}/{}, {} left", done, all, duration_text(left));
            });
        });
    }

    void print(const study::Dataset::Summary& summary) const {
        if (wants_json()) {
            fmt::print("{}\n", json_text(nlohmann::ordered_json{{"folder", folder().string()},
                                                                {"samples", summary.samples},
                                                                {"failed", summary.failed},
                                                                {"points", summary.points},
                                                                {"pictures", summary.pictures}}));
            return;
        }
        if (quiet_) return;
        fmt::print("{}: {} samples, {} of which failed; {} points, {} pictures\n", (folder() / "README.md").string(),
                   grouped(summary.samples), grouped(summary.failed), grouped(summary.points),
                   grouped(summary.pictures));
    }

    fs::path file_, output_;
    std::optional<std::size_t> samples_;
    std::optional<std::uint64_t> seed_;
    PartOption part_;
    bool trust_ = false, quiet_ = false;
};

const RegisteredCommand<DatasetCommand> dataset_entry{46};

}  // namespace
}  // namespace espalier::app
