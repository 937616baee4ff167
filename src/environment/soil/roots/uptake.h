// What the roots of one plant take from the soil at a moment.
#pragma once

#include "environment/soil/roots/collar.h"
#include "environment/soil/roots/plant_roots.h"
#include "environment/soil/roots/zone.h"

#include <functional>
#include <optional>
#include <span>

namespace espalier::environment {

enum class UptakeModel { network, feddes, couvreur };

/// Feddes et al. (1978): the part of the potential uptake that soil at a pressure head gives, cm.
struct FeddesHeads {
    double anaerobic = -10, wet = -25, dry = -800, wilting = -16000;

    double factor(double head) const;
    double slope(double head) const;
};

/// Figures of a plant's water.
struct PlantWater {
    double conductance = 0;         ///< Krs: of the whole root system in uniform soil, cm2/d
    std::vector<double> fractions;  ///< SUF: of each piece in the uptake from uniform soil (Couvreur et al. 2012)
    double collar = 0;              ///< pressure head at the collar, cm
    double demand = 0;              ///< of the last moment, cm3/d; NaN if the collar is held at a head
    std::vector<double> xylem;      ///< mean pressure head in each piece, cm
    std::vector<double> surface;    ///< pressure head of the soil at its surface, cm
    std::vector<double> uptake;     ///< cm3/d
    std::vector<double> by_head;    ///< of the uptake with the voxel's head, cm2/d

    double transpiration() const;  ///< cm3/d
};

/// The roots of one plant with what is known of them during a step.
class PlantUptake {
public:
    PlantUptake(PlantRoots roots, const SoilLayout& soil);

    const PlantRoots& roots() const { return roots_; }
    const PlantWater& water() const { return water_; }
    const std::vector<double>& radial() const { return radial_; }  ///< of each piece, without the soil, 1/d
    /// Adds the lengths of the roots to those of the voxels, cm.
    void add_lengths(WaterBrick& lengths) const;
    /// Once the lengths of all plants are known: how far around each root it may draw; `zone` false: not at all.
    void surround(const WaterBrick& lengths, bool zone);
    /// Solves for `points`, the soil's state, to a residual of 1e-9 of the flow; `demand` in cm3/d, or a held head.
    void solve(std::span<const SoilPoint> points, UptakeModel model, const RootCollar& collar,
               const FeddesHeads& feddes, double demand, double held_head);
    /// The same with the network of roots under a shoot that takes what it needs.
    void solve_under(std::span<const SoilPoint> points, CollarEnd& shoot);
    /// Cells that roots are in, in rising order.
    const std::vector<std::size_t>& cells() const { return cells_; }
    /// After a network was solved whose collar is not held: the change of what the roots in each of these cells take
    /// with the collar's head, cm2/d, of the sign of more water; `collar` gets that of roots and shoot together. False:
    /// the collar is held.
    bool answer_together(std::vector<double>& by_cell, double& collar) const;
    /// So many days have passed, in which the roots took up `weight` times what was solved last and the rest times what
    /// they took up before; `before`: that of the plant, cm3/d.
    void pass(double days, double weight, double before);
    /// The mean uptake of a piece since the step began, cm3/d; before any time has passed, that of the moment.
    double mean_uptake(std::size_t piece) const;

private:
    void begin(std::span<const SoilPoint> points);
    void solve_network(std::span<const SoilPoint> points, const std::function<double(const CollarView&)>& collar_head);
    void find_tangent(std::size_t piece, std::span<const SoilPoint> points);
    double take_flow(std::size_t piece);
    void solve_macroscopic(std::span<const SoilPoint> points, UptakeModel model, const RootCollar& collar,
                           const FeddesHeads& feddes, double demand, double held_head);
    void measure_conductance();
    void find_cells();

    PlantRoots roots_;
    const SoilLayout& soil_;
    std::vector<double> radial_;      ///< of the roots alone, 1/d
    std::vector<double> resistance_;  ///< radius times zone factor, cm
    std::vector<double> heights_;     ///< of the voxels' centres, cm
    std::vector<std::size_t> cells_;
    std::vector<std::uint32_t> places_;  ///< of each piece's cell among them
    HydraulicTree tree_;
    double conductance_ = 0;  ///< of the roots in the soil they were solved for last, cm2/d
    RootFlow flow_;
    PlantWater water_;
    std::vector<double> rates_;            ///< at which each piece took up water last, cm3/d
    std::vector<double> taken_;            ///< by each piece in the step, cm3
    double days_ = 0;                      ///< of the step that have passed
    std::optional<double> shoot_by_head_;  ///< of the last solution; none: the collar is held
    bool begun_ = false;
};

}  // namespace espalier::environment
