#include "environment/light/rays/lamp.h"

#include "espalier/base/math.h"

#include "environment/light/rays/ies_file.h"
#include "geometry/vectors.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace espalier::environment {
namespace {

using std::numbers::pi;

/// A direction at a cosine from the axis.
glm::dvec3 about(const Lamp& lamp, double cosine, double round) {
    const auto [sine_round, cosine_round] = math::sine_and_cosine(round);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return cosine * lamp.axis + sine * (cosine_round * lamp.x + sine_round * lamp.y);
}

Lamp read_lamp(const Settings& table, const std::vector<LightBand>& bands, std::vector<Diagnostic>* warnings) {
    Lamp lamp;
    const std::string kind = table.choice_or("kind", "point", {"point", "spot", "area", "ies"});
    lamp.place = table.vector("at");
    lamp.axis = unit_or(table.vector_or("towards", {0, -1, 0}), glm::dvec3(0));
    if (lamp.axis == glm::dvec3(0))
        throw UserError(table.place("towards"), "'towards' must not be the vector of zeros");
    const glm::dvec3 side = table.vector_or("side", any_across(lamp.axis));
    lamp.x = unit_or(side - glm::dot(side, lamp.axis) * lamp.axis, glm::dvec3(0));
    if (lamp.x == glm::dvec3(0)) throw UserError(table.place("side"), "'side' must not lie along 'towards'");
    lamp.y = glm::cross(lamp.axis, lamp.x);
    if (kind == "spot") {
        lamp.kind = Lamp::Kind::spot;
        lamp.cosine = math::cos(glm::radians(table.number("angle", Range{0, 180, true})));
    } else if (kind == "area") {
        lamp.kind = Lamp::Kind::area;
        const std::vector<double> size = table.numbers("size");
        if (size.size() != 2 || !(size[0] > 0 && size[1] > 0)) {
            throw UserError(table.place("size"), "'size' must be two lengths above 0");
        }
        lamp.size = {size[0], size[1]};
    } else if (kind == "ies") {
        lamp.kind = Lamp::Kind::ies;
        lamp.table = std::make_shared<IntensityTable>(IntensityTable::read_ies(table.path("file"), warnings));
    }
    double sum = 0;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const std::string key = b == 0 ? "photons" : "photons_" + bands[b].name;
        lamp.photons[b] =
            b == 0 ? table.number(key, Range::not_negative()) : table.number_or(key, 0, Range::not_negative());
        sum += lamp.photons[b];
    }
    if (!(sum > 0)) throw UserError(table.place("photons"), "a lamp without photons lights nothing");
    return lamp;
}

}  // namespace

template <class Intensity>
IntensityTable IntensityTable::of(const Intensity& intensity) {
    IntensityTable table;
    for (int i = 0; i < angles; ++i) {
        const double low = pi * i / angles, high = pi * (i + 1) / angles;
        const double solid_angle = 2 * pi / rounds * (math::cos(low) - math::cos(high));
        for (int k = 0; k < rounds; ++k) {
            table.shares_[static_cast<std::size_t>(i * rounds + k)] =
                solid_angle * intensity((low + high) / 2, 2 * pi * (k + 0.5) / rounds);
        }
    }
    table.add_up();
    return table;
}

void IntensityTable::add_up() {
    sums_.assign(1, 0);
    for (const double share : shares_) sums_.push_back(sums_.back() + share);
    for (double& share : shares_) share /= sums_.back();
    const double all = sums_.back();
    for (double& sum : sums_) sum /= all;
}

IntensityTable IntensityTable::read_ies(const std::filesystem::path& path, std::vector<Diagnostic>* warnings) {
    const IesFile file(path);
    const Place place{path.string(), 0, 0};
    for (const std::string& unused : file.unused()) {
        if (warnings) warnings->push_back({Diagnostic::Severity::warning, place, unused});
    }
    return of([&](double angle, double turn) { return file.intensity(glm::degrees(angle), glm::degrees(turn)); });
}

double IntensityTable::per_steradian(double angle, double round) const {
    const int i = std::clamp(static_cast<int>(angle / pi * angles), 0, angles - 1);
    const double turned = round / (2 * pi);
    const int k = std::clamp(static_cast<int>((turned - std::floor(turned)) * rounds), 0, rounds - 1);
    const double low = pi * i / angles, high = pi * (i + 1) / angles;
    const double solid_angle = 2 * pi / rounds * (math::cos(low) - math::cos(high));
    return shares_[static_cast<std::size_t>(i * rounds + k)] / solid_angle;
}

std::array<double, 2> IntensityTable::sample(double u, double v) const {
    const auto behind = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, u) - sums_.begin();
    const auto cell = static_cast<int>(behind) - 1;
    const double share = shares_[static_cast<std::size_t>(cell)];
    const double within = share > 0 ? std::clamp((u - sums_[static_cast<std::size_t>(cell)]) / share, 0.0, 1.0) : 0.5;
    const int i = cell / rounds, k = cell % rounds;
    const double low = math::cos(pi * i / angles), high = math::cos(pi * (i + 1) / angles);
    return {math::acos(std::clamp(low + within * (high - low), -1.0, 1.0)), 2 * pi * (k + v) / rounds};
}

Lamp::Ray Lamp::ray(const std::array<double, 4>& u) const {
    switch (kind) {
        case Kind::point:
            return {place, about(*this, 1 - 2 * u[0], 2 * pi * u[1])};
        case Kind::spot:
            return {place, about(*this, 1 - (1 - cosine) * u[0], 2 * pi * u[1])};
        case Kind::area:
            return {place_of_light(u[2], u[3]), about(*this, std::sqrt(1 - u[0]), 2 * pi * u[1])};
        case Kind::ies:
            break;
    }
    const auto [angle, round] = table->sample(u[0], u[1]);
    return {place, about(*this, math::cos(angle), round)};
}

glm::dvec3 Lamp::place_of_light(double u, double v) const {
    return place + (u - 0.5) * size[0] * x + (v - 0.5) * size[1] * y;
}

double Lamp::per_steradian(const glm::dvec3& direction) const {
    const double along = glm::dot(direction, axis);
    switch (kind) {
        case Kind::point:
            return 1 / (4 * pi);
        case Kind::spot:
            return along >= cosine ? 1 / (2 * pi * (1 - cosine)) : 0;
        case Kind::area:
            return std::max(0.0, along) / pi;
        case Kind::ies:
            break;
    }
    const double round = math::atan2(glm::dot(direction, y), glm::dot(direction, x));
    return table->per_steradian(math::acos(std::clamp(along, -1.0, 1.0)), round);
}

double Lamp::from_point(const glm::dvec3& source, const glm::dvec3& at) const {
    const glm::dvec3 way = at - source;
    const double distance = glm::length(way);
    if (!(distance > 0) || way.y >= 0) return 0;
    const glm::dvec3 direction = way / distance;
    return -direction.y / (distance * distance) * per_steradian(direction);
}

double Lamp::on_level_ground(const glm::dvec3& at) const {
    if (kind != Kind::area) return from_point(place, at);
    constexpr int parts = 16;
    double sum = 0;
    for (int i = 0; i < parts * parts; ++i) {
        sum += from_point(place_of_light((i % parts + 0.5) / parts, (i / parts + 0.5) / parts), at);
    }
    return sum / (parts * parts);
}

std::vector<Lamp> read_lamps(const Settings& settings, const std::vector<LightBand>& bands,
                             std::vector<Diagnostic>* warnings) {
    std::vector<Lamp> lamps;
    for (const Settings& table : settings.tables("lamps")) lamps.push_back(read_lamp(table, bands, warnings));
    return lamps;
}

const std::string& lamps_help() {
    static const std::string text =
        R"(lamps         [[lamps]] tables. With lamps and no table `sky` there is no daylight; light is then compared with that of
              the lamps on level ground at `reference`
  kind        "point", the same to all sides; "spot", the same within `angle` degrees of its axis; "area", a rectangle
              of `size` that shines as Lambert's law says; "ies", a point that shines as the `file` of its maker says (IES
              LM-63, type C), whose lumens, watts and sizes have no effect
  at          [x, y, z] m: its place, the middle of an area
  towards     [0, -1, 0]: its axis;  side  where a file's angle 0 round the axis lies, and an area's first side
  photons     umol/s of the first band; photons_nir and so on for other bands, 0
lit_hours     24: hours of light in a day
reference     [0, 0, 0] m; place on level ground with whose light of the lamps organs are compared
)";
    return text;
}

}  // namespace espalier::environment
