// fit: parameters of a model or a scene from measurements.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/base/stop.h"

#include "app/child.h"
#include "app/command.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_command.h"
#include "app/trust.h"
#include "base/folder.h"
#include "base/json_text.h"
#include "base/platform.h"
#include "living_line.h"
#include "part_option.h"
#include "picture_options.h"
#include "study/fit/fit.h"
#include "study/fit/unknowns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* by_simulation = "By simulation (--method abc)";

class Fit final : public Command {
public:
    explicit Fit(CLI::App& program)
        : Command(program, "fit", "find parameters of a model or a scene from measurements"),
          sets_(app()),
          growth_(app()),
          picture_(app()),
          part_(app(), "simulate", by_simulation) {
        app().add_option("what", file_, "a model, or a scene (.toml)")->required();
        app().add_option(
            "targets", targets_,
            "what was measured, one file or several: marks on a picture (.svg, .csv), traits or a course (.csv), "
            "points of a scanner (.ply, .xyz, .csv, .toml), measured plants; default: those of the scene's [fit]");
        app()
            .add_option("--parameter", parameters_,
                        "what is sought: a #define, or a key of the scene: NAME, NAME=START, NAME=LOW:HIGH, "
                        "NAME=log:LOW:HIGH, NAME=normal:MEAN:DEVIATION; may be repeated; default: every setting of the "
                        "model, or the scene's [fit.parameters]")
            ->allow_extra_args(false);
        app()
            .add_option("--define", defines_, "NAME=VALUE replaces a #define that is not fitted; may be repeated")
            ->allow_extra_args(false);
        app().add_option("--plant", plant_, "compare only this plant of the scene; default: all");
        app()
            .add_option("--method", method_, "least-squares: the best; abc: all that may have been")
            ->check(CLI::IsMember({"least-squares", "abc"}))
            ->capture_default_str();
        add_method_options();
        app().add_option("--output", output_, "folder for tables and charts; default with abc: output/<model>-fit");
        app().add_option("--overlay", overlay_,
                         "draw marks or points (red) and the fitted model (blue) into this .svg");
        app().add_flag("--quiet", quiet_, "print errors only");
        add_json_flag("print the result as JSON");
        app().footer(
            R"(Marks: draw each axis on a picture with a polyline of straight pieces, from its base to its tip, with a node at every
branching; the main axis first. An element with the attribute data-length="0.2" is a scale of 0.2 m; without one, only
ratios of lengths count. Traits: a table with a row for each plant. A course: a table with a column `step` or `time`.
docs/fitting.md shows each of them.
Examples:
  espalier fit models/trees/ternary.l marks.svg --parameter ANGLE --parameter RATIO=0.7
  espalier fit fern.l fern.svg --overlay fitted.svg
  espalier fit tree.l scan.ply --parameter ANGLE=10:60 --parameter RATIO=0.5:0.9
  espalier fit bush.l plants.csv --method abc --parameter ANGLE=10:60 --parameter RATE=log:0.01:1
  espalier fit stand.toml --method abc --generations 3 --output output/stand-fit
  espalier fit bush.l plants.csv --method abc --list 20 > commands        for a cluster: docs/fitting.md)");
    }

    int run() override {
        const study::FitTask task = task_of();
        if (task.growth.subject().is_scene()) ask_for_trust(task);
        if (part_.wants_list()) return print_commands();
        const InterruptibleRun interruptible(quiet_);
        LivingLine line(quiet_ || wants_json());
        const study::FitProgress progress = [&](const study::FitState& state) {
            line.show(state.done >= state.all, [&] { return told(task, state); });
        };
        std::optional<study::FitResult> result;
        try {
            result = wants_posterior() ? fit_posterior(task, abc_options(), progress)
                                       : fit_least_squares(task, squares_, progress);
        } catch (const Stopped&) {
            return exit_code::interrupted;
        }
        if (InterruptibleRun::interrupted()) return exit_code::interrupted;
        if (!result) return exit_code::done;  // a part
        write(task, *result);
        print(task, *result);
        return exit_code::done;
    }

private:
    void add_method_options() {
        const char* const abc = by_simulation;
        app()
            .add_option(
                "--worlds", squares_.worlds,
                "number of worlds in each comparison of least squares; default: that of the measured plants; 8 of "
                "a model with random numbers")
            ->check(CLI::Range(1, 100000));
        app()
            .add_option("--search", squares_.search,
                        "number of comparisons in the search of least squares over the whole ranges; default: 50 per "
                        "parameter")
            ->check(CLI::Range(1, 10000000));
        app()
            .add_option("--simulations", abc_.simulations, "number of simulations in each generation")
            ->check(CLI::Range(100, 100000000))
            ->capture_default_str()
            ->group(abc);
        app()
            .add_option("--generations", abc_.generations,
                        "number of generations; each is drawn where the one before was accepted")
            ->check(CLI::Range(1, 100))
            ->capture_default_str()
            ->group(abc);
        app()
            .add_option("--accept", abc_.accepted, "share of the simulations that are accepted")
            ->check(CLI::Range(1e-6, 1.0))
            ->capture_default_str()
            ->group(abc);
    }

    static std::string told(const study::FitTask& task, const study::FitState& state) {
        std::string text = fmt::format("{} {}/{}", state.doing, grouped(state.done), grouped(state.all));
        if (state.best.empty()) return text;
        text += fmt::format("   residual {:.3g}", state.residual);
        for (const auto& [name, value] : task.named(state.best)) text += fmt::format("  {} {:.4g}", name, value);
        return text;
    }

    bool wants_posterior() const { return method_ == "abc"; }

    study::FitTask task_of() const {
        study::Subject subject{file_, {}, growth_.steps(), growth_.seed(), plant_};
        if (!fs::exists(file_)) throw UserError(fmt::format("cannot read {}: the file does not exist", file_.string()));
        for (const std::string& text : defines_) subject.values.push_back(key_and_value(text, "--define"));
        for (const auto& pair : sets_.overrides()) subject.values.push_back(pair);
        study::FitTask task{study::Growth(subject), {}, {}};
        for (const std::string& text : parameters_) task.unknowns.push_back(study::unknown_of(text, subject));
        if (parameters_.empty()) task.unknowns = study::usual_unknowns(subject);
        const std::vector<fs::path> files = targets_.empty() ? study::usual_targets(subject) : targets_;
        if (files.empty()) throw UserError("name what was measured: marks, traits, a course or measured plants");
        for (const fs::path& file : files) {
            task.targets.push_back(study::read_target(file));
            for (const std::string& note : task.targets.back()->notes) {
                if (!quiet_) fmt::print(stderr, "{}: {}\n", file.string(), note);
            }
        }
        return task;
    }

    void ask_for_trust(const study::FitTask& task) const {
        RunArguments arguments;
        arguments.model.file = file_;
        arguments.overrides = task.growth.subject().values;
        require_trust(programs_of(arguments), growth_.trust());
    }

    fs::path folder() const {
        return output_.empty() ? fs::path("output") / (file_.stem().string() + "-fit") : output_;
    }

    study::AbcFitOptions abc_options() const {
        study::AbcFitOptions options = abc_;
        options.folder = folder() / "simulations";
        options.part = {part_.number(), part_.of()};
        return options;
    }

    int print_commands() const {
        for (int part = 1; part <= part_.parts(); ++part) {
            std::vector<std::string> words{quoted(platform::program_file().string()), "fit", quoted(file_.string())};
            for (const fs::path& target : targets_) words.push_back(quoted(target.string()));
            const auto add = [&](const char* option, const std::string& value) {
                words.insert(words.end(), {option, quoted(value)});
            };
            for (const std::string& text : parameters_) add("--parameter", text);
            for (const std::string& text : defines_) add("--define", text);
            for (const auto& [key, value] : sets_.overrides()) add("--set", key + "=" + value);
            if (growth_.steps()) add("--steps", std::to_string(*growth_.steps()));
            if (growth_.seed()) add("--seed", std::to_string(*growth_.seed()));
            if (!plant_.empty()) add("--plant", plant_);
            if (growth_.trust()) words.emplace_back("--trust");
            add("--simulations", std::to_string(abc_.simulations));
            add("--output", folder().string());
            add("--part", fmt::format("{}/{}", part, part_.parts()));
            fmt::print("{} --method abc --quiet\n", fmt::join(words, " "));
        }
        return exit_code::done;
    }

    void write(const study::FitTask& task, const study::FitResult& result) const {
        if (!overlay_.empty()) write_overlay(task, result);
        if (output_.empty() && !wants_posterior()) return;
        make_folder(folder());
        if (result.posterior) write_text(folder() / "posterior.csv", posterior_table(task, *result.posterior));
        write_text(folder() / "predictive.csv", predictive_table(result));
        write_text(folder() / "fit.json", json_text(json_of(task, result)) + "\n");
        const ChartPage page = page_of(task, result, file_.stem().string(), picture_.dark());
        if (!page.charts.empty()) write_picture(page, picture_.size(fitting_size(page)), folder() / "fit.png");
    }

    void write_overlay(const study::FitTask& task, const study::FitResult& result) const {
        const std::vector<double> values = result.values();
        const auto grown = task.growth.grow(task.growth.scene(task.named(values)), 0, task.needs());
        for (const auto& target : task.targets) {
            const std::string overlay = grown ? target->overlay(*grown) : "";
            if (!overlay.empty()) return write_text(overlay_, overlay);
        }
        throw UserError("--overlay: no target is marks on a picture, or points");
    }

    std::string command(const study::FitTask& task, const study::FitResult& result) const {
        const std::vector<double> values = result.values();
        std::string line = "espalier run " + quoted(file_.string());
        for (const std::string& word : task.growth.options(task.named(values))) line += " " + quoted(word);
        return line;
    }

    nlohmann::ordered_json json_of(const study::FitTask& task, const study::FitResult& result) const {
        nlohmann::ordered_json json = {{"method", method_},
                                       {"residual", result.residual},
                                       {"worlds", result.evaluations},
                                       {"command", command(task, result)}};
        for (const study::FittedParameter& one : result.parameters) {
            auto& parameter = json["parameters"][one.name] = {{"value", one.value}, {"error", one.error}};
            if (result.posterior) parameter["low"] = one.low, parameter["high"] = one.high;
            parameter["decided"] = one.is_decided;
        }
        for (const study::Inseparable& pair : result.inseparable) {
            json["inseparable"].push_back(
                {{"parameters", {result.parameters[pair.one].name, result.parameters[pair.other].name}},
                 {"correlation", pair.correlation}});
        }
        for (const study::Prediction& one : result.predictions) {
            json["predictions"][one.measured.name] = {
                {"measured", one.measured.value}, {"predicted", one.middle}, {"low", one.low}, {"high", one.high}};
        }
        return json;
    }

    void print(const study::FitTask& task, const study::FitResult& result) const {
        if (wants_json()) return fmt::print("{}\n", json_text(json_of(task, result)));
        if (quiet_) return;
        for (std::size_t k = 0; k < result.parameters.size(); ++k) {
            print(task.unknowns[k], result.parameters[k], result.posterior.has_value());
        }
        for (const study::Inseparable& pair : result.inseparable) fmt::print("{}\n", result.in_words(pair));
        std::size_t outside = 0;
        for (const study::Prediction& one : result.predictions) {
            if (!result.posterior || (one.measured.value >= one.low && one.measured.value <= one.high)) continue;
            if (++outside > 5) continue;
            fmt::print("{}: measured {:.5g}, but 90 % of what is predicted lies between {:.5g} and {:.5g}\n",
                       one.measured.name, one.measured.value, one.low, one.high);
        }
        if (outside > 5) fmt::print("... and {} more\n", outside - 5);
        fmt::print("residual {:.3g} of the scales of {} statistics; {} worlds grown\n", result.residual,
                   result.predictions.size(), grouped(result.evaluations));
        if (!output_.empty() || wants_posterior()) fmt::print("{}\n", (folder() / "fit.png").string());
        fmt::print("{}\n", command(task, result));
    }

    static void print(const study::Unknown& unknown, const study::FittedParameter& one, bool has_posterior) {
        if (has_posterior) {
            fmt::print("{:<16} {:.5g}   90 %: {:.5g} to {:.5g}   (before: {}){}\n", one.name, one.value, one.low,
                       one.high, unknown.prior->text(),
                       one.is_decided ? "" : "   what was measured does not decide it");
            return;
        }
        const bool is_flat = std::isnan(one.error);  // a small change moves nothing
        const char* const doubt = one.is_decided ? "" : "   what was measured does not decide it";
        const char* const remedy = is_flat ? "; --method abc tells its range" : "";
        fmt::print("{:<16} {:.5g} +- {:.2g}   (began at {:.5g}){}{}\n", one.name, one.value, one.error, unknown.start,
                   doubt, remedy);
    }

    SetOptions sets_;
    GrowthOptions growth_;
    PictureOptions picture_;
    fs::path file_, overlay_, output_;
    std::vector<fs::path> targets_;
    std::vector<std::string> parameters_, defines_;
    std::string plant_, method_ = "least-squares";
    study::LeastSquaresOptions squares_;
    study::AbcFitOptions abc_;
    PartOption part_;
    bool quiet_ = false;
};

const RegisteredCommand<Fit> fit_entry{45};

}  // namespace
}  // namespace espalier::app
