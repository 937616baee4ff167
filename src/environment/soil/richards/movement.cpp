#include "environment/soil/richards/movement.h"

#include "base/bytes.h"
#include "environment/soil/richards/fluxes.h"

namespace espalier::environment {

void SoilMovement::resize(const WaterGrid& grid, bool has_side_heads) {
    if (has_side_heads) sides.assign(grid.cells(), 0.0);
    for (WaterBrick& axis : flux) axis.assign(grid.cells(), 0.0);
    uptake.assign(grid.cells(), 0.0);
    const std::size_t columns = std::size_t(grid.size().x) * grid.size().z;
    for (std::vector<double>* side : {&floor, &surface}) side->assign(columns, 0.0);
}

void SoilMovement::pass(double begin, double span, double weight, const SoilLayout& layout, const SoilFluxes& fluxes,
                        const WaterBrick& taken) {
    day = begin;
    days = span;
    layout.for_rows([&](std::size_t row) {
        layout.grid().for_cells_of(row, [&](std::size_t c) {
            for (int axis = 0; axis < 3; ++axis) bring_on(flux[axis][c], fluxes.faces()[axis].flux[c], weight);
            bring_on(uptake[c], taken[c], weight);
            if (fluxes.has_side_heads()) bring_on(sides[c], fluxes.through_sides(c).flux, weight);
        });
    });
    for (std::size_t column = 0; column < floor.size(); ++column) {
        bring_on(floor[column], fluxes.floor()[column].flux, weight);
        bring_on(surface[column], fluxes.surface()[column].into.flux, weight);
    }
}

void SoilMovement::save(std::ostream& out) const {
    for (const WaterBrick& axis : flux) write_doubles(out, {axis.data(), axis.size()});
    for (const WaterBrick* brick : {&uptake, &sides}) write_doubles(out, {brick->data(), brick->size()});
    for (const std::vector<double>* side : {&floor, &surface}) write_doubles(out, *side);
}

void SoilMovement::restore(std::istream& in) {
    for (WaterBrick& axis : flux) read_doubles(in, {axis.data(), axis.size()});
    for (WaterBrick* brick : {&uptake, &sides}) read_doubles(in, {brick->data(), brick->size()});
    for (std::vector<double>* side : {&floor, &surface}) read_doubles(in, *side);
}

}  // namespace espalier::environment
