#include "environment/light/rays/lamp.h"

#include "catch.h"
#include "environment/light/lit_leaves.h"
#include "temporary_folder.h"

#include <glm/geometric.hpp>

using namespace espalier;
using namespace espalier::environment;

namespace {

using std::numbers::pi;

/// A lamp downwards whose light falls off as the cosine of the angle: Lambert's law.
const std::string cosine_file = [] {
    std::string file = "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 1000 1 37 1 1 2 0.1 0.1 0\n1 1 20\n";
    for (int i = 0; i <= 36; ++i) file += std::to_string(i * 2.5) + (i % 10 == 9 ? "\n" : " ");
    file += "\n0\n";
    for (int i = 0; i <= 36; ++i) file += std::to_string(1000 * std::cos(i * 2.5 * pi / 180)) + " ";
    return file;
}();

/// What level leaves absorb (umol m-2 s-1) below lamps, at places.
std::vector<double> light_below(const std::string& lamps, const std::vector<glm::dvec3>& places, double side) {
    Environment light = light_process("ray-light",
                                      "paths = 1500000\nresidual = 0.01\n"
                                      "bands.par = { leaf = [0, 0], soil = 0 }\n" +
                                          lamps);
    std::vector<Asked> asked;
    for (std::size_t i = 0; i < places.size(); ++i) {
        asked.push_back({places[i], {0, 0, 0}});
        asked.push_back({places[i], {0}});
    }
    AskingPlants plants;
    plants.add(asked);
    for (std::size_t i = 0; i < places.size(); ++i) {
        draw_square(plants.interpretation(0).geometry, std::uint32_t(2 * i + 1), places[i], {1, 0, 0}, {0, 0, 1}, side);
    }
    plants.exchange(light, 1);
    std::vector<double> rates;
    for (std::size_t i = 0; i < places.size(); ++i) rates.push_back(plants.parameters()[4 * i + 2]);
    return rates;
}

/// The mean of f(place) over a level rectangle, by the midpoints of 100 x 100 parts.
template <class Function>
double mean_over(const glm::dvec3& middle, double x, double z, const Function& f) {
    constexpr int parts = 100;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
        for (int k = 0; k < parts; ++k) {
            sum += f(middle + glm::dvec3(x * ((i + 0.5) / parts - 0.5), 0, z * ((k + 0.5) / parts - 0.5)));
        }
    }
    return sum / parts / parts;
}

/// What falls on a level square from a place above, where `intensity` is per steradian, by the cosine from straight
/// down: the inverse square of the distance, and the cosine.
template <class Intensity>
double fallen(const glm::dvec3& lamp, const glm::dvec3& middle, double side, const Intensity& intensity) {
    return mean_over(middle, side, side, [&](const glm::dvec3& place) {
        const glm::dvec3 way = lamp - place;
        const double cosine = way.y / glm::length(way);
        return intensity(cosine) * cosine / glm::dot(way, way);
    });
}

}  // namespace

TEST_CASE("below a point lamp light falls with the square of the distance and the cosine", "[ray-light]") {
    const std::vector<glm::dvec3> places = {{0, 1, 0}, {1.5, 0.5, 0}};
    const auto rates = light_below("lamps = [{ at = [0, 2, 0], photons = 400 }]\n", places, 0.5);
    const auto expected = [&](std::size_t i) {
        return fallen({0, 2, 0}, places[i], 0.5, [](double) { return 400 / (4 * pi); });
    };
    // The solid angle of a square below a place: 4 atan(a^2 / (h sqrt(2 a^2 + h^2))), a half of its side.
    CHECK(expected(0) == Approx(400 / pi * std::atan(0.0625 / std::sqrt(1.125)) / 0.25).epsilon(1e-4));
    CHECK(rates[0] == Approx(expected(0)).epsilon(0.005));
    CHECK(rates[1] == Approx(expected(1)).epsilon(0.01));
}

TEST_CASE("a spot lights its cone evenly per angle, and nothing else", "[ray-light]") {
    const std::vector<glm::dvec3> places = {{0, 1, 0}, {0.4, 1, 0.1}, {0.8, 1, 0}};
    const auto rates =
        light_below("lamps = [{ kind = \"spot\", angle = 30, at = [0, 2, 0], photons = 100 }]\n", places, 0.1);
    const double per_steradian = 100 / (2 * pi * (1 - std::cos(pi / 6)));
    for (const std::size_t i : {0, 1}) {
        const double expected = fallen({0, 2, 0}, places[i], 0.1, [&](double) { return per_steradian; });
        CHECK(rates[i] == Approx(expected).epsilon(0.005));
    }
    CHECK(rates[2] == 0);
}

TEST_CASE("a panel lights a leaf as the view factor of a rectangle says", "[ray-light]") {
    constexpr double side = 0.3;
    const auto rates = light_below("lamps = [{ kind = \"area\", size = [1, 0.6], at = [0, 1.5, 0], photons = 300 }]\n",
                                   {{0, 1, 0}}, side);
    // Howell, Siegel & Menguc 2010, B-4: four rectangles that meet above the place.
    const auto seen_from = [](const glm::dvec3& place) {
        double sum = 0;
        for (const double x : {0.5 - place.x, 0.5 + place.x}) {
            for (const double z : {0.3 - place.z, 0.3 + place.z}) {
                const double a = x / 0.5, b = z / 0.5, p = std::sqrt(1 + a * a), q = std::sqrt(1 + b * b);
                sum += (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * pi);
            }
        }
        return sum;
    };
    CHECK(rates[0] == Approx(300 / 0.6 * mean_over({0, 1, 0}, side, side, seen_from)).epsilon(0.005));
}

TEST_CASE("a lamp of a maker's file shines as the file says", "[ray-light]") {
    TemporaryFolder folder;
    const auto file = folder.write("lamp.ies", cosine_file);
    const std::vector<glm::dvec3> places = {{0, 1, 0}, {1, 1, 0}};
    const auto rates = light_below(
        "lamps = [{ kind = \"ies\", file = \"" + file.string() + "\", at = [0, 2, 0], photons = 200 }]\n", places, 0.3);
    for (const std::size_t i : {0, 1}) {
        const double expected = fallen({0, 2, 0}, places[i], 0.3, [](double cosine) { return 200 * cosine / pi; });
        CHECK(rates[i] == Approx(expected).epsilon(0.01));
    }
    const IntensityTable table = IntensityTable::read_ies(file);
    CHECK(table.per_steradian(0.6, 2) == Approx(std::cos(0.6) / pi).epsilon(2e-3));
    CHECK(table.per_steradian(2, 1) == 0);
}

namespace {

/// Level light alone, candela by angle round the axis: the numbers behind the first two lines of a file.
std::string level_file(const std::vector<double>& round, const std::vector<double>& candela) {
    std::string file =
        "IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 2 " + std::to_string(round.size()) + " 1 2 0 0 0\n1 1 9\n0 180\n";
    for (const double angle : round) file += std::to_string(angle) + " ";
    for (const double value : candela) file += "\n" + std::to_string(value) + " " + std::to_string(value);
    return file + "\n";
}

/// Of a file's lamp, candela at 90 degrees from the axis over the mean of the circle, every 5 degrees from 2.5.
std::vector<double> circle(const TemporaryFolder& folder, const std::string& file) {
    const IntensityTable table = IntensityTable::read_ies(folder.write("lamp.ies", file));
    std::vector<double> all;
    for (int k = 0; k < 72; ++k) all.push_back(4 * pi * table.per_steradian(pi / 2, (k + 0.5) * pi / 36));
    return all;
}

}  // namespace

TEST_CASE("a lamp of four equal quadrants shines to all sides, whether its circle is closed or not", "[ray-light]") {
    const TemporaryFolder folder;
    for (const std::vector<double>& round : {std::vector<double>{0, 90, 180, 270},
                                             {0, 90, 180, 270, 360},
                                             {0, 30, 60, 90, 120, 150, 180, 210, 240, 270, 300, 330},
                                             {0, 90},
                                             {0, 90, 180},
                                             {90, 180, 270},
                                             {0, 100, 190, 200, 280}}) {
        CAPTURE(round);
        for (const double share : circle(folder, level_file(round, std::vector<double>(round.size(), 40)))) {
            CHECK(share == Approx(1).epsilon(1e-9));
        }
    }
}

TEST_CASE("between the last angle of a whole circle and 360 the light goes to that of 0", "[ray-light]") {
    const TemporaryFolder folder;
    const auto open = circle(folder, level_file({0, 90, 180, 270}, {100, 200, 300, 400}));
    const auto closed = circle(folder, level_file({0, 90, 180, 270, 360}, {100, 200, 300, 400, 100}));
    for (int k = 0; k < 72; ++k) CHECK(open[std::size_t(k)] == Approx(closed[std::size_t(k)]));
    CHECK(open[54] / open[0] == Approx((400 - 300 * 2.5 / 90) / (100 + 100 * 2.5 / 90)));
}

TEST_CASE("a file from 90 to 270 degrees is mirrored in the plane of these", "[ray-light]") {
    const TemporaryFolder folder;
    const auto shares = circle(folder, level_file({90, 180, 270}, {100, 500, 200}));
    const auto degrees = [&](double at) { return shares[std::size_t(at / 5)]; };
    for (const double off : {2.5, 32.5, 87.5}) {
        CHECK(degrees(90 + off) == Approx(degrees(90 - off)));
        CHECK(degrees(270 - off) == Approx(degrees(off < 90 ? 270 + off : off)));
    }
    CHECK(degrees(177.5) / degrees(92.5) == Approx((500 - 400 * 2.5 / 90) / (100 + 400 * 2.5 / 90)));
    CHECK(degrees(2.5) / degrees(267.5) == Approx((500 - 400 * 2.5 / 90) / (200 + 300 * 2.5 / 90)));
}

TEST_CASE("angles that leave a wedge without light are refused, and what has no effect is named", "[ray-light]") {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::vector<double>& round) {
        const auto file = folder.write("lamp.ies", level_file(round, std::vector<double>(round.size(), 1)));
        return message_of([&] { IntensityTable::read_ies(file); });
    };
    CHECK(lacks(refusal({0, 45}), {"lamp.ies", "from 0 to 45 degrees", "wedge", "0, 90, 180"}) == "");
    CHECK(lacks(refusal({0, 60, 120}), {"from 0 to 120"}) == "");
    CHECK(lacks(refusal({0, 45, 90, 135, 180, 225}), {"from 0 to 225"}) == "");
    CHECK(lacks(refusal({90, 180}), {"from 90 to 180"}) == "");
    CHECK(lacks(refusal({0, 400}), {"from 0 to 400"}) == "");

    const auto warnings = [&](std::string text) {
        std::vector<Diagnostic> all;
        IntensityTable::read_ies(folder.write("lamp.ies", text), &all);
        return all;
    };
    const std::string plain = level_file({0, 90}, {1, 1});
    const std::string behind = plain.substr(plain.find("TILT=NONE") + 9);
    CHECK(warnings(plain).empty());
    CHECK(warnings("[MORE] no TILT=lamp.tlt here\n" + plain).empty());
    CHECK(warnings("TILT=INCLUDE\n1\n3\n0 90 180\n1 1 1" + behind).empty());
    const auto tilted = warnings("TILT=INCLUDE\n1\n3\n0 90 180\n1 0.9 0.8" + behind);
    REQUIRE(tilted.size() == 1);
    CHECK(lacks(tilted[0].message, {"factors of tilt are not used"}) == "");
    REQUIRE(warnings("TILT=lamp.tlt" + behind).size() == 1);
    REQUIRE(warnings(plain + "7 7\n").size() == 1);
    CHECK(warnings(plain + "\x1a").empty());
}

TEST_CASE("lamps have light of their own in each band, for so many hours of the day", "[ray-light]") {
    Environment light = light_process("ray-light",
                                      "paths = 400000\nlit_hours = 16\nbands.par = { leaf = [0.1, 0.1] }\n"
                                      "bands.nir = { leaf = [0.4, 0.4] }\n"
                                      "lamps = [{ at = [0, 2, 0], photons = 400, photons_nir = 50 }]\n");
    AskingPlants plants;
    plants.add({{{0, 0, 0}, {0, 0, 0, 0, 0, 0}}, {{0, 0, 0}, {0}}});
    draw_square(plants.interpretation(0).geometry, 1, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 0.2);
    plants.exchange(light, 1);
    const std::vector<double> answered = plants.parameters();
    CHECK(answered[1] == Approx(answered[2] * 0.04 * 16 * 3600 * 1e-6));
    CHECK(answered[5] / answered[2] == Approx(0.2 * 50 / (0.8 * 400)).epsilon(0.1));
    CHECK(statistic(light, "incoming") == Approx(400 / (4 * pi * 4) * 16 * 3600 * 1e-6));
    CHECK(std::abs(statistic(light, "closure")) < 1e-6);
    CHECK(std::abs(statistic(light, "closure.nir")) < 1e-6);
}

TEST_CASE("lamps and their files are refused in words", "[ray-light]") {
    TemporaryFolder folder;
    const auto refusal = [&](const std::string& text) {
        const auto file = folder.write("lamp.ies", text);
        return message_of([&] { IntensityTable::read_ies(file); });
    };
    CHECK(lacks(refusal("hello"), {"lamp.ies", "TILT="}) == "");
    CHECK(lacks(refusal(cosine_file.substr(0, 200)), {"lamp.ies", "ends before"}) == "");
    CHECK(lacks(refusal("TILT=NONE\n1 1 1 99999999 1 1 1 0 0 0 1 1 1\n"), {"number of vertical angles"}) == "");
    CHECK(lacks(refusal("TILT=NONE\n1 1 1 2 1 2 1 0 0 0 1 1 1\n0 90\n0\n1 1\n"), {"type C"}) == "");
    CHECK(lacks(refusal("TILT=NONE\n1 1 1 2 1 1 1 0 0 0 1 1 1\n90 0\n0\n1 1\n"), {"do not rise"}) == "");
    CHECK(lacks(refusal("TILT=NONE\n1 1 1 2 1 1 1 0 0 0 1 1 1\n0 90\n0\n0 0\n"), {"no light"}) == "");
    CHECK(lacks(refusal("TILT=NONE\n1 1 1 2 1 1 1 0 0 0 1 1 1\n0 90\n0\n0 nan\n"), {"'nan' is no number"}) == "");
    const auto message = [](const std::string& lines) {
        return message_of([&] { light_process("ray-light", lines); });
    };
    CHECK(lacks(message("lamps = [{ at = [0, 2, 0], photons = 0 }]\n"), {"without photons"}) == "");
    CHECK(
        lacks(message("lamps = [{ at = [0, 2, 0], photons = 5, kind = \"spot\", angle = 1 }]\nreference = [3, 0, 0]\n"),
              {"'reference'", "no lamp sends"}) == "");
}
