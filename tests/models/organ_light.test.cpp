#include "catch.h"
#include "environment/light/lit_leaves.h"
#include "environment/light/rays/lit_triangles.h"
#include "experiments/growth.h"

#include <glm/geometric.hpp>

#include <numeric>
#include <tuple>

using namespace espalier;
using namespace espalier::environment;

namespace {

/// Light that the modules of a plant absorb from one direction, by rays from a few places of each triangle against all
/// triangles of the plant, one by one.
class PlainLight {
public:
    PlainLight(const PlantGeometry& geometry, std::size_t modules, const glm::dvec3& towards)
        : towards_(towards), absorbed_(modules, 0) {
        const Optics optics(Settings::parse_toml("", "scene.toml"));
        triangles_.add(geometry, 0, 0, optics);
        corners_ = triangles_.parts(std::nullopt).front().corners;
        std::size_t triangle = 0;
        triangles_.visit_areas([&](const LitTriangles::Owner& owner, const glm::dvec3& area) {
            const double seen = std::abs(glm::dot(area, towards_)) / towards_.y;
            // The far half of a stem is behind its near half, which meets the ray first.
            absorbed_[owner.slot] += seen * share_lit(triangle++);
        });
    }
    const std::vector<double>& absorbed() const { return absorbed_; }
    std::size_t triangles() const { return corners_.size() / 3; }

private:
    static constexpr int parts = 6;

    double share_lit(std::size_t triangle) const {
        const glm::dvec3 a(corners_[3 * triangle]), b(corners_[3 * triangle + 1]), c(corners_[3 * triangle + 2]);
        int lit = 0;
        for (int i = 0; i < parts * parts; ++i) {  // middles of equal small triangles
            const int row = static_cast<int>(std::sqrt(i)), column = i - row * row;
            const double v = (row + (column % 2 == 0 ? 2.0 : 1.0) / 3) / parts;
            const double u = (column / 2 + (column % 2 == 0 ? 1.0 / 3 : 2.0 / 3)) / parts;
            lit += !is_met(a + (v - u) * (b - a) + u * (c - a), triangle);
        }
        return static_cast<double>(lit) / (parts * parts);
    }

    bool is_met(const glm::dvec3& from, std::size_t own) const {
        for (std::size_t k = 0; k < triangles(); ++k) {
            if (k == own) continue;
            const glm::dvec3 a(corners_[3 * k]), x = glm::dvec3(corners_[3 * k + 1]) - a,
                                                 y = glm::dvec3(corners_[3 * k + 2]) - a;
            const glm::dvec3 across = glm::cross(towards_, y), back = from - a;
            const double determinant = glm::dot(x, across);
            if (determinant == 0) continue;
            const double u = glm::dot(back, across) / determinant;
            const glm::dvec3 turned = glm::cross(back, x);
            const double v = glm::dot(towards_, turned) / determinant, t = glm::dot(y, turned) / determinant;
            // Of two in one place, as petals are, the first takes the light.
            if (u >= 0 && v >= 0 && u + v <= 1 && (t > 1e-6 || (t > -1e-6 && k < own))) return true;
        }
        return false;
    }

    glm::dvec3 towards_;
    std::vector<double> absorbed_;
    LitTriangles triangles_;
    std::span<const glm::vec3> corners_;
};

/// m2 of level ground whose light each module gets: 1e6 umol m-2 s-1 are 86400 mol/m2 in a day.
std::vector<double> absorbed_by(const char* process, const std::string& lines, const LonePlant& plant,
                                const glm::dvec3& sun = {0.5, 1, 0.3}) {
    EnvironmentContext context;
    context.plants = 1;
    Environment light = environment_of("[light]\nprocess = \"" + std::string(process) +
                                           "\"\nbands.par = { leaf = [0, 0], stem = 0, soil = 0 }\n"
                                           "sky = { par = 1e6, diffuse = 0, sun = [" +
                                           std::to_string(sun.x) + ", " + std::to_string(sun.y) + ", " +
                                           std::to_string(sun.z) + "] }\n" + lines,
                                       context);
    ModuleString string = plant.string;
    const std::vector<PlantView> views{{0, plant.model.get(), &string, &plant.interpretation}};
    std::vector<ModuleString*> strings{&string};
    light.exchange({1, 1, 1, views}, strings);
    std::vector<double> absorbed;
    const auto values = light.organ_values("light.absorbed", 0);
    for (const float value : *values) absorbed.push_back(value / 86400);
    return absorbed;
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("organs of five grown plants absorb what rays against all triangles count", "[ray-light][canopy-light]") {
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.5, 1, 0.3));
    for (const auto& [file, steps] : {std::pair{"models/herbs/lychnis.l", 24},
                                      {"models/herbs/crocus.l", 18},
                                      {"models/herbs/shepherds-purse.l", 24},
                                      {"models/herbs/monochasium.l", 14},
                                      {"models/leaves/fern.l", 14}}) {
        LonePlant plant(file);
        plant.grow(steps);
        const PlainLight plain(plant.interpretation.geometry, plant.string.size(), towards);
        const double all = sum(plain.absorbed());
        const std::vector<double> rays = absorbed_by("ray-light", "paths = 524288\nground = -10\n", plant);
        CAPTURE(file, plain.triangles());
        CHECK(sum(rays) == Approx(all).epsilon(0.015));
        double apart = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) apart += std::abs(rays[i] - plain.absorbed()[i]);
        CHECK(apart < 0.1 * all);
        const Box& bounds = plant.interpretation.geometry.bounds;
        const double voxel = glm::length(bounds.upper - bounds.lower) / 10;
        const std::vector<double> voxels =
            absorbed_by("canopy-light", "voxel = " + std::to_string(voxel) + "\n", plant);
        // Leaves that stand in order are not at random in their voxels.
        CHECK(sum(voxels) == Approx(all).epsilon(0.2));
    }
}

TEST_CASE("in low light ray-light keeps its error on single plants, and canopy-light does not",
          "[ray-light][canopy-light]") {
    const glm::dvec3 sun(0.1, 1, -1.5);
    for (const auto& [file, steps] : {std::pair{"models/herbs/crocus.l", 12}, {"models/leaves/fern.l", 12}}) {
        LonePlant plant(file);
        plant.grow(steps);
        const PlainLight plain(plant.interpretation.geometry, plant.string.size(), glm::normalize(sun));
        const double all = sum(plain.absorbed());
        CAPTURE(file);
        CHECK(sum(absorbed_by("ray-light", "paths = 524288\nground = -10\n", plant, sun)) ==
              Approx(all).epsilon(0.015));
        const Box& bounds = plant.interpretation.geometry.bounds;
        const double voxel = glm::length(bounds.upper - bounds.lower) / 10;
        const double voxels =
            sum(absorbed_by("canopy-light", "ground = -10\nvoxel = " + std::to_string(voxel) + "\n", plant, sun));
        CHECK(voxels == Approx(all).epsilon(0.3));
        CHECK(std::abs(voxels / all - 1) > 0.1);
    }
}

TEST_CASE("turned about the vertical together with the light, and moved, organs absorb the same",
          "[ray-light][canopy-light]") {
    LonePlant plant("models/herbs/lychnis.l");
    plant.grow(20);
    const Box& bounds = plant.interpretation.geometry.bounds;
    const std::string voxel =
        "beams = 4\nvoxel = " + std::to_string(glm::length(bounds.upper - bounds.lower) / 12) + "\n";
    const double turn = 0.7;
    const auto turned = [&](const glm::dvec3& v) {
        return glm::dvec3(std::cos(turn) * v.x + std::sin(turn) * v.z, v.y,
                          std::cos(turn) * v.z - std::sin(turn) * v.x);
    };
    const glm::dvec3 sun(0.5, 1, 0.3);
    const std::vector<std::tuple<const char*, std::string, double>> processes{
        {"ray-light", "ground = -10\npaths = 262144\n", 0.01}, {"canopy-light", "ground = -10\n" + voxel, 0.04}};
    std::vector<std::vector<double>> here;
    for (const auto& [process, lines, margin] : processes) here.push_back(absorbed_by(process, lines, plant, sun));

    Pose& pose = plant.turtle.pose;
    pose = {{0.3, 0.1, -0.2}, turned(pose.heading), turned(pose.left), turned(pose.up)};
    plant.interpretation = interpret(*plant.model, plant.string, plant.turtle, &plant.derivation);
    auto before = here.begin();
    for (const auto& [process, lines, margin] : processes) {
        const std::vector<double> there = absorbed_by(process, lines, plant, turned(sun));
        double apart = 0;
        for (std::size_t i = 0; i < there.size(); ++i) apart += std::abs((*before)[i] - there[i]);
        CAPTURE(process, sum(*before), sum(there), apart);
        CHECK(sum(there) == Approx(sum(*before)).epsilon(margin));
        CHECK(apart < 0.15 * sum(*before));
        ++before;
    }
}
