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

/// Directions of the whole sphere, each half as a sky.
std::vector<SkyPart> whole_sphere(std::int64_t rings, std::int64_t around) {
    std::vector<SkyPart> parts = sky_parts(rings, around);
    const std::size_t half = parts.size();
    for (std::size_t i = 0; i < half; ++i) parts.push_back({-parts[i].towards, parts[i].solid_angle});
    return parts;
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
    ordinates_ = whole_sphere(options.rings, options.around);
    for (const SkyPart& part : ordinates_) seen_.emplace_back(part.towards, angles_, options_.clumping);
    whole_.assign(pieces.size(), 0);
    for_each_if_worth(pieces.size(), pieces.size() * seen_.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < seen_.size(); ++k) {
            whole_[i] += ordinates_[k].solid_angle * seen_[k](pieces_.pieces[i]).front;
        }
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

std::vector<double> CanopyScattering::depths(const LeavesSeen& seen) const {
    std::vector<double> depth = seen.depths(voxels_, pieces_);
    for (std::size_t v = 0; v < is_solid_.size(); ++v) {
        if (is_solid_[v]) depth[v] = opaque / voxels_.edge;
    }
    return depth;
}

BeamLight CanopyScattering::send(const ParallelLight& light, int beams, const LeavesSeen& seen, CanopyFlux& sum) const {
    const BeamLight sent = send_beams(voxels_, light, beams);
    for_each_if_worth(pieces_.size(), pieces_.size(), [&](std::size_t i) {
        const LeafPiece& piece = pieces_.pieces[i];
        if (!is_solid_.empty() && is_solid_[piece.voxel]) return;
        const LeavesSeen::Sides sides = seen(piece);
        sum.front[i] += sides.front * sent.flux[piece.voxel];
        sum.back[i] += sides.back * sent.flux[piece.voxel];
    });
    const double volume = voxels_.edge * voxels_.edge * voxels_.edge, square = voxels_.edge * voxels_.edge;
    for (std::size_t v = 0; v < is_solid_.size(); ++v) {
        if (is_solid_[v]) sum.solids += volume * light.depth[v] * sent.flux[v];
    }
    const double projection = seen.projection();
    for_each_if_worth(sent.flux.size(), sent.flux.size(), [&](std::size_t v) {
        sum.fluence[v] += static_cast<float>(sent.flux[v]);
        sum.isotropic[v] += static_cast<float>(sent.flux[v] * projection);
    });
    for (std::size_t c = 0; c < sent.arrived.size(); ++c) sum.ground[c] += sent.arrived[c];
    sum.entered += sent.entered;
    sum.escaped += sent.left - square * std::accumulate(sent.arrived.begin(), sent.arrived.end(), 0.0);
    return sent;
}

/// Keeps what tells where the light of a beam falls.
void CanopyScattering::look(const LightBeam& beam, const LeavesSeen& seen, const BeamLight& sent,
                            CanopyFlux& sum) const {
    for_each_if_worth(pieces_.size(), pieces_.size(), [&](std::size_t i) {
        const double area = seen(pieces_.pieces[i]).both(), met = area * sent.flux[pieces_.pieces[i].voxel];
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
    for (const LightBeam& beam : beams) {
        if (beam.photons <= 0) continue;
        const LeavesSeen seen(beam.towards, angles_, options_.clumping);
        const std::vector<double> depth = depths(seen);
        ParallelLight light;
        light.towards = beam.towards;
        light.depth = depth;
        light.outside = beam.photons;
        look(beam, seen, send(light, options_.beams, seen, flux), flux);
        if (!voxels_.periodic) flux.outside += beam.photons * beam.towards.y;
    }
    return flux;
}

CanopyScattering::Emission CanopyScattering::scattered(const CanopyFlux& flux, std::size_t band,
                                                       CanopyEnds& ends) const {
    Emission emission;
    emission.front.resize(pieces_.size());
    emission.back.resize(pieces_.size());
    for_each_if_worth(pieces_.size(), pieces_.size(), [&](std::size_t i) {
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

/// What leaves of each voxel send away from an ordinate's source. A side is seen from ahead as the other from behind.
std::vector<double> CanopyScattering::added(const Emission& emission, std::size_t ordinate) const {
    const double solid_angle = ordinates_[ordinate].solid_angle;
    return per_volume<double>(voxels_, pieces_, [&](std::size_t i) {
        const LeavesSeen::Sides behind = seen_[ordinate](pieces_.pieces[i]);
        if (!(whole_[i] > 0)) return 0.0;
        return (emission.front[i] * behind.back + emission.back[i] * behind.front) * solid_angle / whole_[i];
    });
}

CanopyFlux CanopyScattering::spread(const Emission& emission) const {
    CanopyFlux flux = darkness();
    std::vector<double> floor(emission.ground.size());
    for (std::size_t k = 0; k < ordinates_.size(); ++k) {
        const std::vector<double> depth = depths(seen_[k]);
        const std::vector<double> more = added(emission, k);
        const double share = ordinates_[k].solid_angle / std::numbers::pi;  // of what a Lambertian ground sends
        ParallelLight light;
        light.towards = ordinates_[k].towards;
        light.depth = depth;
        light.added = more;
        light.outside = 0;
        if (light.towards.y < 0) {
            light.outside = share * emission.outside;
            std::transform(emission.ground.begin(), emission.ground.end(), floor.begin(),
                           [&](double sent) { return share * sent; });
            light.floor = floor;
        }
        send(light, 1, seen_[k], flux);
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
