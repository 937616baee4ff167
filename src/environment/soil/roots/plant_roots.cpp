#include "environment/soil/roots/plant_roots.h"

#include "turtle/internode_bearers.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

/// Where the segment crosses faces of voxels, from 0 to 1.
std::vector<double> cuts(const Internode& internode, const WaterGrid& grid) {
    std::vector<double> parts{0, 1};
    const glm::dvec3 from = (internode.base - grid.lower()) / grid.voxel();
    const glm::dvec3 to = (internode.tip - grid.lower()) / grid.voxel();
    for (int axis = 0; axis < (grid.flat() ? 2 : 3); ++axis) {
        const double low = std::min(from[axis], to[axis]), high = std::max(from[axis], to[axis]);
        for (double face = std::ceil(low); face < high; ++face) {
            const double part = (face - from[axis]) / (to[axis] - from[axis]);
            if (part > 1e-6 && part < 1 - 1e-6) parts.push_back(part);
        }
    }
    std::sort(parts.begin(), parts.end());
    return parts;
}

constexpr std::size_t outside_soil = PlantRoots::no_cell - 1;

/// The cell of a point, `no_cell` above the surface and in a stone, or `outside_soil`.
std::size_t cell_at(glm::dvec3 point, const SoilLayout& soil) {
    const WaterGrid& grid = soil.grid();
    glm::dvec3 at = (point - grid.lower()) / grid.voxel();
    const glm::dvec3 size(grid.size());
    if (at.y >= size.y) return PlantRoots::no_cell;
    if (grid.flat()) at.z = 0.5;
    if (soil.joined_x()) at.x -= size.x * std::floor(at.x / size.x);
    if (soil.joined_z()) at.z -= size.z * std::floor(at.z / size.z);
    const glm::ivec3 voxel(glm::floor(at));
    if (!grid.has(voxel)) return outside_soil;
    return soil.free(grid.cell(voxel)) ? grid.cell(voxel) : PlantRoots::no_cell;
}

/// From the middle of each internode to the tip of its axis, cm.
std::vector<double> distances_from_tips(const Column<Internode>& internodes) {
    std::vector<double> distances(internodes.size());
    std::vector<double> behind;
    for (std::size_t i = internodes.size(); i-- > 0;) {
        const Internode& internode = internodes[i];
        if (behind.size() <= internode.axis) behind.resize(internode.axis + 1, 0);
        const double length = 100 * glm::length(internode.tip - internode.base);
        distances[i] = behind[internode.axis] + 0.5 * length;
        behind[internode.axis] += length;
    }
    return distances;
}

class Cutting {
public:
    Cutting(const PlantView& plant, const WorldView& world, double days, const SoilLayout& soil,
            const std::vector<RootConductances>& orders, RootMeasure measure, const SaidOfRoots& said)
        : plant_(plant),
          internodes_(plant.interpretation->geometry.internodes),
          world_(world),
          days_(days),
          soil_(soil),
          orders_(orders),
          said_(said),
          top_(soil.grid().upper().y),
          last_piece_(internodes_.size(), RootPiece::collar),
          has_ended_(internodes_.size(), false) {
        if (measure == RootMeasure::distance_from_tip) distances_ = distances_from_tips(internodes_);
    }

    PlantRoots cut() {
        roots_.modules_in_string = plant_.string->size();
        const std::vector<std::uint32_t> bearers = internode_bearers(plant_.interpretation->geometry, *plant_.string);
        for (std::uint32_t i = 0; i < internodes_.size(); ++i) {
            const std::uint32_t bearer = bearers[i];
            last_piece_[i] = bearer < internodes_.size() ? last_piece_[bearer] : RootPiece::collar;
            has_ended_[i] = bearer < internodes_.size() && has_ended_[bearer];
            if (has_ended_[i]) continue;
            if (0.5 * (internodes_[i].base.y + internodes_[i].tip.y) < top_) add(i);
        }
        return std::move(roots_);
    }

private:
    double measure_of(std::uint32_t i) const {
        if (!distances_.empty()) return distances_[i];
        if (!said_.ages.empty() && said_.ages[i] >= 0) return said_.ages[i];
        const ModuleString& string = *plant_.string;
        if (!string.has_lineage()) return 0;
        const int born = static_cast<int>(string.step_of_birth(internodes_[i].module));
        return std::max(0, world_.step - born) * world_.dt * days_;
    }

    void add(std::uint32_t i) {
        const Internode& internode = internodes_[i];
        const double length = 100 * glm::length(internode.tip - internode.base);
        if (!(length > 1e-9)) return;
        const RootConductances& order = orders_[std::min<std::size_t>(internode.order, orders_.size() - 1)];
        const double x = measure_of(i);
        const bool own = !said_.axial.empty() && said_.axial[i] > 0;
        const double radial = own ? said_.radial[i] : order.radial(x), axial = own ? said_.axial[i] : order.axial(x);
        const double radius = std::max(100 * 0.5 * (internode.base_radius + internode.tip_radius), 1e-3);
        const std::vector<double> parts = cuts(internode, soil_.grid());
        for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
            const double share = parts[k + 1] - parts[k];
            if (!(share > 1e-9)) continue;
            const glm::dvec3 middle = glm::mix(internode.base, internode.tip, 0.5 * (parts[k] + parts[k + 1]));
            std::size_t cell = cell_at(middle, soil_);
            if (cell == outside_soil) {
                leave(i, middle);
                if (has_ended_[i]) return;
                cell = PlantRoots::no_cell;
            }
            if (roots_.pieces.empty()) roots_.collar_height = 100 * std::min(internode.base.y, top_);
            roots_.cells.push_back(cell);
            roots_.radii.push_back(radius);
            roots_.depths.push_back(100 * (top_ - middle.y));
            roots_.internodes.push_back(i);
            roots_.modules.push_back(internode.module);
            roots_.pieces.push_back({last_piece_[i], length * share, 2 * std::numbers::pi * radius, axial,
                                     cell == PlantRoots::no_cell ? 0 : radial, 0});
            last_piece_[i] = static_cast<std::uint32_t>(roots_.pieces.size() - 1);
        }
    }

    /// The internode goes on outside the soil.
    void leave(std::uint32_t i, const glm::dvec3& point) {
        if (soil_.outside() == OutsideSoil::error) {
            throw RunError(
                fmt::format("a root of plant {} leaves the soil at ({:.3g}, {:.3g}, {:.3g}): make the soil's domain "
                            "larger, its sides periodic, or say outside = \"stop growing\"",
                            plant_.plant, point.x, point.y, point.z));
        }
        if (!roots_.left_at) roots_.left_at = point;
        has_ended_[i] = soil_.outside() == OutsideSoil::root_ends;
    }

    const PlantView& plant_;
    const Column<Internode>& internodes_;
    const WorldView& world_;
    double days_;
    const SoilLayout& soil_;
    const std::vector<RootConductances>& orders_;
    const SaidOfRoots& said_;
    double top_;
    std::vector<std::uint32_t> last_piece_;  ///< of each internode, or of what bears it
    std::vector<bool> has_ended_;            ///< an internode, or what bears it, outside the soil
    std::vector<double> distances_;
    PlantRoots roots_;
};

}  // namespace

PlantRoots roots_in_soil(const PlantView& plant, const WorldView& world, double days, const SoilLayout& soil,
                         const std::vector<RootConductances>& orders, RootMeasure measure, const SaidOfRoots& said) {
    return Cutting(plant, world, days, soil, orders, measure, said).cut();
}

}  // namespace espalier::environment
