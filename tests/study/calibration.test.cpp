// Simulation-based calibration on models (Talts, Betancourt, Simpson, Vehtari & Gelman 2018): of plants whose
// parameters were drawn from the priors, the rank of the truth in the posterior is uniform, and 90 % intervals hold it
// in nine of ten.
#include "espalier/base/random.h"

#include "catch.h"
#include "study/fit/fit.h"
#include "study/fit/unknowns.h"
#include "temporary_folder.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

using namespace espalier;
using namespace espalier::study;

namespace {

/// A small model, what is unknown of it, and the traits of one plant that are measured.
struct Calibrated {
    const char *name, *text, *traits;
    std::vector<std::string> unknowns;
};

const std::vector<Calibrated> calibrated{
    {"vine",
     "#define CHANCE 0.5\n#define LENGTH 0.1\nlsystem: 1\nseed: 1\nderivation length: 12\naxiom: A\n"
     "A --> F(LENGTH * (0.8 + ran(0.4)))[+(50)F(0.02)]/(137)A : CHANCE\n"
     "A --> F(LENGTH * (0.8 + ran(0.4)))/(137)A : 1 - CHANCE\nendlsystem\n",
     "height,length,axes.1\n1.2,1.5,6\n",
     {"CHANCE=0.05:0.95", "LENGTH=log:0.03:0.3"}},
    {"taproot",
     "#define SLOPE 60\n#define SPREAD 10\nlsystem: 1\nseed: 1\nderivation length: 10\naxiom: ^(180)R\n"
     "R --> F(0.05)/(137)[+(nran(SLOPE, SPREAD))F(0.1 + ran(0.02))]R\nendlsystem\n",
     "depth,width,axis_angle.1\n0.5,0.15,62\n",
     {"SLOPE=normal:60:12", "SPREAD=2:20"}},
};

constexpr std::size_t simulations = 3000, repetitions = 200, bins = 10;

}  // namespace

TEST_CASE("posteriors of models are calibrated: ranks are uniform, intervals hold the truth", "[fit][calibration]") {
    for (const Calibrated& one : calibrated) {
        const TemporaryFolder folder;
        const Subject subject{folder.write(fmt::format("{}.l", one.name), one.text)};
        FitTask task{Growth(subject), {}, {read_target(folder.write("traits.csv", one.traits))}};
        for (const std::string& unknown : one.unknowns) task.unknowns.push_back(unknown_of(unknown, subject));
        const Simulations made(task, folder.path() / "simulations", simulations);
        REQUIRE(made.make(0, nullptr, {}, [](std::size_t, std::size_t) {}));
        const SimulationTable table = made.read(0, nullptr);
        std::vector<std::array<double, bins>> counts(task.unknowns.size());
        std::vector<std::size_t> covered(task.unknowns.size(), 0);
        for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
            RandomSamples random(RandomKey(90210, 0, Stream::process), repetition, 0);
            std::vector<double> truth;
            for (std::size_t k = 0; k < task.unknowns.size(); ++k) truth.push_back(random.normal());
            // A world that no simulation grew.
            const std::vector<double> measured =
                task.simulated(values_of_scores(task.unknowns, truth), 1'000'000 + repetition, 1);
            const Posterior posterior = posterior_of(table, measured, {0.03, 90});
            for (std::size_t k = 0; k < truth.size(); ++k) {
                double below = 0;
                for (std::size_t row = 0; row < posterior.size(); ++row) {
                    below += posterior.scores_of(row)[k] < truth[k] ? posterior.weights[row] : 0;
                }
                counts[k][std::min(bins - 1, static_cast<std::size_t>(below * bins))] += 1;
                covered[k] += below > 0.05 && below < 0.95;
            }
        }
        for (std::size_t k = 0; k < task.unknowns.size(); ++k) {
            double chi_square = 0;
            for (const double count : counts[k]) {
                chi_square += std::pow(count - repetitions / bins, 2) / (repetitions / bins);
            }
            INFO(one.name << ", " << task.unknowns[k].name << ": chi-square " << chi_square << ", covered "
                          << covered[k]);
            CHECK(chi_square < 21.67);  // 1 % of nine degrees of freedom
            CHECK(covered[k] >= 170);
            CHECK(covered[k] <= 190);
        }
    }
}
