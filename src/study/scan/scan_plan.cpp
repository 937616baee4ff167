#include "study/scan/scan_plan.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace espalier::study {
namespace {

constexpr double most_beams = 200'000'000;

/// [low, high] of a key.
std::array<double, 2> range_of(const Settings& table, const char* key, double low, double high) {
    const std::vector<double> numbers = table.numbers_or(key, {low, high});
    if (numbers.size() == 2 && numbers[0] < numbers[1]) return {numbers[0], numbers[1]};
    throw UserError(table.place(key), fmt::format("{}: expected [low, high], degrees", key));
}

/// With the place of the key that asks for so many.
void require_few(const Settings& table, const char* key, double beams) {
    try {
        require_few_beams(beams);
    } catch (const UserError& error) {
        throw UserError(table.place(key), error.what());
    }
}

std::vector<Beam> tripod_beams(const Settings& table) {
    TripodScanner tripod;
    tripod.step = table.number_or("angle", tripod.step, Range::between(0.001, 30));
    const auto [low, high] = range_of(table, "elevations", tripod.lowest, tripod.highest);
    tripod.lowest = std::max(-90.0, low), tripod.highest = std::min(90.0, high);
    const auto [from, to] = range_of(table, "azimuths", tripod.first_azimuth, tripod.last_azimuth);
    tripod.first_azimuth = from, tripod.last_azimuth = std::min(to, from + 360);
    const std::vector<glm::dvec3> places = table.vectors("at");
    require_few(table, "at", static_cast<double>(places.size()) * tripod.expected_beams());
    std::vector<Beam> all;
    for (const glm::dvec3& place : places) {
        tripod.place = place;
        const std::vector<Beam> beams = tripod.beams();
        all.insert(all.end(), beams.begin(), beams.end());
    }
    return all;
}

std::vector<Beam> flying_beams(const Settings& table) {
    FlyingScanner flying;
    const std::vector<glm::dvec3> path = table.vectors("fly");
    if (path.size() != 2) throw UserError(table.place("fly"), "fly: expected two places, from where to where");
    flying.from = path[0], flying.to = path[1];
    if (std::min(flying.from.y, flying.to.y) <= 0) {
        throw UserError(table.place("fly"), "a scanner that flies is above height 0");
    }
    flying.density = table.number_or("pulses", flying.density, Range::between(1e-4, 1e6));
    flying.half_angle = table.number_or("swing", flying.half_angle, Range::between(0.01, 85));
    require_few(table, "fly", flying.expected_beams());
    return flying.beams();
}

std::vector<Beam> camera_beams(const Settings& table) {
    DepthCamera camera;
    camera.eye = table.vector("eye");
    camera.target = table.vector_or("target", {0, 1, 0});
    if (camera.eye == camera.target) throw UserError(table.place("target"), "eye and target are one place");
    camera.angle = table.number_or("field_of_view", camera.angle, Range::between(1, 170));
    const std::vector<double> size = table.numbers_or("size", {640, 480});
    if (size.size() != 2 || !(std::min(size[0], size[1]) >= 1) || !(std::max(size[0], size[1]) <= 8192)) {
        throw UserError(table.place("size"), "size: expected [width, height], 1 to 8192 pixels");
    }
    camera.width = static_cast<std::size_t>(size[0]), camera.height = static_cast<std::size_t>(size[1]);
    return camera.beams();
}

}  // namespace

void require_few_beams(double beams) {
    if (beams <= most_beams) return;
    throw UserError(fmt::format(
        "{:.3g} beams are more than {:.0f}: take a larger angle, fewer pulses or a smaller size", beams, most_beams));
}

ScanPlan read_scan(const Settings& table) {
    ScanPlan plan;
    const int instruments = table.has("at") + table.has("fly") + table.has("eye");
    if (instruments != 1) throw UserError(table.place(), "a scan needs one instrument: at, fly or eye");
    plan.beams = table.has("at") ? tripod_beams(table) : table.has("fly") ? flying_beams(table) : camera_beams(table);
    ScanOptions& options = plan.options;
    options.range = table.number_or("range", options.range, Range::between(0, 1e6));
    options.divergence = table.number_or("divergence", options.divergence, Range::between(0, 10));
    options.rays = static_cast<int>(table.integer_or("rays", options.rays, Range::between(1, 1000)));
    options.resolution = table.number_or("resolution", options.resolution, Range::between(0, 100));
    options.distance_noise = table.number_or("distance_noise", options.distance_noise, Range::between(0, 100));
    options.angle_noise = table.number_or("angle_noise", options.angle_noise, Range::between(0, 10));
    options.pulse_rate = table.number_or("pulse_rate", options.pulse_rate, Range::between(1, 1e9));
    plan.sides = static_cast<int>(table.integer_or("sides", plan.sides, Range::between(3, 64)));
    if (table.flag_or("bare", false)) {
        plan.ground.reset();
    } else {
        plan.ground = table.number_or("ground", 0);
    }
    plan.extension = "." + table.choice_or("format", "ply", {"ply", "csv", "xyz", "vtp"});
    plan.points.columns = table.texts_or("columns", {});
    plan.points.up = table.choice_or("up", "y", {"y", "z"})[0];
    try {
        require_point_file("points" + plan.extension, plan.points);
    } catch (const UserError& error) {
        throw UserError(table.place("columns"), error.what());
    }
    return plan;
}

}  // namespace espalier::study
