// A solute that moves through soil with its water.
#pragma once

#include "environment/soil/richards/movement.h"
#include "environment/soil/solutes/sorption.h"

#include <optional>
#include <span>
#include <vector>

namespace espalier::environment {

struct SoluteProperties {
    double diffusion = 1.6;   ///< in water, cm2/d
    double dispersivity = 0;  ///< cm
    Sorption sorption;
};

/// What is beyond the upper and the lower face: the concentration of water that enters, or one that is held there.
struct SoluteSides {
    double entering_top = 0, entering_bottom = 0, entering_sides = 0;
    std::optional<double> held_top, held_bottom;
};

/// Amounts since the beginning, in the solute's unit.
struct SoluteFlown {
    double top = 0, bottom = 0;  ///< into the soil
    double leached = 0;          ///< out through the bottom, a part of `bottom`
    double sides = 0;            ///< into the soil through the sides
};

/// d(theta c + rho s)/dt = div(theta D grad c) - div(q c), theta D = theta tau D0 + dispersivity |q|, tau = theta^(7/3)
/// / saturated^2 (Millington & Quirk 1961). Finite volumes; q c with van Leer's limiter (1974), of second order where
/// the solute is smooth, so that numerical diffusion is of the second order in the voxel; Heun's method in time, in
/// parts so short that no concentration falls below 0 or beyond its neighbours'.
class SoluteTransport {
public:
    SoluteTransport(const SoilLayout& layout, const SoluteProperties& properties);

    /// Amount per volume of soil, and concentration in its water, with the content at present.
    WaterBrick amount, concentration;

    void set_content(const WaterBrick& contents);
    const WaterBrick& content() const { return content_; }
    void find_concentrations();
    /// theta D of still soil, cm2/d.
    double diffusivity(std::size_t cell) const;
    /// Into how many parts a substep must be divided that leads to `contents`; to be asked before `advance`.
    int parts(const SoilMovement& movement, const WaterBrick& contents);
    /// One of these parts.
    void advance(const SoilMovement& movement, const WaterBrick& contents, double days, double days_left,
                 const SoluteSides& sides);
    const SoluteFlown& flown() const { return flown_; }
    SoluteFlown& flown() { return flown_; }

private:
    struct Line;
    void find_dispersion(const SoilMovement& movement);
    void find_fluxes(const SoilMovement& movement, std::size_t row, const SoluteSides& sides);
    double face_concentration(const Line& line, std::size_t cell, std::size_t next, int place, double water,
                              const SoluteSides& sides) const;
    double outflow(std::size_t row, std::size_t cell) const;
    void find_side_fluxes(const SoilMovement& movement, double entering);
    void pass_sides(double days);
    template <class Work>
    void for_cells(Work work) const;

    const SoilLayout& layout_;
    WaterGrid grid_;
    const SoluteProperties& properties_;
    double edge_;
    WaterBrick content_, start_, speed_;
    std::array<WaterBrick, 3> spread_,
        flux_;  ///< theta D and the flux of solute, through faces as SoilMovement has them
    std::vector<double> top_, bottom_, top_spread_, bottom_spread_;  ///< of columns; into the soil
    WaterBrick sides_;  ///< into voxels through sides of given heads; empty where there are none
    std::vector<double> row_rate_;
    SoluteFlown flown_;
};

}  // namespace espalier::environment
