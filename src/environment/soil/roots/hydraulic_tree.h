// Water in a tree of roots: potentials and flows between the soil and the collar.
#pragma once

#include <cstdint>
#include <vector>

namespace espalier::environment {

/// A piece of root in one voxel. Centimetres and days; heads are total heads: pressure head plus height.
struct RootPiece {
    static constexpr std::uint32_t collar = 0xFFFFFFFF;

    std::uint32_t bearer = collar;  ///< the piece on whose tip it stands, which comes before it
    double length = 0;              ///< cm
    double surface_per_length = 0;  ///< circumference, cm
    double axial = 0;               ///< conductance kx, cm3/d
    double radial = 0;              ///< conductivity of the way from `outside` into the root, 1/d
    double outside = 0;             ///< total head of the soil, cm
};

/// What flows, by the rows of the pieces.
struct RootFlow {
    double collar_head = 0;      ///< total, cm
    double transpiration = 0;    ///< through the collar, cm3/d
    std::vector<double> tip;     ///< total head at the tip of each piece, cm
    std::vector<double> uptake;  ///< of each piece, cm3/d
};

/// The collar's end of the network: as if one conductance joined it to one head.
struct CollarView {
    double conductance = 0;  ///< cm2/d
    double head = 0;         ///< total, cm
};

/// Doussan et al. (1998), with the exact solution in each piece (Meunier et al. 2017): the result does not depend on
/// how finely a root of constant conductances in one soil is divided. A tree is solved by elimination from the tips to
/// the collar and back, in as many steps as it has pieces.
class HydraulicTree {
public:
    /// Of `pieces`, radial and outside heads may change between calls; everything is read anew.
    CollarView look(const std::vector<RootPiece>& pieces);
    /// After look(): the flow with this total head at the collar.
    void flow(const std::vector<RootPiece>& pieces, double collar_head, RootFlow& result) const;
    /// After look(): what each piece takes up more where the collar's head falls by 1 cm, cm2/d.
    void answer_collar(const std::vector<RootPiece>& pieces, std::vector<double>& by_collar) const;

private:
    struct Port {
        double a, c;                 ///< kx tau / sinh, cosh
        double storage;              ///< kx tau sinh
        double half;                 ///< kx tau tanh of half the piece
        double load, weighted_load;  ///< of what it bears, seen at its tip: conductance, and that times the head
        double below;                ///< 1 / (a c + load)
    };
    static Port port_of(const RootPiece& piece);

    std::vector<Port> ports_;
};

}  // namespace espalier::environment
