// Parameters of models come back from plants that were grown with them.
#include "study/fit/fit.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "catch.h"
#include "study/fit/form.h"
#include "study/fit/unknowns.h"
#include "temporary_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace espalier;
using namespace espalier::study;

namespace {

/// A model, two of its parameters, and the traits that were measured.
struct Species {
    const char *name, *text;
    std::vector<std::pair<std::string, double>> truth;
    std::vector<std::string> ranges, traits;
    int steps;
};

const std::vector<Species> all_species{
    {"herb",
     "#define ANGLE 30\n#define RATIO 0.6\nlsystem: 1\nderivation length: 5\naxiom: A(0.2)\n"
     "A(l) --> F(l)[+(ANGLE)F(l*0.8)][-(ANGLE)F(l*0.8)]A(l*RATIO)\nendlsystem\n",
     {{"ANGLE", 52}, {"RATIO", 0.81}},
     {"ANGLE=10:80", "RATIO=0.4:1.1"},
     {"height", "length", "axis_angle.1"},
     5},
    {"bush",
     "#define P 0.5\n#define STEP 0.1\nlsystem: 1\nseed: 1\nderivation length: 7\naxiom: A\n"
     "A : * --> F(STEP)[+(40)A]/(137)A : P\nA : * --> F(STEP)/(137)A : 1-P\nendlsystem\n",
     {{"P", 0.35}, {"STEP", 0.07}},
     {"P=0.05:0.95", "STEP=0.02:0.3"},
     {"height", "length", "axes.1"},
     7},
    {"reed",
     "#define MEAN 0.1\n#define DEVIATION 0.02\nlsystem: 1\nderivation length: 12\naxiom: A\n"
     "A --> F(nran(MEAN,DEVIATION))/(90)[+(60)F(0.05)]A\nendlsystem\n",
     {{"MEAN", 0.16}, {"DEVIATION", 0.03}},
     {"MEAN=0.05:0.3", "DEVIATION=0.005:0.08"},
     {"height", "length"},
     12},
    {"shoot",
     "#define RATE 1.2\n#define DELAY 2\nlsystem: 1\nderivation length: 8\naxiom: A(0)\n"
     "A(t) : t >= DELAY --> F(0.02)[+(50)F(0.01)]A(t - DELAY + 1)\nA(t) --> A(t+1)\nF(l) --> F(l*RATE)\nendlsystem\n",
     {{"RATE", 1.35}, {"DELAY", 1.5}},
     {"RATE=1:1.6", "DELAY=1:4"},
     {"height", "axes.1", "axis_length.1"},
     8},
    {"root",
     "#define SPACING 0.05\n#define SLOPE 60\nlsystem: 1\nseed: 1\nderivation length: 9\naxiom: ^(180)R\n"
     "R --> F(SPACING*(0.7+ran(0.6)))/(137)[+(SLOPE+nran(0,5))L]R\nL --> F(0.03)L\nendlsystem\n",
     {{"SPACING", 0.03}, {"SLOPE", 75}},
     {"SPACING=0.01:0.1", "SLOPE=20:100"},
     {"depth", "length", "axis_angle.1"},
     9},
};

/// A table of `plants` plants of the true parameters, with seeds that no fit uses.
std::filesystem::path measured(const Species& species, const std::filesystem::path& folder, std::size_t plants) {
    const std::filesystem::path model = folder / fmt::format("{}.l", species.name);
    write_text(model, species.text);
    const Growth growth(Subject{model});
    const Scene scene = growth.scene(species.truth);
    std::string table = fmt::format("{}\n", fmt::join(species.traits, ","));
    for (std::size_t plant = 0; plant < plants; ++plant) {
        const auto grown = growth.grow(scene, 1'000'000 + plant, {true, false});
        REQUIRE(grown);
        const std::vector<double> form = forms_of(*grown).front();
        std::vector<std::string> row;
        for (const std::string& trait : species.traits) {
            const auto found = std::find(form_names().begin(), form_names().end(), trait) - form_names().begin();
            row.push_back(fmt::format("{:.17g}", form[static_cast<std::size_t>(found)]));
        }
        table += fmt::format("{}\n", fmt::join(row, ","));
    }
    write_text(folder / "traits.csv", table);
    return folder / "traits.csv";
}

FitTask task_of(const Species& species, const std::filesystem::path& folder, std::size_t plants) {
    const std::filesystem::path traits = measured(species, folder, plants);
    FitTask task{Growth(Subject{folder / fmt::format("{}.l", species.name)}), {}, {read_target(traits)}};
    for (const std::string& range : species.ranges) {
        task.unknowns.push_back(unknown_of(range, task.growth.subject()));
    }
    return task;
}

const auto no_progress = [](const FitState&) {};

double range_of(const Unknown& unknown) {
    return unknown.highest - unknown.lowest;
}

}  // namespace

TEST_CASE("posteriors of five models hold the truth, and many plants narrow them", "[fit]") {
    for (const Species& species : all_species) {
        std::vector<double> widths;
        for (const std::size_t plants : {1, 5, 20}) {
            INFO(species.name << ", " << plants << " plants");
            const TemporaryFolder folder;
            const FitTask task = task_of(species, folder.path(), plants);
            AbcFitOptions options;
            options.simulations = 300;
            options.generations = 2;
            options.folder = folder.path() / "simulations";
            const auto result = fit_posterior(task, options, no_progress);
            REQUIRE(result);
            double width = 0;
            for (std::size_t k = 0; k < species.truth.size(); ++k) {
                const FittedParameter& found = result->parameters[k];
                const double slack = 0.1 * (found.high - found.low) + 0.02 * range_of(task.unknowns[k]);
                CHECK(found.low - slack <= species.truth[k].second);
                CHECK(found.high + slack >= species.truth[k].second);
                width += (found.high - found.low) / range_of(task.unknowns[k]);
            }
            widths.push_back(width);
        }
        // Of a model without random numbers one plant says all.
        const bool is_random = std::string(species.text).find("ran(") != std::string::npos ||
                               std::string(species.text).find("seed") != std::string::npos;
        INFO(species.name);
        if (is_random) CHECK(widths[2] < widths[0]);
    }
}

TEST_CASE("least squares finds what five plants were grown with", "[fit]") {
    const TemporaryFolder folder;
    for (const Species& species : {all_species[0], all_species[1], all_species[3], all_species[4]}) {
        INFO(species.name);
        const FitTask task = task_of(species, folder.path(), 5);
        const FitResult result = fit_least_squares(task, {}, no_progress);
        for (std::size_t k = 0; k < species.truth.size(); ++k) {
            const double tolerance = species.name == std::string("herb") ? 0.005 : 0.12;
            CHECK(result.parameters[k].value ==
                  Approx(species.truth[k].second).margin(tolerance * range_of(task.unknowns[k])));
        }
    }
}

TEST_CASE("parts of a fit are simulated by several processes, and the whole is the same", "[fit]") {
    const TemporaryFolder folder;
    const FitTask task = task_of(all_species[1], folder.path(), 3);
    AbcFitOptions whole;
    whole.simulations = 400;
    whole.folder = folder.path() / "whole";
    const auto expected = fit_posterior(task, whole, no_progress);
    AbcFitOptions part = whole;
    part.folder = folder.path() / "parts";
    part.part = {1, 2};
    CHECK_FALSE(fit_posterior(task, part, no_progress));
    part.part = {0, 2};
    const auto found = fit_posterior(task, part, no_progress);
    REQUIRE(found);
    CHECK(posterior_table(task, *found->posterior) == posterior_table(task, *expected->posterior));
    CHECK(predictive_table(*found) == predictive_table(*expected));
    // Another fit does not take them for its own.
    FitTask other = task;
    other.unknowns.pop_back();
    CHECK_THROWS_AS(fit_posterior(other, part, no_progress), UserError);
}

TEST_CASE("simulations serve a fit again only where nothing that they depend on has changed", "[fit]") {
    const TemporaryFolder folder;
    FitTask task = task_of(all_species[1], folder.path(), 3);
    AbcFitOptions options;
    options.simulations = 200;
    options.generations = 2;
    const auto sample = [&](const char* name, double accepted) {
        options.folder = folder.path() / name;
        options.accepted = accepted;
        return posterior_table(task, *fit_posterior(task, options, no_progress)->posterior);
    };
    // Another share is accepted of the first generation: the second is drawn from elsewhere.
    const std::string first = sample("used", 0.3), other = sample("used", 0.6);
    CHECK(first != other);
    CHECK(other == sample("fresh", 0.6));
    CHECK(first == sample("used", 0.3));
    // So it is when other plants were measured.
    task.targets = {read_target(measured(all_species[1], folder.path(), 4))};
    CHECK_THROWS_AS(sample("used", 0.3), UserError);  // four worlds in place of three
    // What a model includes counts, too.
    write_text(folder.path() / "inner.h", "#define STEP 0.1\n");
    write_text(folder.path() / "outer.l",
               "#include \"inner.h\"\n#define ANGLE 30\nlsystem: 1\nderivation length: 2\naxiom: A\n"
               "A --> F(STEP)[+(ANGLE)F(STEP)]A\nendlsystem\n");
    write_text(folder.path() / "one.csv", "axis_angle.1\n41\n");
    const Growth outer(Subject{folder.path() / "outer.l"});
    task = {outer, {unknown_of("ANGLE=10:80", outer.subject())}, {read_target(folder.path() / "one.csv")}};
    const std::uint64_t before = task.digest();
    CHECK(task.digest() == before);
    write_text(folder.path() / "inner.h", "#define STEP 0.2\n");
    CHECK(task.digest() != before);
}

TEST_CASE("a growth that was followed gives its rate back", "[fit]") {
    const TemporaryFolder folder;
    const std::filesystem::path model = folder.path() / "shoot.l";
    write_text(model, all_species[3].text);
    const Growth growth(Subject{model, {{"DELAY", "1"}}});
    const auto grown =
        growth.grow(growth.scene(std::vector<std::pair<std::string, double>>{{"RATE", 1.31}}), 0, {false, true});
    const auto column = std::find(grown->columns.begin(), grown->columns.end(), "length") - grown->columns.begin();
    std::string course = "step,length,name\n";
    for (const std::size_t step : {2, 4, 7}) {
        course += fmt::format("{},{},a\n", step, grown->course[step][static_cast<std::size_t>(column)]);
    }
    write_text(folder.path() / "course.csv", course);
    FitTask task{growth, {unknown_of("RATE=1:1.6", growth.subject())}, {read_target(folder.path() / "course.csv")}};
    REQUIRE(task.targets[0]->notes.size() == 1);
    CHECK_THAT(task.targets[0]->notes[0], Catch::Contains("column 'name' is not used"));
    const FitResult result = fit_least_squares(task, {}, no_progress);
    CHECK(result.parameters[0].value == Approx(1.31).epsilon(1e-5));
    CHECK(result.residual < 1e-5);
}

TEST_CASE("what was measured has places beside a plant, its foot at 0", "[fit]") {
    const TemporaryFolder folder;
    write_text(folder.path() / "marks.csv", "axis,x,y\n0,3,1\n0,3,2\n0,3,4\n1,3,2\n1,4,2.5\n");
    const MeasuredPlaces marks = read_target(folder.path() / "marks.csv")->places();
    REQUIRE(marks.lines.size() == 2);
    CHECK(marks.has_scale);
    CHECK(marks.lines[0] == std::vector<glm::dvec3>{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}});
    CHECK(marks.lines[1].back() == glm::dvec3(1, 1.5, 0));

    const std::filesystem::path rsml = std::filesystem::path(ESPALIER_SOURCE_DIR) / "docs/marks/lupine.rsml";
    const MeasuredPlaces roots = read_target(rsml)->places();
    REQUIRE(roots.lines.size() > 5);
    CHECK(roots.points.empty());
    CHECK(roots.lines.front().front() == glm::dvec3(0));
    double lowest = 0;
    for (const auto& line : roots.lines) lowest = std::min(lowest, line.back().y);
    CHECK(lowest < -0.1);

    write_text(folder.path() / "course.csv", "time,height\n1,0.5\n2.5,\n3,0.9\n");
    const MeasuredCourse course = read_target(folder.path() / "course.csv")->course();
    CHECK_FALSE(course.is_by_step);
    REQUIRE(course.observations.size() == 2);
    CHECK(course.observations[1].at == 3);
    CHECK(course.observations[1].value == 0.9);
}

TEST_CASE("a search tells its best so far, which only gets better", "[fit]") {
    const TemporaryFolder folder;
    const FitTask task = task_of(all_species[0], folder.path(), 1);
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> best;
    const FitResult result = fit_least_squares(task, {}, [&](const FitState& state) {
        CHECK(state.residual <= least);
        least = state.residual;
        best.assign(state.best.begin(), state.best.end());
    });
    CHECK(result.residual == Approx(least).epsilon(1e-9));
    for (std::size_t k = 0; k < best.size(); ++k) CHECK(best[k] == Approx(result.values()[k]).epsilon(1e-6));
}

TEST_CASE("what cannot be told apart is said", "[fit]") {
    const TemporaryFolder folder;
    write_text(folder.path() / "stem.l",
               "#define A 1\n#define B 1\nlsystem: 1\nderivation length: 1\naxiom: X\nX --> "
               "F(A*B)[+F(0.1*A*B)]\nendlsystem\n");
    write_text(folder.path() / "traits.csv", "height,length\n0.6,0.67\n");
    FitTask task{Growth(Subject{folder.path() / "stem.l"}), {}, {read_target(folder.path() / "traits.csv")}};
    for (const char* range : {"A=log:0.1:3", "B=log:0.1:3"}) {
        task.unknowns.push_back(unknown_of(range, task.growth.subject()));
    }
    AbcFitOptions options;
    options.generations = 2;
    options.folder = folder.path() / "simulations";
    const auto posterior = fit_posterior(task, options, no_progress);
    REQUIRE(posterior->inseparable.size() == 1);
    CHECK(posterior->inseparable[0].correlation < -0.9);
}

TEST_CASE("what is no parameter and no measurement is refused with a remedy", "[fit]") {
    const TemporaryFolder folder;
    const std::filesystem::path model = folder.path() / "herb.l";
    write_text(model, all_species[0].text);
    const Subject subject{model};
    for (const char* text :
         {"ANGEL=10:60", "ANGLE=60:10", "ANGLE=log:-1:60", "ANGLE=normal:5:0", "ANGLE=1:2:3:4", "=3"}) {
        CHECK_THROWS_AS(unknown_of(text, subject), UserError);
    }
    write_text(folder.path() / "words.csv", "height,length\n1,long\n");
    CHECK_THROWS_AS(read_target(folder.path() / "words.csv"), UserError);
    write_text(folder.path() / "late.csv", "step,length\n90,1\n");
    write_text(folder.path() / "unknown.csv", "hieght\n1\n");
    for (const char* file : {"late.csv", "unknown.csv"}) {
        FitTask task{Growth(subject), {unknown_of("ANGLE=10:60", subject)}, {read_target(folder.path() / file)}};
        CHECK_THROWS_AS(fit_least_squares(task, {}, no_progress), UserError);
    }
}
