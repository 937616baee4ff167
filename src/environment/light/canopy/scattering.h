// Light that leaves, stems and soil scatter in voxels: discrete ordinates, generation by generation.
#pragma once

#include "environment/light/canopy/leaves.h"
#include "environment/light/sky/daylight.h"

#include <numbers>
#include <span>
#include <vector>

namespace espalier::environment {

/// Light among voxels, in the unit of the beams that brought it.
struct CanopyFlux {
    std::vector<double> front, back;    ///< by piece: what its sides meet
    std::vector<double> ground;         ///< by square of the ground: what falls on it, per m2
    std::vector<float> fluence;         ///< by voxel: per m2, across all directions
    std::vector<float> isotropic;       ///< by voxel: what a leaf of the distribution meets, per m2
    std::vector<double> sun, open_sun;  ///< by piece, of the sun: what is met, and what would be met without shade
    std::vector<glm::dvec3> towards;    ///< by piece: to the sources, weighted; these three of `first` alone
    double outside = 0;                 ///< what falls on the ground beside the voxels, per m2
    double entered = 0, escaped = 0, solids = 0;

    /// As `share` times the other were added.
    void add(const CanopyFlux& other, double share);
};

/// Where the light of a band ends.
struct CanopyEnds {
    double leaves = 0, soil = 0, solids = 0, escaped = 0;  ///< leaves and stems

    double sum() const { return leaves + soil + solids + escaped; }
    void add(const CanopyEnds& other, double share);
};

struct CanopyBandLight {
    CanopyFlux flux;
    CanopyEnds ends;
    double entered = 0;  ///< all that came into the voxels, also from the ground beside them

    double closure() const { return entered > 0 ? ends.sum() / entered - 1 : 0; }
};

/// The leaves of a step among voxels, and what scatters there. Chandrasekhar 1960, Radiative transfer, chapter 2
/// (discrete ordinates); Myneni, Ross & Asrar 1989, A review on the theory of photon transport in leaf canopies,
/// Agricultural and Forest Meteorology 45:1-153.
class CanopyScattering {
public:
    struct Options {
        double clumping = 1;
        int beams = 2;                       ///< from each voxel's width; 1 for scattered light
        std::int64_t rings = 3, around = 6;  ///< ordinates of each half of the sphere
        double residual = 0.01;              ///< of the light, where its generations end
    };

    /// All are kept by reference. `is_solid` has a flag for each voxel, or nothing.
    CanopyScattering(const CanopyVoxels& voxels, const SortedPieces& pieces, const Optics& optics,
                     const LeafAngles& angles, std::span<const char> is_solid, const Options& options);

    /// What beams bring that nothing has scattered, the same for all bands.
    CanopyFlux first(std::span<const LightBeam> beams) const;
    /// The light of a band in which `first` is scattered until little is left; the rest is distributed like the last
    /// generation, so that nothing is lost.
    CanopyBandLight band(const CanopyFlux& first, std::size_t band) const;

    /// Light that leaves surfaces.
    struct Emission {
        std::vector<double> front, back, ground;  ///< by piece; by square of the ground, per m2
        double outside = 0;                       ///< from the ground beside the voxels, per m2
        double sum = 0;                           ///< without what comes from outside
    };
    /// Where it goes, after Lambert's law.
    CanopyFlux spread(const Emission& emission) const;
    /// A side of a piece, m2, as the ordinates together see it.
    double side(std::size_t piece) const { return whole_[piece] / std::numbers::pi; }

private:
    /// By filled voxel, of one ordinate.
    struct Added {
        std::vector<double> depth, away, towards;
    };

    void lay_out();
    CanopyFlux darkness() const;
    Emission scattered(const CanopyFlux& flux, std::size_t band, CanopyEnds& ends) const;
    BeamLight send(const ParallelLight& light, int beams, const LeavesSeen& seen, CanopyFlux& sum) const;
    void meet(const LeavesSeen& seen, const BeamLight& sent, const BeamLight* opposite, CanopyFlux& sum) const;
    /// Calls visit(pieces of one voxel, from and to, its place among the filled voxels) for each voxel that has some.
    template <class Visit>
    void for_voxels_of_pieces(const Visit& visit) const;
    /// Calls visit(piece) for each.
    template <class Visit>
    void for_pieces(const Visit& visit) const;
    /// Calls visit(first, end) for parts of so many numbers.
    template <class Visit>
    static void for_parts(std::size_t count, const Visit& visit);
    void look(const LightBeam& beam, const LeavesSeen& seen, const BeamLight& sent, CanopyFlux& sum) const;
    void find_depths(const LeavesSeen& seen, std::vector<double>& depth) const;
    void find_added(const Emission& per_side, std::size_t ordinate, Added& added) const;
    void mark_solids(std::vector<double>& depth) const;

    const CanopyVoxels& voxels_;
    SortedPieces pieces_;
    const Optics& optics_;
    const LeafAngles& angles_;
    std::span<const char> is_solid_;
    Options options_;
    std::vector<OrientedArea> leaves_;  ///< by piece
    FilledVoxels filled_;               ///< by leaves, stems or solids
    std::vector<std::size_t> places_;   ///< by voxel that has pieces: its place among the filled ones
    std::vector<std::size_t> solids_;   ///< places of those that are solid
    std::vector<SkyPart> ordinates_;    ///< of the upper half; each has an opposite one
    std::vector<LeavesSeen> seen_;      ///< by ordinate
    std::vector<double> whole_;         ///< by piece: a side as all ordinates see it, m2 sr
};

}  // namespace espalier::environment
