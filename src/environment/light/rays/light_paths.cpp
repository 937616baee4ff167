#include "environment/light/rays/light_paths.h"

#include "espalier/base/math.h"
#include "espalier/base/random.h"

#include "base/parallel.h"
#include "base/sobol.h"
#include "geometry/vectors.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

namespace espalier::environment {
namespace {

/// A direction of Lambert's law about a normal.
glm::dvec3 lambertian(const glm::dvec3& normal, double u, double v) {
    const glm::dvec3 x = any_across(normal), y = glm::cross(normal, x);
    const double across = std::sqrt(u), angle = 2 * std::numbers::pi * v;
    return across * math::cos(angle) * x + across * math::sin(angle) * y + std::sqrt(1 - u) * normal;
}

bool has_light(const LightPath& path) {
    return std::any_of(path.weights.begin(), path.weights.end(), [](double weight) { return weight > 0; });
}

using OpticsOfBands = std::array<SideOptics, most_bands>;

bool is_black(const OpticsOfBands& optics) {
    return std::none_of(optics.begin(), optics.end(),
                        [](const SideOptics& of) { return of.reflectance > 0 || of.transmittance > 0; });
}

/// What stays of a path's light where it meets something.
BandWeights kept_by(const OpticsOfBands& optics, const LightPath& path) {
    BandWeights kept{};
    for (std::size_t b = 0; b < most_bands; ++b) {
        kept[b] = path.weights[b] * (1 - optics[b].reflectance - optics[b].transmittance);
    }
    return kept;
}

/// Takes from a path what stays where it meets something, and returns that; what is transmitted goes to `through`, the
/// rest is reflected. Of much light a share stays; of little all or nothing, so that paths end and none of it is lost.
BandWeights divide(LightPath& path, LightPath& through, const OpticsOfBands& optics,
                   const std::array<double, 4>& sample) {
    BandWeights kept{};
    through.weights = {};
    for (std::size_t b = 0; b < most_bands; ++b) {
        const auto [reflected, transmitted] = optics[b];
        const double on = reflected + transmitted;
        double& light = path.weights[b];
        if (light > path.enough[b]) {
            kept[b] = (1 - on) * light;
        } else if (sample[3] >= on) {
            kept[b] = light;
        }
        light -= kept[b];
        if (sample[0] * on >= reflected) std::swap(light, through.weights[b]);
    }
    return kept;
}

constexpr double rays_per_path = 4, points_per_path = 64, starts_per_path = 2, few_paths = 4;

/// 0, 1/2, 1/4, 3/4, 1/8 ...
double radical_inverse(std::uint32_t i) {
    double inverse = 0, place = 0.5;
    for (; i > 0; i /= 2, place /= 2) inverse += i % 2 * place;
    return inverse;
}

double fraction(double x) {
    return x - std::floor(x);
}

std::size_t count_cells(std::span<const LightSensor> sensors) {
    std::size_t cells = 0;
    for (const LightSensor& sensor : sensors) cells += sensor.count();
    return cells;
}

}  // namespace

LightPaths::LightPaths(const Optics& optics, std::vector<LightSensor> sensors, Options options)
    : optics_(optics),
      sensors_(std::move(sensors)),
      options_(std::move(options)),
      space_(options_.ground, options_.period),
      tally_(bands(), count_cells(sensors_)) {
    for (std::size_t k = 0; k < sensors_.size(); ++k) first_cells_.push_back(count_cells({sensors_.data(), k}));
}

std::size_t LightPaths::set(const LitTriangles& triangles, std::size_t slots, const Daylight& light,
                            std::span<const Lamp> lamps, double lamp_seconds, std::span<const double> factors) {
    triangles_ = &triangles;
    slots_ = slots;
    lamps_ = lamps.size();
    double highest = -std::numeric_limits<double>::infinity();
    for (const Lamp& lamp : lamps) highest = std::max(highest, lamp.place.y + 1e-3);
    const std::size_t built = space_.set(triangles, sensors_, highest);
    sources_.set(light, lamps, lamp_seconds, factors, {space_.centre(), space_.radius(), space_.period()});
    if (options_.from_organs) rays_.set(triangles, slots, sources_);
    tally_.begin(slots, 1);
    return built;
}

void LightPaths::trace(std::uint32_t paths, std::uint32_t seed) {
    tally_.begin(slots_, paths);
    paths_ = paths;
    if (sources_.empty()) return;
    if (options_.from_organs) {
        rays_.share_out(rays_per_path * paths, sources_.light() / (points_per_path * paths));
        const bool all_are_sought = lamps_ == 0 || sources_.can_be_sought(SourceKind::lamp);
        rays_.find_small(all_are_sought ? few_paths * sources_.light() / paths : 0);
    }
    std::mutex adding;
    for_in_parallel(tbb::blocked_range<std::uint32_t>(0, paths), [&](const tbb::blocked_range<std::uint32_t>& part) {
        Ends ends;
        for (std::uint32_t number = part.begin(); number != part.end(); ++number) {
            end_if_asked();
            const Numbers numbers{number, seed, options_.evenly};
            LightPath path = sources_.path(numbers(0));
            for (std::size_t b = 0; b < bands(); ++b) path.enough[b] = options_.residual * path.weights[b];
            follow(path, std::nullopt, numbers, ends);
        }
        const std::lock_guard guard(adding);
        tally_.add(ends);
    });
}

/// Where none of n rays was free, one more may be: an n-th of the light.
std::vector<LightPaths::Looks> LightPaths::looks() const {
    constexpr double many = 1 << 15;
    std::vector<Looks> all;
    if (sources_.empty()) return all;
    for (std::size_t i = 0; i < rays_.organs().size(); ++i) {
        const OrganRays::Organ& organ = rays_.organs()[i];
        const LitTriangles::Owner& owner = rays_.owner(organ);
        if (owner.kind == LitKind::solid) continue;
        Looks& looks = all.emplace_back(Looks{owner.slot, 0, 0});
        double squares = 0;
        for (std::size_t k = 0; k < source_kinds; ++k) {
            const double rays = static_cast<double>(trials_) * organ.rays[k];
            looks.count += rays;
            if (rays > 0 && rays < many && !found_[i][k]) squares += organ.open[k] / rays * (organ.open[k] / rays);
        }
        looks.unseen = std::sqrt(squares);
        if (looks.count > 0) continue;
        looks.count = trials_ * points_per_path * paths_ * (organ.open[0] + organ.open[1]) / sources_.light();
    }
    return all;
}

/// Rays of one trial from an organ to the sources of one kind.
struct LightPaths::Sender {
    const OrganRays::Organ& organ;
    SourceKind kind;
    std::uint32_t first, count;  ///< numbers of its rays
    std::uint32_t seed;
};

void LightPaths::trace_from_organs(std::uint32_t trial, std::uint32_t seed) {
    if (trial == 0) found_.assign(rays_.organs().size(), {});
    trials_ = trial + 1;
    if (sources_.empty()) return;
    send_rays(trial, seed);
    if (rays_.has_projected()) project(trial, seed);
}

std::vector<LightPaths::View> LightPaths::views(std::uint32_t trial, std::uint32_t seed) const {
    constexpr std::uint32_t suns = 2, skies = 5;
    const std::array<double, 4> shifts = scrambled_sobol(0, static_cast<std::uint32_t>(seed));
    const double part = fraction(radical_inverse(trial) + shifts[0]);
    std::vector<View> views;
    for (const auto& [kind, count] : {std::pair{SourceKind::sun, suns}, {SourceKind::sky, skies}}) {
        for (const auto& light : sources_.parallels(kind, count, part, shifts[1])) views.push_back({kind, light});
    }
    return views;
}

void LightPaths::project(std::uint32_t trial, std::uint32_t seed) {
    const std::vector<View> views = this->views(trial, seed);
    const auto own = static_cast<std::uint32_t>(mix(mix(seed, trial), 1));
    double all = 0;
    for (const View& view : views) all += view.light.light;
    std::mutex adding;
    for_in_parallel(std::size_t{0}, views.size(), [&](std::size_t i) {
        const auto& [kind, light] = views[i];
        const std::array<double, 4> shifts =
            scrambled_sobol(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(mix(own, 2)));
        const double share = light.light / all;
        const double points = points_per_path * paths_ * (0.5 / static_cast<double>(views.size()) + 0.5 * share);
        LightProjection projection;
        projection.look(*triangles_, {light.towards, {shifts[0], shifts[1]}, space_.soil(), space_.period()}, points);
        LightPath path{{}, -light.towards};
        path.from_sun = kind == SourceKind::sun;
        Ends ends;
        add_points(projection, path, light.on_ground, ends);
        path.begin = LightPath::Begin::point;
        const auto paths = static_cast<std::uint32_t>(starts_per_path * paths_ * share);
        follow_points(projection, path, light.on_ground,
                      {std::max(1U, paths), static_cast<std::uint32_t>(mix(own, 3 + i)), options_.evenly}, ends);
        const std::lock_guard guard(adding);
        tally_.add(ends);
    });
}

/// What all points of a projection bring.
void LightPaths::add_points(const LightProjection& projection, LightPath path, double on_ground, Ends& ends) {
    const double of_point = on_ground * projection.area() / sources_.light() * paths_;
    for (std::size_t triangle = 0; triangle < triangles_->size(); ++triangle) {
        const LitTriangles::Owner& owner = triangles_->owner(triangle);
        const std::uint32_t count = projection.counts()[triangle];
        if (count == 0 || !rays_.is_projected(owner)) continue;
        path.weights.fill(of_point * count);
        const bool on_back = glm::dot(path.direction, triangles_->normal(triangle)) > 0;
        const OpticsOfBands optics = optics_of(owner, on_back);
        const BandWeights kept = kept_by(optics, path);
        tally_.add(ends.brought, kept);
        record(path, owner, on_back, kept, ends);
    }
}

/// Every so many of the points stand for all in what the organs scatter.
void LightPaths::follow_points(const LightProjection& projection, const LightPath& path, double on_ground,
                               const Numbers& of_view, Ends& ends) {
    std::size_t points = 0;
    const auto counts = [&](std::size_t triangle) { return rays_.is_projected(triangles_->owner(triangle)); };
    for (std::size_t triangle = 0; triangle < triangles_->size(); ++triangle) {
        if (counts(triangle)) points += projection.counts()[triangle];
    }
    const auto stride = static_cast<std::size_t>(std::max(1.0, static_cast<double>(points) / of_view.path));
    const auto first = std::min(stride - 1, static_cast<std::size_t>(static_cast<double>(stride) * of_view(0)[0]));
    if (points <= first) return;
    const double of_point = on_ground * projection.area() / sources_.light() * paths_ * static_cast<double>(points) /
                            static_cast<double>((points - first + stride - 1) / stride);
    Numbers numbers{0, of_view.seed, options_.evenly};
    projection.for_points(first, stride, counts, [&](std::size_t triangle, const glm::dvec3& place) {
        end_if_asked();
        LightPath begun = path;
        begun.origin = space_.inside(place);
        begun.near = space_.near();
        for (std::size_t b = 0; b < bands(); ++b) {
            begun.weights[b] = of_point;
            begun.enough[b] = options_.residual * of_point;
        }
        ++numbers.path;
        follow(begun, triangle, numbers, ends);
    });
}

void LightPaths::send_rays(std::uint32_t trial, std::uint32_t seed) {
    const std::span<const OrganRays::Organ> organs = rays_.organs();
    std::mutex adding;
    for_in_parallel(tbb::blocked_range<std::size_t>(0, organs.size()),
                    [&](const tbb::blocked_range<std::size_t>& part) {
                        Ends ends;
                        for (std::size_t i = part.begin(); i != part.end(); ++i) {
                            for (std::uint32_t k = 0; k < source_kinds; ++k) {
                                const std::uint32_t count = organs[i].rays[k];
                                const auto own = static_cast<std::uint32_t>(mix(mix(seed, organs[i].key), k));
                                const Sender sender{organs[i], static_cast<SourceKind>(k), trial * count, count, own};
                                send(sender, ends);
                                if (rays_.is_small(rays_.owner(organs[i]))) gather(sender, ends);
                            }
                        }
                        const std::lock_guard guard(adding);
                        tally_.add(ends);
                    });
}

/// What comes along a ray to a source is scattered from there as that of any path, so nothing is counted twice: paths
/// from the sources themselves end where they first meet an organ.
void LightPaths::send(const Sender& sender, Ends& ends) {
    const auto& [organ, kind, first, count, seed] = sender;
    const double of_ray = paths_ * organ.open[static_cast<std::size_t>(kind)] / (sources_.light() * count);
    for (std::uint32_t number = first; number != first + count; ++number) {
        end_if_asked();
        const Numbers numbers{number, seed, options_.evenly};
        const std::array<double, 4> sample = numbers(0);
        const OrganRays::Begin begin = rays_.begin(organ, kind, sample[2], sample[3]);
        const SourceRay ray = sources_.seek(kind, begin.patch, begin.open, begin.place, sample[0], sample[1]);
        if (!space_.is_open(begin.place, ray.towards, ray.length)) continue;
        const auto met = space_.met_at(begin.place, ray.towards);
        if (met && triangles_->number(*met) != begin.triangle) continue;
        LightPath path{space_.inside(begin.place), -ray.towards, space_.near(), kind == SourceKind::sun};
        path.begin = LightPath::Begin::ray;
        found_[static_cast<std::size_t>(&organ - rays_.organs().data())][static_cast<std::size_t>(kind)] = true;
        for (std::size_t b = 0; b < bands(); ++b) {
            path.weights[b] = of_ray * ray.light[b];
            path.enough[b] = options_.residual * path.weights[b];
        }
        follow(path, begin.triangle, numbers, ends);
    }
}

/// Scattered light on a small organ, which hardly a path would meet, against the way of the light: what is seen from
/// its surface, and the light on that. What paths bring to it is not counted then.
void LightPaths::gather(const Sender& sender, Ends& ends) {
    const auto& [organ, kind, first, count, seed] = sender;
    const LitTriangles::Owner& owner = rays_.owner(organ);
    const auto kinds =
        static_cast<double>(std::count_if(organ.rays.begin(), organ.rays.end(), [](auto n) { return n > 0; }));
    for (std::uint32_t number = first; number != first + count; ++number) {
        end_if_asked();
        const Numbers numbers{number, static_cast<std::uint32_t>(mix(seed, 0x67)), options_.evenly};
        const std::array<double, 4> at = numbers(0), to = numbers(1);
        const OrganRays::Begin begin = rays_.begin(organ, kind, at[0], at[1]);
        const bool on_back = at[2] < 0.5;
        const glm::dvec3 facing = on_back ? -begin.patch.normal : begin.patch.normal;
        LightPath path{space_.inside(begin.place), lambertian(facing, to[0], to[1]), space_.near()};
        if (path.origin.y < space_.soil()) continue;
        const double surface = 2 * begin.patch.area * organ.open[static_cast<std::size_t>(kind)] / begin.open;
        path.weights = scattered_from(path, numbers);
        for (double& light : path.weights) light *= paths_ * surface / (sources_.light() * count * kinds);
        path.bounce = 1;
        const OpticsOfBands optics = optics_of(owner, on_back);
        const BandWeights kept = kept_by(optics, path);
        tally_.add(ends.brought, kept);
        tally_.meet_directly(owner.slot, path, on_back && owner.kind == LitKind::leaf, kept);
    }
}

/// What a path against the way of the light looks at.
struct LightPaths::Seen {
    LitPatch patch;
    bool on_back = false;
    OpticsOfBands optics{}, behind{};  ///< of the side that is seen, and of the other
};

LightPaths::Seen LightPaths::seen_by(LightPath& path, const LitSpace::Met& met) const {
    if (met.kind == LitSpace::Met::Kind::soil) {
        path.origin.y = space_.soil();
        Seen soil{{path.origin, {0, 1, 0}, 1}};
        for (std::size_t b = 0; b < bands(); ++b) soil.optics[b] = {optics_.soil(path.origin, b), 0};
        return soil;
    }
    const LitTriangles::Owner& owner = triangles_->owner(met.hit);
    const glm::dvec3 normal = triangles_->normal(met.hit);
    const bool on_back = glm::dot(path.direction, normal) > 0;
    return {{path.origin, normal, 1}, on_back, optics_of(owner, on_back), optics_of(owner, !on_back)};
}

/// Light that comes towards the beginning of a path from what it meets, as pi times the radiance: mol/m2 that such a
/// surface sends out in all directions together.
BandWeights LightPaths::scattered_from(LightPath path, const Numbers& numbers) const {
    BandWeights sum{};
    path.weights.fill(1);
    for (std::uint32_t bounce = 2;; bounce += 2) {
        const LitSpace::Met met = space_.advance(path, [](double) {});
        if (met.kind == LitSpace::Met::Kind::sky) return sum;
        const Seen seen = seen_by(path, met);
        if (seen.patch.normal == glm::dvec3(0)) return sum;
        const BandWeights direct = direct_on(seen, numbers(bounce));
        for (std::size_t b = 0; b < bands(); ++b) sum[b] += path.weights[b] * direct[b];
        if (!look_on(path, seen, numbers(bounce + 1))) return sum;
    }
}

/// Turns a path to where light comes from that is scattered towards its beginning; false where chance ends it.
bool LightPaths::look_on(LightPath& path, const Seen& seen, const std::array<double, 4>& sample) const {
    constexpr double low = 0.25;
    double reflected = 0, through = 0, most = 0;
    for (std::size_t b = 0; b < bands(); ++b) {
        reflected += path.weights[b] * seen.optics[b].reflectance;
        through += path.weights[b] * seen.behind[b].transmittance;
    }
    if (!(reflected + through > 0)) return false;
    const double chance = reflected / (reflected + through);
    const bool turns_back = sample[0] < chance;
    for (std::size_t b = 0; b < bands(); ++b) {
        path.weights[b] *=
            turns_back ? seen.optics[b].reflectance / chance : seen.behind[b].transmittance / (1 - chance);
        most = std::max(most, path.weights[b]);
    }
    if (most < low) {
        if (sample[3] * low >= most) return false;
        for (double& of_band : path.weights) of_band *= low / most;
    }
    const glm::dvec3 facing = seen.on_back ? -seen.patch.normal : seen.patch.normal;
    path.direction = lambertian(turns_back ? facing : -facing, sample[1], sample[2]);
    path.near = space_.near();
    return true;
}

/// mol/m2 of what comes straight from the sources to a surface and leaves it on the side that is seen.
BandWeights LightPaths::direct_on(const Seen& seen, const std::array<double, 4>& sample) const {
    const LitPatch& patch = seen.patch;
    BandWeights light{};
    for (const SourceKind kind : {SourceKind::sun, SourceKind::sky, SourceKind::lamp}) {
        const double open = sources_.can_be_sought(kind) ? sources_.open_light(kind, patch) : 0;
        if (!(open > 0)) continue;
        const SourceRay ray = sources_.seek(kind, patch, open, patch.middle, sample[0], sample[1]);
        if (!space_.is_open(patch.middle, ray.towards, ray.length)) continue;
        if (kind != SourceKind::lamp && !sources_.reaches(patch.middle, ray.towards)) continue;
        const bool is_seen_side = (glm::dot(ray.towards, patch.normal) < 0) == seen.on_back;
        for (std::size_t b = 0; b < bands(); ++b) {
            light[b] +=
                open * ray.light[b] * (is_seen_side ? seen.optics[b].reflectance : seen.behind[b].transmittance);
        }
    }
    return light;
}

std::array<double, 4> LightPaths::Numbers::operator()(std::uint32_t bounce) const {
    const auto own = static_cast<std::uint32_t>(mix(seed, bounce));
    return evenly ? scrambled_sobol(path, own) : independent_numbers(path, own);
}

/// A path begins with all light of its source, perhaps at a triangle. Wherever it meets something, a part of it stays
/// there, and each band of the rest is by chance reflected or transmitted. Bands that part company go on as paths of
/// their own, so that in each of them absorbed (leaves, stems, solids) + soil + escaped = incoming.
void LightPaths::follow(LightPath path, std::optional<std::size_t> triangle, const Numbers& numbers, Ends& ends) {
    std::array<LightPath, most_bands> waiting;
    std::size_t count = 0;
    if (triangle) tally_.add(ends.brought, path.weights);
    bool goes_on =
        triangle ? scatter(path, waiting[count], *triangle, numbers, ends) : go_on(path, waiting[count], numbers, ends);
    while (true) {
        if (waiting[count].bounce > 0) ++count;
        if (!goes_on) {
            if (count == 0) return;
            path = waiting[--count];
        }
        waiting[count].bounce = 0;
        goes_on = go_on(path, waiting[count], numbers, ends);
    }
}

/// To what a path meets next and on from there; false where it ends. `parted` is what goes another way; it has no
/// bounce if nothing does.
bool LightPaths::go_on(LightPath& path, LightPath& parted, const Numbers& numbers, Ends& ends) {
    const bool is_first = path.bounce == 0;
    if (is_first && path.origin.y < space_.soil()) {  // it met the soil before
        tally_.add(ends.brought, path.weights);
        tally_.add(ends.soil, path.weights);
        return false;
    }
    const LitSpace::Met met = space_.advance(path, [&](double to) { count_at_sensors(path, to); });
    if (is_first) {
        if (options_.from_organs && path.can_be_sought && met.kind == LitSpace::Met::Kind::triangle) return false;
        tally_.add(ends.brought, path.weights);
    }
    if (met.kind == LitSpace::Met::Kind::sky) {
        tally_.add(ends.escaped, path.weights);
        return false;
    }
    return met.kind == LitSpace::Met::Kind::soil ? scatter_from_soil(path, numbers, ends)
                                                 : scatter(path, parted, triangles_->number(met.hit), numbers, ends);
}

void LightPaths::count_at_sensors(const LightPath& path, double to) {
    for (std::size_t k = 0; k < sensors_.size(); ++k) {
        const auto crossing = sensors_[k].crossing(path.origin, path.direction, path.near, to);
        if (crossing && crossing->from_front) tally_.pass_cell(first_cells_[k] + crossing->cell, path.weights);
    }
}

OpticsOfBands LightPaths::optics_of(const LitTriangles::Owner& owner, bool on_back) const {
    OpticsOfBands optics;
    for (std::size_t b = 0; b < bands(); ++b) {
        optics[b] = owner.kind == LitKind::solid ? SideOptics{optics_.solid(b), 0}
                                                 : optics_.of(owner.kind, owner.material, b)[on_back];
    }
    return optics;
}

/// What a path brings to a surface, and what of it stays there.
void LightPaths::record(const LightPath& met, const LitTriangles::Owner& owner, bool on_back, const BandWeights& kept,
                        Ends& ends) {
    const bool is_first = met.bounce == 0;
    if (is_first && met.begin == LightPath::Begin::point) return tally_.take(ends.brought, kept);  // of all points
    if (owner.kind == LitKind::solid) return tally_.add(ends.solids, kept);
    if (options_.from_organs && !is_first && rays_.is_small(owner)) return tally_.take(ends.brought, kept);
    const bool is_behind = on_back && owner.kind == LitKind::leaf;
    if (is_first && met.begin == LightPath::Begin::ray) return tally_.meet_directly(owner.slot, met, is_behind, kept);
    if (is_first && options_.only_scattered) return tally_.add(ends.escaped, kept);
    is_behind ? tally_.meet_back(owner.slot, met.weights) : tally_.meet_front(owner.slot, met.weights);
    tally_.absorb(owner.slot, kept);
    if (is_first) tally_.meet_first(owner.slot, met);
}

bool LightPaths::scatter(LightPath& path, LightPath& parted, std::size_t triangle, const Numbers& numbers, Ends& ends) {
    const LitTriangles::Owner& owner = triangles_->owner(triangle);
    const glm::dvec3 normal = triangles_->normal(triangle);
    const bool on_back = glm::dot(path.direction, normal) > 0, is_last = path.bounce + 1 == options_.depth;
    const LightPath met = path;
    const OpticsOfBands optics = optics_of(owner, on_back);
    if (is_black(optics) || normal == glm::dvec3(0)) {
        record(met, owner, on_back, met.weights, ends);
        return false;
    }
    const std::array<double, 4> sample = numbers(++path.bounce);
    parted = path;
    const BandWeights kept = divide(path, parted, optics, sample);
    record(met, owner, on_back, kept, ends);
    const glm::dvec3 facing = on_back ? -normal : normal;
    path.near = parted.near = space_.near();
    path.direction = lambertian(facing, sample[1], sample[2]);
    parted.direction = lambertian(-facing, sample[1], sample[2]);
    parted.origin = path.origin;
    if (is_last) {
        tally_.add(ends.escaped, path.weights);
        tally_.add(ends.escaped, parted.weights);
        parted.bounce = 0;
        return false;
    }
    if (!has_light(path)) std::swap(path, parted);
    if (!has_light(parted)) parted.bounce = 0;
    return has_light(path);
}

bool LightPaths::scatter_from_soil(LightPath& path, const Numbers& numbers, Ends& ends) {
    OpticsOfBands optics;
    for (std::size_t b = 0; b < bands(); ++b) optics[b] = {optics_.soil(path.origin, b), 0};
    if (is_black(optics)) {
        tally_.add(ends.soil, path.weights);
        return false;
    }
    const std::array<double, 4> sample = numbers(++path.bounce);
    LightPath nothing;
    tally_.add(ends.soil, divide(path, nothing, optics, sample));
    path.direction = lambertian({0, 1, 0}, sample[1], sample[2]);
    path.near = space_.near();
    if (path.bounce != options_.depth) return has_light(path);
    tally_.add(ends.escaped, path.weights);
    return false;
}

double LightPaths::open_light(const glm::dvec3& place) const {
    constexpr std::uint32_t of_part = 8;
    constexpr double seen = 0.5;  // the mean of a small leaf's area over all directions, as the light sees it
    std::uint64_t seed = 0;
    for (int axis = 0; axis < 3; ++axis) seed = mix(seed, std::bit_cast<std::uint64_t>(place[axis]));
    double sum = 0;
    sources_.for_directions(
        of_part, [&](std::uint32_t i) { return scrambled_sobol(i, static_cast<std::uint32_t>(seed)); },
        [&](const glm::dvec3& towards, double photons) {
            if (space_.is_open(place, towards, std::numeric_limits<double>::infinity())) sum += seen * photons;
        });
    return sum;
}

}  // namespace espalier::environment
