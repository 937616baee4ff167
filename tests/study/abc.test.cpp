// Approximate Bayesian computation against posteriors that are known in closed form.
#include "study/fit/abc.h"

#include "espalier/base/error.h"
#include "espalier/base/random.h"

#include "catch.h"
#include "study/fit/prior.h"

#include <array>
#include <cmath>
#include <limits>

using namespace espalier;
using namespace espalier::study;

namespace {

constexpr double noise = 0.5;

/// One unknown, whose normal score is `score`: two measures of it, one of them bent, and one that has nothing to do
/// with it.
std::vector<double> measures(double score, RandomSamples& samples) {
    const double first = score + noise * samples.normal(), second = score + noise * samples.normal();
    return {first, std::exp(second / 2), samples.normal()};
}

RandomSamples samples_of(std::uint64_t seed, std::uint64_t row) {
    return {RandomKey(seed, 0, Stream::process), row, 0};
}

SimulationTable simulated(std::size_t rows, std::uint64_t seed, const Proposal* proposal = nullptr) {
    SimulationTable table{1, 3, {}, {}, {}};
    for (std::size_t row = 0; row < rows; ++row) {
        RandomSamples samples = samples_of(seed, row);
        double score = samples.normal();
        if (proposal) score = proposal->draw(samples.uniform(), std::array{score}).front();
        const std::vector<double> values = measures(score, samples);
        table.scores.push_back(score);
        table.values.insert(table.values.end(), values.begin(), values.end());
        table.weights.push_back(proposal ? proposal->weight(std::array{score}) : 1);
    }
    return table;
}

double mean_of(const Posterior& posterior) {
    double mean = 0;
    for (std::size_t row = 0; row < posterior.size(); ++row) mean += posterior.weights[row] * posterior.scores[row];
    return mean;
}

double deviation_of(const Posterior& posterior) {
    double squares = 0;
    const double mean = mean_of(posterior);
    for (std::size_t row = 0; row < posterior.size(); ++row) {
        squares += posterior.weights[row] * (posterior.scores[row] - mean) * (posterior.scores[row] - mean);
    }
    return std::sqrt(squares);
}

// Two measures with variance v of a number whose prior is normal with variance 1 (Gelman et al. 2013, eq. 2.12).
const double exact_variance = 1 / (1 + 2 / (noise * noise));
double exact_mean(double first, double second) {
    return exact_variance * (first + second) / (noise * noise);
}

}  // namespace

TEST_CASE("the posterior of a normal mean is the exact one", "[fit]") {
    const SimulationTable table = simulated(20000, 7);
    for (const double place : {-1.0, 0.3, 1.6}) {
        const double first = place, second = place + 0.4;
        const Posterior posterior = posterior_of(table, std::array{first, std::exp(second / 2), 0.2});
        CHECK(mean_of(posterior) == Approx(exact_mean(first, second)).margin(0.1));
        CHECK(deviation_of(posterior) == Approx(std::sqrt(exact_variance)).epsilon(0.12));
    }
}

TEST_CASE("generations that are drawn where the last was accepted have the same posterior", "[fit]") {
    const std::array measured{1.9, std::exp(2.2 / 2), 0.0};
    Posterior posterior = posterior_of(simulated(3000, 3), measured);
    for (const std::uint64_t seed : {4, 5}) {
        const Proposal proposal(posterior);
        posterior = posterior_of(simulated(3000, seed, &proposal), measured);
    }
    CHECK(mean_of(posterior) == Approx(exact_mean(1.9, 2.2)).margin(0.1));
    CHECK(deviation_of(posterior) == Approx(std::sqrt(exact_variance)).epsilon(0.2));
}

TEST_CASE("weights of a proposal give the prior back", "[fit]") {
    const Posterior about{2, {0.5, -0.2, -0.3, 0.4, 0.1, 0.9}, {0.5, 0.3, 0.2}, {0, 1, 2}};
    const Proposal proposal(Posterior{2, {1.5, -1, -1.5, 1, 0.2, 2}, {0.5, 0.3, 0.2}, {0, 1, 2}});
    double sum = 0, mean = 0, square = 0, product = 0;
    constexpr std::size_t count = 40000;
    for (std::size_t row = 0; row < count; ++row) {
        RandomSamples samples = samples_of(11, row);
        const double share = samples.uniform(), one = samples.normal(), other = samples.normal();
        const std::vector<double> scores = proposal.draw(share, std::array{one, other});
        const double weight = proposal.weight(scores);
        sum += weight;
        mean += weight * scores[0];
        square += weight * scores[1] * scores[1];
        product += weight * scores[0] * scores[1];
    }
    CHECK(mean / sum == Approx(0).margin(0.05));
    CHECK(square / sum == Approx(1).margin(0.1));
    CHECK(product / sum == Approx(0).margin(0.1));
    CHECK(about.size() == 3);
}

// Talts, Betancourt, Simpson, Vehtari & Gelman (2018): over draws from the prior, the rank of the truth among the
// posterior is uniform.
TEST_CASE("ranks of the truth are uniform, and intervals hold it as often as they say", "[fit]") {
    const SimulationTable table = simulated(6000, 21);
    constexpr std::size_t repetitions = 200, bins = 10;
    std::array<double, bins> counts{};
    std::size_t covered = 0;
    for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
        RandomSamples samples = samples_of(22, repetition);
        const double truth = samples.normal();
        const Posterior posterior = posterior_of(table, measures(truth, samples), {0.03, 150});
        double below = 0;
        for (std::size_t row = 0; row < posterior.size(); ++row) {
            below += posterior.scores[row] < truth ? posterior.weights[row] : 0;
        }
        counts[std::min(bins - 1, static_cast<std::size_t>(below * bins))] += 1;
        covered += below > 0.05 && below < 0.95;
    }
    double chi_square = 0;
    for (const double count : counts) chi_square += std::pow(count - repetitions / bins, 2) / (repetitions / bins);
    CHECK(chi_square < 21.67);  // 1 % of nine degrees of freedom
    CHECK(covered >= 170);
    CHECK(covered <= 190);
}

TEST_CASE("two unknowns of which only the sum is measured cannot be told apart", "[fit]") {
    SimulationTable table{2, 1, {}, {}, {}};
    for (std::size_t row = 0; row < 4000; ++row) {
        RandomSamples samples = samples_of(31, row);
        const double one = samples.normal(), other = samples.normal();
        table.scores.insert(table.scores.end(), {one, other});
        table.values.push_back(one + other + 0.05 * samples.normal());
        table.weights.push_back(1);
    }
    const Posterior posterior = posterior_of(table, std::array{0.7});
    CHECK(correlation(posterior, 0, 1) < -0.98);
}

TEST_CASE("simulations that failed are left out, and too few are refused", "[fit]") {
    SimulationTable table = simulated(2000, 41);
    const Posterior whole = posterior_of(table, std::array{0.5, 1.3, 0.0});
    SimulationTable with_failures = table;
    for (std::size_t row = 0; row < 50; ++row) {
        with_failures.scores.push_back(5);
        with_failures.values.insert(with_failures.values.end(), {0.5, std::numeric_limits<double>::quiet_NaN(), 0.0});
        with_failures.weights.push_back(1);
    }
    CHECK(posterior_of(with_failures, std::array{0.5, 1.3, 0.0}).scores == whole.scores);
    CHECK_THROWS_AS(posterior_of(simulated(9, 1), std::array{0.5, 1.3, 0.0}), UserError);
}
