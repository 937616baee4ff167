#include "catch.h"
#include "environment/exchange/exchange_plants.h"
#include "environment/light/shade/sky_directions.h"

#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace espalier;
using namespace espalier::environment;

namespace {

const std::string zenith = "source_direction = [\"0 1 0\"]\ntransmittance = 0.25\n";
const std::string by_area = "estimate_intersection_area = true\n";

std::vector<double> answers_of_chiba(const std::string& lines, const std::vector<Asked>& questions) {
    Environment environment = environment_of("[light]\nprocess = \"chiba\"\n" + lines);
    AskingPlants plants;
    plants.add(questions).exchange(environment);
    return plants.parameters();
}

std::vector<Asked> crown(int count, double corner) {
    RandomSamples samples({1, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 place(samples.uniform(), samples.uniform(), samples.uniform());
        questions.push_back({corner + 10.0 * place, {0.4}});
    }
    return questions;
}

/// Balls of sizes from 0.01 to 3, some of them around others, one far away.
std::vector<Asked> mixed_crown(int count) {
    RandomSamples samples({5, 2, Stream::process}, 3, 4);
    std::vector<Asked> questions{{{1000, -200, 50}, {2}}};
    for (int i = 1; i < count; ++i) {
        const glm::dvec3 place(samples.uniform(), samples.uniform(), samples.uniform());
        questions.push_back({10.0 * place - 5.0, {0.01 * std::pow(300, samples.uniform())}});
    }
    return questions;
}

double lens(double a, double b, double d) {
    if (d >= a + b) return 0;
    if (d <= std::abs(a - b)) return std::numbers::pi * std::pow(std::min(a, b), 2);
    const auto segment = [](double r, double x) { return r * r * std::acos(x / r) - x * std::sqrt(r * r - x * x); };
    const double x = (d * d + a * a - b * b) / (2 * d);
    return segment(a, x) + segment(b, d - x);
}

/// Light by the formulae as they are written, every pair tested. By chords, only what lies in front of the ray's origin
/// counts.
std::vector<double> by_definition(const std::vector<Asked>& all, double t, bool areas) {
    std::vector<double> light;
    for (const Asked& one : all) {
        double sum = 0;
        for (const SkyDirection& sky : uniform_sky(128, 0.7)) {
            double part = sky.weight;
            for (const Asked& other : all) {
                if (&other == &one) continue;
                const glm::dvec3 between = other.position - one.position;
                const double ahead = glm::dot(between, sky.towards), r = one.parameters[0], R = other.parameters[0];
                const double d = glm::length(between - ahead * sky.towards);
                if (areas) {
                    if (ahead > 0) part *= 1 - (1 - t) * lens(r, R, d) / (std::numbers::pi * r * r);
                } else if (d < R) {
                    const double half = std::sqrt(R * R - d * d);
                    const double chord = std::max(ahead + half, 0.0) - std::max(ahead - half, 0.0);
                    part *= std::pow(t, chord / (2 * R));
                }
            }
            sum += part;
        }
        light.push_back(sum);
    }
    return light;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = a.size() == b.size() ? 0 : 1e9;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("a lone cluster has full light from everywhere", "[chiba]") {
    CHECK(answers_of_chiba("", {{{3, 4, 5}, {0.5}}})[0] == Approx(1).epsilon(1e-12));
    const std::vector<double> whole = answers_of_chiba("", {{{3, 4, 5}, {0.5, 9, 9, 9, 7}}});
    CHECK(whole[0] == Approx(1).epsilon(1e-12));
    CHECK(whole[2] == Approx(1).epsilon(1e-9));  // more from above than from below
    CHECK(whole[4] == 7);
}

TEST_CASE("under k clusters the light of the zenith is t^k, by chords and by areas", "[chiba]") {
    std::vector<Asked> stack;
    for (int k = 0; k < 5; ++k) stack.push_back({{1, -2.0 * k, 1}, {0.5}});
    for (const std::string& mode : {std::string(), by_area}) {
        const std::vector<double> light = answers_of_chiba(zenith + mode, stack);
        for (int k = 0; k < 5; ++k) CHECK(light[static_cast<std::size_t>(k)] == Approx(std::pow(0.25, k)));
    }
}

TEST_CASE("a cluster aside takes 1 - (1 - t) times the part of the disc it covers, or t^(chord / diameter)",
          "[chiba]") {
    const double third = 2 * std::numbers::pi / 3 - std::sqrt(3.0) / 2;  // lens of unit discs a radius apart
    const std::vector<Asked> pair{{{0, 0, 0}, {1}}, {{1, 5, 0}, {1}}};
    CHECK(answers_of_chiba(zenith + by_area, pair)[0] == Approx(1 - 0.75 * third / std::numbers::pi));
    CHECK(answers_of_chiba(zenith, {{{0, 0, 0}, {1}}, {{0.6, 5, 0}, {1}}})[0] == Approx(std::pow(0.25, 0.8)));
    CHECK(answers_of_chiba(zenith, pair)[0] == 1);
    CHECK(answers_of_chiba(zenith + "beam_radius = 0.25", pair)[0] == Approx(std::pow(0.25, 0.6)));
    const double quarter = answers_of_chiba(zenith + by_area, {{{0, 0, 0}, {1}}, {{0.2, 5, 0}, {0.5}}})[0];
    CHECK(quarter == Approx(1 - 0.75 / 4));
}

TEST_CASE("clusters behind dim nothing, and a radius of 0 is the default", "[chiba]") {
    CHECK(answers_of_chiba(zenith, {{{0, 0, 0}, {1}}, {{0, -5, 0}, {1}}})[0] == 1);
    CHECK(answers_of_chiba(zenith + "radius = 2", {{{0, 0, 0}, {0}}, {{1.9, 5, 0}, {0}}})[0] < 1);
    CHECK(answers_of_chiba(zenith + "radius = 2", {{{0, 0, 0}, {0}}, {{2.1, 5, 0}, {0}}})[0] == 1);
}

TEST_CASE("the brightest direction leads away from an occluder, and queries of two parameters are no clusters",
          "[chiba]") {
    const std::vector<double> light =
        answers_of_chiba("number_of_samples = 512", {{{0, 0, 0}, {1, 0, 0, 0}}, {{3, 0, 0}, {2}}, {{0, 1, 0}, {5, 6}}});
    CHECK(light[1] < -0.1);
    CHECK(std::abs(light[3]) < 1e-9);
    CHECK(std::hypot(light[1], light[2], light[3]) == Approx(1));
    CHECK(light[5] == 5);
    CHECK(light[6] == 6);
}

TEST_CASE("1000 clusters in a box have the mean light that testing every pair gives, wherever the box stands",
          "[chiba]") {
    const std::string lines = by_area + "transmittance = 0.25\ngrid_size = [32, 32, 32]";
    const std::vector<Asked> some = crown(150, 0);
    CHECK(largest_difference(answers_of_chiba(lines, some), by_definition(some, 0.25, true)) < 1e-12);
    const double at_origin = mean(answers_of_chiba(lines, crown(1000, 0)));
    CHECK(at_origin == Approx(0.318).margin(0.02));  // published for another draw of the thousand places
    CHECK(mean(answers_of_chiba(lines, crown(1000, -5))) == Approx(at_origin).epsilon(1e-9));
    CHECK(mean(answers_of_chiba(lines, crown(1000, 100))) == Approx(at_origin).epsilon(1e-9));
}

TEST_CASE("balls of all sizes, one around the other and far apart, dim as the formulae say", "[chiba]") {
    const std::vector<Asked> some = mixed_crown(200);
    CHECK(largest_difference(answers_of_chiba("transmittance = 0.25\n", some), by_definition(some, 0.25, false)) <
          1e-12);
    CHECK(largest_difference(answers_of_chiba("transmittance = 0.25\n" + by_area, some),
                             by_definition(some, 0.25, true)) <
          1e-9);  // lenses of a small disc and a large one are differences
    const std::vector<Asked> one_place(9, {{1, 2, 3}, {0.5}});
    CHECK(answers_of_chiba(zenith, one_place)[8] == Approx(std::pow(0.25, 8 * 0.5)));
    CHECK(answers_of_chiba(zenith + by_area, one_place)[8] == 1);  // no centre is in front
}

TEST_CASE("from within a ball light passes the leaves in front of it", "[chiba]") {
    const auto below = [](double height) {
        return answers_of_chiba(zenith, {{{0, 0, 0}, {0.1}}, {{0, height, 0}, {2}}})[0];
    };
    CHECK(below(2.5) == Approx(0.25));
    CHECK(below(1) == Approx(std::pow(0.25, 0.75)));
    CHECK(below(-1) == Approx(std::pow(0.25, 0.25)));
    CHECK(below(-2.5) == 1);
}

TEST_CASE("by chords, two balls that overlap have the light that cpfg's program answered", "[chiba]") {
    const std::vector<double> light = answers_of_chiba("source_direction = [\"0 1 0\"]\ntransmittance = 0.5\n",
                                                       {{{0, 0, 0}, {0.4}}, {{0, 0.3, 0}, {0.4}}});
    CHECK(light[0] == Approx(0.545254).margin(5e-7));
    CHECK(light[1] == Approx(0.917004).margin(5e-7));
}

TEST_CASE("light among clusters is the same bytes in any order of queries and on any number of threads", "[chiba]") {
    std::vector<Asked> questions = crown(400, -5);
    std::vector<double> light = answers_of_chiba("", questions);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(answers_of_chiba("", questions) == light);
    }
    std::reverse(questions.begin(), questions.end());
    std::reverse(light.begin(), light.end());
    CHECK(answers_of_chiba("", questions) == light);
}

TEST_CASE("a process that was asked before answers as a new one, whether clusters, transmittance or nothing changed",
          "[chiba]") {
    const auto asked_of = [](Environment& environment, const std::vector<Asked>& questions) {
        AskingPlants plants;
        plants.add(questions).exchange(environment);
        return plants.parameters();
    };
    Environment environment = environment_of("[light]\nprocess = \"chiba\"\n");
    std::vector<Asked> questions = crown(100, -5);
    const std::vector<double> before = asked_of(environment, questions);
    CHECK(asked_of(environment, questions) == before);
    std::reverse(questions.begin(), questions.end());
    CHECK(asked_of(environment, questions) == answers_of_chiba("", questions));
    questions[7].position.y += 0.1;
    CHECK(asked_of(environment, questions) == answers_of_chiba("", questions));
    questions[8].parameters[0] = 0.7;
    const std::vector<double> opaque = asked_of(environment, questions);
    CHECK(opaque == answers_of_chiba("", questions));
    for (const ChangingSetting& setting : environment.changing_settings(0)) {
        if (setting.key == "transmittance") setting.set(0.9);
    }
    const std::vector<double> thin = asked_of(environment, questions);
    CHECK(thin == answers_of_chiba("transmittance = 0.9\n", questions));
    CHECK(thin != opaque);
}

TEST_CASE("samples are the next 8 * 4^k; above and below share the light by their ratio", "[chiba]") {
    CHECK(uniform_sky(1, 0.7).size() == 8);
    CHECK(uniform_sky(9, 0.7).size() == 32);
    CHECK(uniform_sky(128, 0.7).size() == 128);
    for (const auto& sky : {uniform_sky(128, 0.5), chiba_overcast_sky(128, 0.5)}) {
        double above = 0, below = 0;
        for (const SkyDirection& direction : sky) {
            (direction.towards.y > 0 ? above : below) += direction.weight;
            CHECK(glm::length(direction.towards) == Approx(1));
        }
        CHECK(above == Approx(2.0 / 3));
        CHECK(below == Approx(1.0 / 3));
    }
}

TEST_CASE("sources share the light by their intensities", "[chiba]") {
    const std::string two = "source_direction = [\"0 2 0 3\", \"1 0 0\"]\ntransmittance = 0\n";
    const std::vector<Asked> roofed{{{0, 0, 0}, {1, 0, 0, 0}}, {{0, 5, 0}, {1}}};
    const std::vector<double> light = answers_of_chiba(two, roofed);
    CHECK(light[0] == Approx(0.25));
    CHECK(light[1] == Approx(1));
}

TEST_CASE("impossible lights are mistakes", "[chiba]") {
    const auto refused = [](const std::string& lines) { return message_of([&] { answers_of_chiba(lines, {}); }); };
    CHECK(lacks(refused("transmittance = 1.5"), {"transmittance", "between 0 and 1"}) == "");
    CHECK(lacks(refused("number_of_samples = 1e12"), {"number_of_samples"}) == "");
    CHECK(lacks(refused("source_direction = [\"0 0 0\"]"), {"direction that is not 0"}) == "");
    CHECK(lacks(refused("source_direction = [\"0 1\"]"), {"3 numbers"}) == "");
}
