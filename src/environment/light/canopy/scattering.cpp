#include "environment/light/canopy/scattering.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace espalier::environment {
namespace {

constexpr int most_generations = 400;
constexpr double opaque = 1e4;  // optical depth of a voxel

template <class Number>
void add_to(std::vector<Number>& sums, const std::vector<Number>& more, double share) {
    if (sums.empty()) sums.assign(more.size(), 0);
    for (std::size_t i = 0; i < more.size(); ++i) sums[i] += static_cast<Number>(share * more[i]);
}

}  // namespace

void CanopyFlux::add(const CanopyFlux& other, double share) {
    add_to(front, other.front, share);
    add_to(back, other.back, share);
    add_to(ground, other.ground, share);
    add_to(fluence, other.fluence, share);
    add_to(isotropic, other.isotropic, share);
}

void CanopyEnds::add(const CanopyEnds& other, double share) {
    leaves += share * other.leaves;
    soil += share * other.soil;
    solids += share * other.solids;
    escaped += share * other.escaped;
}

CanopyScattering::CanopyScattering(const CanopyVoxels& voxels, const SortedPieces& pieces, const Optics& optics,
                                   const LeafAngles& angles, std::span<const char> is_solid, const Options& options)
    : voxels_(voxels), pieces_(pieces), optics_(optics), angles_(angles), is_solid_(is_solid), options_(options) {
    lay_out();
    ordinates_ = sky_parts(options.rings, options.around);
    for (const SkyPart& part : ordinates_) seen_.emplace_back(part.towards, angles_, options_.clumping);
    whole_.assign(pieces.size(), 0);
    for_pieces([&](std::size_t i) {
        for (std::size_t k = 0; k < seen_.size(); ++k) {
            whole_[i] += ordinates_[k].solid_angle * seen_[k](leaves_[i]).both();  // one of them from below
        }
    });
}

/// What the loops over pieces and voxels read, close together.
void CanopyScattering::lay_out() {
    leaves_.reserve(pieces_.size());
    for (const LeafPiece& piece : pieces_.pieces) leaves_.push_back(piece.leaf);
    std::vector<std::size_t> numbers;
    std::size_t group = 0;
    const std::size_t groups = pieces_.starts.empty() ? 0 : pieces_.starts.size() - 1;
    const auto voxel_of = [&](std::size_t g) { return pieces_.pieces[pieces_.starts[g]].voxel; };
    const auto add_groups_before = [&](std::size_t voxel) {
        for (; group < groups && voxel_of(group) < voxel; ++group) {
            places_.push_back(numbers.size());
            numbers.push_back(voxel_of(group));
        }
    };
    for (std::size_t v = 0; v < is_solid_.size(); ++v) {
        if (!is_solid_[v]) continue;
        add_groups_before(v);
        if (group < groups && voxel_of(group) == v) {
            places_.push_back(numbers.size());
            ++group;
        }
        solids_.push_back(numbers.size());
        numbers.push_back(v);
    }
    add_groups_before(voxels_.count());
    filled_ = FilledVoxels(voxels_, std::move(numbers));
}

template <class Visit>
void CanopyScattering::for_parts(std::size_t count, const Visit& visit) {
    constexpr std::size_t worth_sharing = 8192;
    using Part = tbb::blocked_range<std::size_t>;
    if (count < worth_sharing) return visit(std::size_t{0}, count);
    for_in_parallel(Part(0, count, worth_sharing / 4), [&](const Part& part) { visit(part.begin(), part.end()); });
}

template <class Visit>
void CanopyScattering::for_pieces(const Visit& visit) const {
    for_parts(pieces_.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) visit(i);
    });
}

template <class Visit>
void CanopyScattering::for_voxels_of_pieces(const Visit& visit) const {
    for_parts(places_.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t g = first; g < end; ++g) visit(pieces_.starts[g], pieces_.starts[g + 1], places_[g]);
    });
}

CanopyFlux CanopyScattering::darkness() const {
    CanopyFlux flux;
    flux.front.assign(pieces_.size(), 0);
    flux.back.assign(pieces_.size(), 0);
    flux.ground.assign(voxels_.ground_count(), 0);
    flux.fluence.assign(voxels_.count(), 0);
    flux.isotropic.assign(voxels_.count(), 0);
    return flux;
}

void CanopyScattering::find_depths(const LeavesSeen& seen, std::vector<double>& depth) const {
    const double per_volume = 1 / (voxels_.edge * voxels_.edge * voxels_.edge);
    depth.assign(filled_.size(), 0);
    for_voxels_of_pieces([&](std::size_t first, std::size_t end, std::size_t place) {
        double sum = 0;
        for (std::size_t i = first; i < end; ++i) sum += seen(leaves_[i]).both();
        depth[place] = sum * per_volume;
    });
    mark_solids(depth);
}

void CanopyScattering::mark_solids(std::vector<double>& depth) const {
    for (const std::size_t place : solids_) depth[place] = opaque / voxels_.edge;
}

/// What pieces meet of light from one direction, and, if given, from the opposite one.
void CanopyScattering::meet(const LeavesSeen& seen, const BeamLight& sent, const BeamLight* opposite,
                            CanopyFlux& sum) const {
    for_voxels_of_pieces([&](std::size_t first, std::size_t end, std::size_t place) {
        const std::size_t voxel = filled_.number(place);
        if (!is_solid_.empty() && is_solid_[voxel]) return;
        const double flux = sent.flux[voxel], from_behind = opposite ? opposite->flux[voxel] : 0;
        for (std::size_t i = first; i < end; ++i) {
            const LeavesSeen::Sides sides = seen(leaves_[i]);
            sum.front[i] += sides.front * flux + sides.back * from_behind;
            sum.back[i] += sides.back * flux + sides.front * from_behind;
        }
    });
}

BeamLight CanopyScattering::send(const ParallelLight& light, int beams, const LeavesSeen& seen, CanopyFlux& sum) const {
    BeamLight sent = send_beams(voxels_, filled_, light, beams);
    const double volume = voxels_.edge * voxels_.edge * voxels_.edge, square = voxels_.edge * voxels_.edge;
    for (const std::size_t place : solids_) {
        sum.solids += volume * light.depth[place] * sent.flux[filled_.number(place)];
    }
    const double projection = seen.projection();
    for_parts(sent.flux.size(), [&](std::size_t first, std::size_t end) {
        for (std::size_t v = first; v < end; ++v) {
            sum.fluence[v] += static_cast<float>(sent.flux[v]);
            sum.isotropic[v] += static_cast<float>(sent.flux[v] * projection);
        }
    });
    for (std::size_t c = 0; c < sent.arrived.size(); ++c) sum.ground[c] += sent.arrived[c];
    sum.entered += sent.entered;
    sum.escaped += sent.left - square * std::accumulate(sent.arrived.begin(), sent.arrived.end(), 0.0);
    return sent;
}

/// Keeps what tells where the light of a beam falls.
void CanopyScattering::look(const LightBeam& beam, const LeavesSeen& seen, const BeamLight& sent,
                            CanopyFlux& sum) const {
    for_pieces([&](std::size_t i) {
        const double area = seen(leaves_[i]).both(), met = area * sent.flux[pieces_.pieces[i].voxel];
        sum.towards[i] += met * beam.towards;
        if (!beam.is_sun) return;
        sum.sun[i] += met;
        sum.open_sun[i] += area * beam.photons;
    });
}

CanopyFlux CanopyScattering::first(std::span<const LightBeam> beams) const {
    CanopyFlux flux = darkness();
    flux.sun.assign(pieces_.size(), 0);
    flux.open_sun.assign(pieces_.size(), 0);
    flux.towards.assign(pieces_.size(), glm::dvec3(0));
    std::vector<double> depth;
    for (const LightBeam& beam : beams) {
        if (beam.photons <= 0) continue;
        const LeavesSeen seen(beam.towards, angles_, options_.clumping);
        find_depths(seen, depth);
        ParallelLight light;
        light.towards = beam.towards;
        light.depth = depth;
        light.outside = beam.photons;
        const BeamLight sent = send(light, options_.beams, seen, flux);
        meet(seen, sent, nullptr, flux);
        look(beam, seen, sent, flux);
        if (!voxels_.periodic) flux.outside += beam.photons * beam.towards.y;
    }
    return flux;
}

CanopyScattering::Emission CanopyScattering::scattered(const CanopyFlux& flux, std::size_t band,
                                                       CanopyEnds& ends) const {
    Emission emission;
    emission.front.resize(pieces_.size());
    emission.back.resize(pieces_.size());
    for_pieces([&](std::size_t i) {
        const LeafPiece& piece = pieces_.pieces[i];
        const auto [front, back] = optics_.of(piece.kind, piece.material, band);
        emission.front[i] = front.reflectance * flux.front[i] + back.transmittance * flux.back[i];
        emission.back[i] = back.reflectance * flux.back[i] + front.transmittance * flux.front[i];
    });
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        emission.sum += emission.front[i] + emission.back[i];
        ends.leaves += flux.front[i] + flux.back[i] - emission.front[i] - emission.back[i];
    }
    const double edge = voxels_.edge, square = edge * edge;
    emission.ground.resize(flux.ground.size());
    for (std::size_t c = 0; c < flux.ground.size(); ++c) {
        const auto x = static_cast<double>(c % std::size_t(voxels_.size.x)),
                   z = static_cast<double>(c / std::size_t(voxels_.size.x));
        const double reflectance = optics_.soil(voxels_.corner + edge * glm::dvec3(x + 0.5, 0, z + 0.5), band);
        emission.ground[c] = reflectance * flux.ground[c];
        emission.sum += square * emission.ground[c];
        ends.soil += square * (flux.ground[c] - emission.ground[c]);
    }
    const glm::dvec3 middle = voxels_.corner + 0.5 * edge * glm::dvec3(voxels_.size);
    emission.outside = optics_.soil(middle, band) * flux.outside;
    ends.escaped += flux.escaped;
    ends.solids += flux.solids;
    return emission;
}

/// What leaves of each voxel hide of an ordinate, and send away from its source and towards it. A side is seen from
/// ahead as the other from behind.
void CanopyScattering::find_added(const Emission& per_side, std::size_t ordinate, Added& added) const {
    const double volume = voxels_.edge * voxels_.edge * voxels_.edge;
    const double share = ordinates_[ordinate].solid_angle / volume;
    const LeavesSeen& seen = seen_[ordinate];
    added.depth.assign(filled_.size(), 0);
    added.away.assign(filled_.size(), 0);
    added.towards.assign(filled_.size(), 0);
    for_voxels_of_pieces([&](std::size_t first, std::size_t end, std::size_t place) {
        double hidden = 0, away = 0, towards = 0;
        for (std::size_t i = first; i < end; ++i) {
            const LeavesSeen::Sides sides = seen(leaves_[i]);
            hidden += sides.both();
            away += per_side.front[i] * sides.back + per_side.back[i] * sides.front;
            towards += per_side.front[i] * sides.front + per_side.back[i] * sides.back;
        }
        added.depth[place] = hidden * (1 / volume);
        added.away[place] = away * share;
        added.towards[place] = towards * share;
    });
    mark_solids(added.depth);
}

CanopyFlux CanopyScattering::spread(const Emission& emission) const {
    CanopyFlux flux = darkness();
    std::vector<double> floor(emission.ground.size());
    Emission per_side = emission;  // of what all ordinates see of a side
    for_pieces([&](std::size_t i) {
        const double of_side = whole_[i] > 0 ? 1 / whole_[i] : 0;
        per_side.front[i] *= of_side;
        per_side.back[i] *= of_side;
    });
    Added added;
    for (std::size_t k = 0; k < ordinates_.size(); ++k) {
        find_added(per_side, k, added);
        const double share = ordinates_[k].solid_angle / std::numbers::pi;  // of what a Lambertian ground sends
        ParallelLight light;
        light.towards = ordinates_[k].towards;
        light.depth = added.depth;
        light.added = added.away;
        light.outside = 0;
        const BeamLight from_above = send(light, 1, seen_[k], flux);
        light.towards = -light.towards;
        light.added = added.towards;
        light.outside = share * emission.outside;
        std::transform(emission.ground.begin(), emission.ground.end(), floor.begin(),
                       [&](double sent) { return share * sent; });
        light.floor = floor;
        const BeamLight from_below = send(light, 1, seen_[k], flux);
        meet(seen_[k], from_above, &from_below, flux);
    }
    return flux;
}

CanopyBandLight CanopyScattering::band(const CanopyFlux& first, std::size_t band) const {
    CanopyBandLight light;
    light.flux = first;
    light.entered = first.entered;
    Emission emission = scattered(first, band, light.ends);
    for (int generation = 0; emission.sum + emission.outside > 0; ++generation) {
        const CanopyFlux flux = spread(emission);
        const double from_ground =
            voxels_.edge * voxels_.edge * std::accumulate(emission.ground.begin(), emission.ground.end(), 0.0);
        const double sent = emission.sum - from_ground + flux.entered;
        light.entered += flux.entered - from_ground;
        CanopyEnds ends;
        emission = scattered(flux, band, ends);
        light.flux.add(flux, 1);
        light.ends.add(ends, 1);
        if (emission.sum > options_.residual * light.entered && generation < most_generations) continue;
        const double rest = emission.sum / (sent - emission.sum);
        if (!(emission.sum > 0) || !std::isfinite(rest)) break;
        light.flux.add(flux, rest);
        light.ends.add(ends, rest);
        break;
    }
    return light;
}

}  // namespace espalier::environment
