// fit: parameters of a model from lengths and angles that were marked on a picture of a plant.
#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/language/model_settings.h"
#include "espalier/simulation/world.h"

#include "analysis/least_squares.h"
#include "analysis/marked_plant.h"
#include "app/command.h"
#include "app/options.h"
#include "base/json_text.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// A #define of the model that is fitted.
struct Fitted {
    std::string name;
    FreeParameter range;
};

/// A parameter that the marks do not decide may run away: sizes of plants are refused beyond this.
constexpr std::size_t most_modules = 1'000'000;

class ModelFit {
public:
    ModelFit(fs::path model, Defines defines, std::optional<int> steps, std::optional<std::uint64_t> seed)
        : model_(std::move(model)), defines_(std::move(defines)), steps_(steps), seed_(seed) {}

    MarkedPlant grown(const std::vector<Fitted>& fitted, const std::vector<double>& values) const {
        Scene scene;
        Defines defines = defines_;
        for (std::size_t i = 0; i < fitted.size(); ++i) defines[fitted[i].name] = fmt::format("{:.17g}", values[i]);
        scene.plants.push_back(plant_of_file(model_, defines));
        scene.steps = steps_;
        scene.seed = seed_.value_or(0);
        World world(scene);
        world.start();
        while (!world.at_end() && world.modules() <= most_modules) world.step();
        MarkedPlant plant = analysis::seen_from_the_front(world.interpretation(0).geometry);
        if (plant.axes.empty()) {
            throw UserError(fmt::format("{} draws no internode after {} steps", model_.string(), world.steps_done()));
        }
        return plant;
    }

    /// A #define by its name, or NAME=START.
    Fitted parameter(const std::string& text) const {
        const std::size_t equals = text.find('=');
        Fitted fitted{text.substr(0, equals), {}};
        const ModelSettings settings = ModelSettings::read(model_, defines_);
        try {
            fitted.range.start = settings.value(equals == text.npos ? fitted.name : text.substr(equals + 1));
            if (equals != text.npos) (void)settings.value(fitted.name);
        } catch (const UserError& error) {
            throw UserError(fmt::format("--parameter {}: {}", text, error.what()));
        }
        for (const ModelSetting& setting : settings.list()) {
            if (setting.name != fitted.name) continue;
            fitted.range.lowest = setting.lowest;
            fitted.range.highest = setting.highest;
        }
        return fitted;
    }

private:
    fs::path model_;
    Defines defines_;
    std::optional<int> steps_;
    std::optional<std::uint64_t> seed_;
};

/// What marks and model have in common, each in its own measure: lengths by the mean marked length, angles in radians.
std::vector<double> residuals(const AxisMeasures& marked, const AxisMeasures& grown) {
    constexpr double degree = 3.14159265358979323846 / 180;
    std::vector<double> all;
    double mean = 0;
    for (const auto& [cell, length] : marked.lengths) mean += length / static_cast<double>(marked.lengths.size());
    const auto compare = [&](const auto& ours, const auto& theirs, double unit) {
        for (const auto& [cell, value] : ours) {
            const auto found = theirs.find(cell);
            all.push_back(((found == theirs.end() ? 0 : found->second) - value) *
                          unit);  // what is not there has no length
        }
    };
    compare(marked.lengths, grown.lengths, 1 / mean);
    compare(marked.angles, grown.angles, degree);
    return all;
}

class Fit final : public Command {
public:
    explicit Fit(CLI::App& program)
        : Command(program, "fit", "find parameters of a model from marks on a picture of a plant") {
        app().add_option("model", model_, "a model")->required();
        app()
            .add_option("marks", marks_, "axes marked on a picture (.svg), or their nodes (.csv: axis, x, y in metres)")
            ->required();
        app()
            .add_option("--parameter", parameters_,
                        "a #define that is fitted, or NAME=START; may be repeated; default: every setting of the model")
            ->allow_extra_args(false);
        app()
            .add_option("--define", defines_, "NAME=VALUE replaces a #define that is not fitted; may be repeated")
            ->allow_extra_args(false);
        app()
            .add_option("--steps", steps_, "number of derivation steps; default: that of the model")
            ->check(CLI::Range(0, 1000000));
        app().add_option("--seed", seed_, "seed of the model's random numbers; default: 0");
        app().add_option("--overlay", overlay_, "draw marks (red) and fitted model (blue) into this .svg");
        add_json_flag("print the result as JSON");
        app().footer(
            R"(Mark each axis on the picture with a polyline of straight pieces, from its base to its tip, with a node at every
branching; the main axis first. An element with the attribute data-length="0.2" is a scale of 0.2 m; without one, only
ratios of lengths count. Internode lengths and branching angles are compared by order and place along the axis, as seen
from the front, by least squares.
Examples:
  espalier fit models/trees/ternary.l marks.svg --parameter ANGLE --parameter RATIO=0.7
  espalier fit fern.l fern.svg --overlay fitted.svg)");
    }

    int run() override {
        Defines defines;
        for (const std::string& text : defines_) defines.insert(key_and_value(text, "--define"));
        const ModelFit model(model_, defines, steps_, seed_);
        const MarkedPlant marks = analysis::read_marked_plant(marks_);
        const std::vector<Fitted> fitted = chosen(model);
        std::vector<FreeParameter> ranges;
        for (const Fitted& one : fitted) ranges.push_back(one.range);
        const AxisMeasures marked = measures_of(marks, marks.has_scale);
        const LeastSquares fit = analysis::fit_least_squares(ranges, [&](const std::vector<double>& values) {
            return residuals(marked, measures_of(model.grown(fitted, values), marks.has_scale));
        });
        if (!overlay_.empty()) write_text(overlay_, overlay_of(marks, model.grown(fitted, fit.values)));
        print(marks, fitted, fit);
        return exit_code::done;
    }

private:
    std::vector<Fitted> chosen(const ModelFit& model) const {
        std::vector<std::string> names = parameters_;
        if (names.empty()) {
            const ModelSettings settings = ModelSettings::read(model_);
            for (const ModelSetting& setting : settings.list()) {
                if (!setting.whole) names.push_back(setting.name);
            }
        }
        if (names.empty()) {
            throw UserError(
                fmt::format("{} has no settings: name its #defines with --parameter NAME", model_.string()));
        }
        std::vector<Fitted> fitted;
        for (const std::string& name : names) fitted.push_back(model.parameter(name));
        return fitted;
    }

    void print(const MarkedPlant& marks, const std::vector<Fitted>& fitted, const LeastSquares& fit) const {
        if (wants_json()) {
            nlohmann::ordered_json json = {{"axes", marks.axes.size()}, {"residual", fit.residual}};
            for (std::size_t i = 0; i < fitted.size(); ++i) {
                json["parameters"][fitted[i].name] = {{"value", fit.values[i]}, {"error", fit.errors[i]}};
            }
            fmt::print("{}\n", json_text(json));
            return;
        }
        std::string define;
        for (std::size_t i = 0; i < fitted.size(); ++i) {
            const double start = fitted[i].range.start, value = fit.values[i], error = fit.errors[i];
            const bool decided = error < 10 * std::max(std::abs(value), std::abs(start));
            fmt::print("{:<16} {:.5g} +- {:.2g}   (began at {:.5g}){}\n", fitted[i].name, value, error, start,
                       decided ? "" : "   the marks do not decide it");
            define += fmt::format(" --define {}={:.6g}", fitted[i].name, fit.values[i]);
        }
        fmt::print("residual         {:.2g} of an internode's length, or radians; {} plants grown\n", fit.residual,
                   fit.evaluations);
        fmt::print("espalier run {}{}\n", model_.string(), define);
    }

    fs::path model_, marks_, overlay_;
    std::vector<std::string> parameters_, defines_;
    std::optional<int> steps_;
    std::optional<std::uint64_t> seed_;
};

const RegisteredCommand<Fit> fit_entry{45};

}  // namespace
}  // namespace espalier::app
