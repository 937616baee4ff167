// Phyllotaxis: where organs stand, and which Fibonacci numbers the eye counts.
#include "catch.h"
#include "experiments/growth.h"
#include "models/measure.h"

#include <set>

using namespace espalier;

namespace {

const std::set<int> fibonacci = {1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144};
constexpr double golden_angle = 137.50776405003785;

std::vector<glm::dvec3> positions_of(const LonePlant& plant) {
    std::vector<glm::dvec3> positions;
    for (const Organ& organ : plant.interpretation.geometry.organs) positions.push_back(organ.pose.position);
    return positions;
}

// How many numbers away the nearest organs of organ `i` are, nearest first.
std::vector<int> nearest_differences(const std::vector<glm::dvec3>& organs, std::size_t i, std::size_t count) {
    std::vector<std::pair<double, int>> others;
    for (std::size_t j = 0; j < organs.size(); ++j) {
        if (j != i) others.emplace_back(glm::distance(organs[i], organs[j]), std::abs(int(i) - int(j)));
    }
    std::sort(others.begin(), others.end());
    std::vector<int> differences;
    for (std::size_t k = 0; k < count; ++k) differences.push_back(others[k].second);
    return differences;
}

double smallest_distance(const std::vector<glm::dvec3>& organs, std::size_t from, std::size_t to) {
    double smallest = 1e9;
    for (std::size_t i = from; i < to; ++i) {
        for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, glm::distance(organs[i], organs[j]));
    }
    return smallest;
}

// Distances on the surface of a cylinder of radius 1 about the y axis.
double smallest_surface_distance(const std::vector<glm::dvec3>& organs) {
    double smallest = 1e9;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const glm::dvec3 a(organs[i].x, 0, organs[i].z), b(organs[j].x, 0, organs[j].z);
            const double arc = degrees_between(a, b) * std::numbers::pi / 180;
            smallest = std::min(smallest, std::hypot(arc, organs[i].y - organs[j].y));
        }
    }
    return smallest;
}

double azimuth_between(const glm::dvec3& a, const glm::dvec3& b) {
    return degrees_between({a.x, 0, a.z}, {b.x, 0, b.z});
}

}  // namespace

TEST_CASE("disc: organ n stands at n times the divergence and the root of n", "[phyllotaxis]") {
    LonePlant disc("models/phyllotaxis/disc.l", {{"ORGANS", "300"}});
    disc.grow(300);
    const std::vector<glm::dvec3> organs = positions_of(disc);
    REQUIRE(organs.size() == 300);
    for (std::size_t n = 0; n < organs.size(); ++n) {
        const double radius = 0.5 * std::sqrt(static_cast<double>(n));
        const double angle = 137.508 * static_cast<double>(n + 1) * std::numbers::pi / 180;
        CHECK(glm::distance(organs[n], glm::dvec3(-std::sin(angle), std::cos(angle), 0) * radius) < 1e-9);
    }
}

TEST_CASE("disc: at the golden angle neighbours are Fibonacci numbers apart and never near; beside it they crowd",
          "[phyllotaxis]") {
    LonePlant disc("models/phyllotaxis/disc.l", {{"ORGANS", "400"}});
    LonePlant beside("models/phyllotaxis/disc.l", {{"ORGANS", "400"}, {"DIVERGENCE", "137.3"}});
    disc.grow(400);
    beside.grow(400);
    const std::vector<glm::dvec3> organs = positions_of(disc);
    for (std::size_t i = 100; i < 300; ++i) {
        for (int difference : nearest_differences(organs, i, 3)) CHECK(fibonacci.count(difference) == 1);
    }
    const double smallest = smallest_distance(organs, 100, 400);
    CHECK(smallest > 0.75);
    CHECK(smallest_distance(positions_of(beside), 100, 400) < 0.85 * smallest);
}

TEST_CASE("sunflower-head: buds, florets and rays by number; rays look outwards", "[phyllotaxis]") {
    LonePlant head("models/phyllotaxis/sunflower-head.l");
    head.grow(534);
    const PlantGeometry& geometry = head.interpretation.geometry;
    CHECK(geometry.organs.size() == 500);
    CHECK(geometry.internodes.size() == 300);
    REQUIRE(geometry.polygons.size() == 34);
    for (const Polygon& polygon : geometry.polygons) {
        const glm::dvec3 base = geometry.vertices[polygon.first], tip = geometry.vertices[polygon.first + 2];
        CHECK(std::hypot(tip.x, tip.y) > std::hypot(base.x, base.y) + 1);
        CHECK(std::hypot(base.x, base.y) > 0.25 * std::sqrt(500) - 1e-9);
    }
}

TEST_CASE("zinnia: petals turn by the divergence, and lean out and lengthen from the middle to the rim",
          "[phyllotaxis]") {
    LonePlant head("models/phyllotaxis/zinnia.l");
    head.grow(150);
    const PlantGeometry& geometry = head.interpretation.geometry;
    REQUIRE(geometry.polygons.size() == 150);
    double length = 0, rise = 1;
    glm::dvec3 before(0);
    for (const Polygon& polygon : geometry.polygons) {
        const auto* vertices = &geometry.vertices[polygon.first];
        const glm::dvec3 petal = 0.5 * (vertices[3] + vertices[4]) - vertices[0];
        CHECK(glm::length(petal) > length);
        CHECK(petal.y / glm::length(petal) < rise + 1e-9);
        length = glm::length(petal);
        rise = petal.y / length;
        // The first petal stands in the middle, where there is no azimuth.
        const bool has_azimuth = std::hypot(before.x, before.z) > 1e-6;
        if (has_azimuth) CHECK(azimuth_between(before, vertices[0]) == Approx(137.508));
        before = vertices[0];
    }
}

TEST_CASE("ridley: heights are i A / (2 PI R), and only the golden angle keeps distance", "[phyllotaxis]") {
    const double area = 0.05, rise = area / (2 * std::numbers::pi);
    for (auto [divergence, published] :
         {std::pair{golden_angle, 0.957}, std::pair{golden_angle - 0.5, 0.78}, std::pair{golden_angle + 0.5, 0.65}}) {
        LonePlant plant("models/phyllotaxis/ridley.l", {{"DIVERGENCE", std::to_string(divergence)}, {"ORGANS", "300"}});
        plant.grow(300);
        const std::vector<glm::dvec3> organs = positions_of(plant);
        REQUIRE(organs.size() == 300);
        for (std::size_t i = 0; i < organs.size(); ++i) {
            CHECK(organs[i].y == Approx(static_cast<double>(i) * rise).margin(1e-12));
            CHECK(std::hypot(organs[i].x, organs[i].z) == Approx(1));
        }
        CHECK(smallest_surface_distance(organs) / std::sqrt(area) == Approx(published).margin(0.006));
    }
}

TEST_CASE("cylinder: one organ a step, and neighbours that are Fibonacci numbers apart", "[phyllotaxis]") {
    for (const char* rise : {"0.067", "0.2", "0.6"}) {
        LonePlant plant("models/phyllotaxis/cylinder.l", {{"H", rise}, {"RADIUS", "3"}});
        plant.grow(150);
        const PlantGeometry& geometry = plant.interpretation.geometry;
        REQUIRE(geometry.polygons.size() == 150);
        std::vector<glm::dvec3> organs;
        for (const Polygon& polygon : geometry.polygons) organs.push_back(geometry.vertices[polygon.first]);
        for (std::size_t i = 1; i < organs.size(); ++i) {
            CHECK(organs[i].y - organs[i - 1].y == Approx(std::stod(rise)));
            CHECK(azimuth_between(organs[i - 1], organs[i]) == Approx(137.5281));
        }
        for (int difference : nearest_differences(organs, 75, 4)) CHECK(fibonacci.count(difference) == 1);
    }
}

TEST_CASE("pineapple: the spirals through an organ at half height are 8 and 13", "[phyllotaxis]") {
    LonePlant fruit("models/phyllotaxis/pineapple.l");
    fruit.grow(175);
    const std::vector<glm::dvec3> scales = positions_of(fruit);
    REQUIRE(scales.size() == 130);
    std::set<int> found;
    for (int difference : nearest_differences(scales, 65, 4)) found.insert(difference);
    CHECK(found == std::set<int>{8, 13});
    CHECK(fruit.interpretation.geometry.polygons.size() == 130 + 45);
}

TEST_CASE("pineapple: its organs leave no hole", "[phyllotaxis]") {
    LonePlant fruit("models/phyllotaxis/pineapple.l");
    fruit.grow(175);
    const std::vector<Organ>& scales = fruit.interpretation.geometry.organs;
    double worst = 0;  // from a place on the fruit to the nearest scale, in its radii
    for (int level = 10; level <= 90; ++level) {
        const double part = level / 100.0, radius = 3.6 * std::sqrt(1 - 0.7 * std::pow(1.7 * part - 0.8, 2));
        for (int angle = 0; angle < 360; angle += 3) {
            const double turn = angle * std::numbers::pi / 180;
            const glm::dvec3 place(radius * std::cos(turn), 2 + 14 * part, radius * std::sin(turn));
            double nearest = INFINITY;
            for (const Organ& scale : scales) {
                if (scale.shape != Organ::Shape::sphere) continue;
                nearest = std::min(nearest, glm::distance(place, scale.pose.position) / (scale.size.x / 2));
            }
            worst = std::max(worst, nearest);
        }
    }
    CHECK(worst < 1);
}

TEST_CASE("cone: scales shrink towards the tip, and have area by their size", "[phyllotaxis]") {
    LonePlant cone("models/phyllotaxis/cone.l", {{"SIZE", "0.55"}, {"LENGTH", "0.07"}});
    cone.grow(300);
    const auto sizes = values_of(cone.string, cone.model->alphabet, "K");
    REQUIRE(sizes.size() > 60);
    const std::size_t widest = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    for (std::size_t i = widest + 1; i < sizes.size(); ++i) CHECK(sizes[i] < sizes[i - 1]);
    const PlantGeometry& geometry = cone.interpretation.geometry;
    for (std::size_t i = 1; i < sizes.size(); ++i) {
        const double climb =
            geometry.vertices[geometry.polygons[i].first].y - geometry.vertices[geometry.polygons[i - 1].first].y;
        const double radius = sizes[i - 1] / 0.55;
        CHECK(climb * 2 * std::numbers::pi * radius == Approx(sizes[i - 1] * sizes[i - 1]));
    }
}

TEST_CASE("rose: one petal a step, the older the more open and the larger", "[phyllotaxis]") {
    LonePlant rose("models/phyllotaxis/rose.l", {{"PETALS", "34"}, {"GROWN", "26"}});
    rose.grow(20);
    const std::vector<double> ages = values_of(rose.string, rose.model->alphabet, "P");
    REQUIRE(ages.size() == 20);
    for (std::size_t i = 0; i < ages.size(); ++i) CHECK(ages[i] == 19 - static_cast<double>(i));
    const PlantGeometry& geometry = rose.interpretation.geometry;
    double size = 1e9;
    for (const Polygon& polygon : geometry.polygons) {
        const double length = glm::distance(geometry.vertices[polygon.first], geometry.vertices[polygon.first + 2]);
        CHECK(length < size);
        size = length;
    }
    rose.grow(60);
    for (double age : values_of(rose.string, rose.model->alphabet, "P")) CHECK(age == 26);
}

namespace {

// Organs of collision.l, which is grown until its receptacle is full.
struct Receptacle {
    std::vector<glm::dvec3> places;
    std::vector<double> radii, azimuths, parts;

    explicit Receptacle(const std::string& shape)
        : plant_(read_view_file(source_path("models/phyllotaxis/gourd.v")), "models/phyllotaxis/collision.l",
                 {{"SHAPE", shape}, {"MOST", "300"}}) {
        plant_.grow(300);
        for (const Organ& organ : plant_.interpretation.geometry.organs) {
            if (organ.shape != Organ::Shape::sphere) continue;
            places.push_back(organ.pose.position);
            radii.push_back(organ.size.x / 2);
        }
        azimuths = values_of(plant_.string, plant_.model->alphabet, "O", 0);
        parts = values_of(plant_.string, plant_.model->alphabet, "O", 1);
    }

    // Distance of two surfaces, in radii of the organ i.
    double gap(std::size_t i, std::size_t j) const {
        return (glm::distance(places[i], places[j]) - radii[i] - radii[j]) / radii[i];
    }

private:
    LonePlant plant_;
};

}  // namespace

TEST_CASE("collision: no organs overlap, and each above the base touches an earlier one a Fibonacci number before",
          "[phyllotaxis]") {
    for (const char* shape : {"1", "2", "3", "4"}) {
        const Receptacle receptacle(shape);
        const std::size_t count = receptacle.places.size();
        REQUIRE(count > 80);
        REQUIRE(receptacle.azimuths.size() == count);
        std::size_t contacts = 0, fibonacci_contacts = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0) CHECK(receptacle.azimuths[i] - receptacle.azimuths[i - 1] == Approx(golden_angle));
            bool touches = receptacle.parts[i] == 0;
            for (std::size_t j = 0; j < i; ++j) {
                CHECK(receptacle.gap(i, j) > -1e-6);
                if (receptacle.gap(i, j) > 1e-6) continue;
                touches = true;
                ++contacts;
                fibonacci_contacts += fibonacci.count(static_cast<int>(i - j));
            }
            CHECK(touches);
        }
        INFO("shape " << shape << ": " << fibonacci_contacts << " of " << contacts);
        CHECK(static_cast<double>(fibonacci_contacts) > 0.9 * static_cast<double>(contacts));
    }
}

TEST_CASE("collision: the organs cover the receptacle up to its tip", "[phyllotaxis]") {
    const Receptacle cactus("1");
    CHECK(cactus.parts.back() > 0.9);
    double worst = 0;  // from a place on the cactus to the nearest surface of an organ, in its radii
    for (double part = 0.05; part <= 1; part += 0.05) {
        const double turn = part * std::numbers::pi / 2;
        for (int angle = 0; angle < 360; angle += 5) {
            const double azimuth = angle * std::numbers::pi / 180, radius = 3 * std::cos(turn);
            const glm::dvec3 place(radius * std::cos(azimuth), 5 * std::sin(turn), radius * std::sin(azimuth));
            double nearest = INFINITY;
            for (std::size_t i = 0; i < cactus.places.size(); ++i) {
                nearest = std::min(nearest, glm::distance(place, cactus.places[i]) / cactus.radii[i]);
            }
            worst = std::max(worst, nearest);
        }
    }
    CHECK(worst < 3);  // nowhere is there room for one more organ beside a gap
}

TEST_CASE("contact-pressure: from two rows the divergence comes to 137.5 +- 1 degrees as the rise falls",
          "[phyllotaxis]") {
    const auto check = [](double from, double to, double by, double margin) {
        for (double last = from; last <= to; last += by) {
            LonePlant stem("models/phyllotaxis/contact-pressure.l", {{"LAST", std::to_string(last)}});
            stem.grow(180);
            const std::vector<double> divergences = values_of(stem.string, stem.model->alphabet, "L");
            REQUIRE(divergences.size() == 180);
            for (std::size_t i = 1; i < 6; ++i) CHECK(divergences[i] == Approx(180).margin(0.01));
            INFO("LAST " << last);
            for (std::size_t i = 130; i < 180; ++i) CHECK(divergences[i] == Approx(137.5).margin(margin));
        }
    };
    check(0.005, 0.0801, 0.005, 1);
    check(0.083, 0.16, 0.011, 1.5);
    check(0.16, 0.2001, 0.01, 2);
}
