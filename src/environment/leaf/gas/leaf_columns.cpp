#include "environment/leaf/gas/leaf_columns.h"

#include "environment/leaf/gas/leaf_column_lanes.h"

#include <cmath>

namespace espalier::environment::leaf {

std::vector<SolveColumns> solvers_here() {
    std::vector<SolveColumns> here{solve_in_lanes<double>};
#ifdef ESPALIER_WIDE_MATH
    if (__builtin_cpu_supports("avx2")) here.push_back(solve_with_256_bits);
    if (__builtin_cpu_supports("avx512f")) here.push_back(solve_with_512_bits);
#endif
    return here;
}

void solve(const LeafKind& kind, const Air& air, const LeafColumns& columns) {
    static const SolveColumns widest = solvers_here().back();
    widest(kind, air, columns);
    for (std::size_t i = 0; i < columns.count; ++i) {
        if (!std::isnan(columns.temperature[i])) continue;
        const auto of = [&](const double* column, double usual) { return column ? column[i] : usual; };
        LeafKind leaf = kind;
        leaf.photosynthesis.carboxylation.at_25 = of(columns.carboxylation, kind.photosynthesis.carboxylation.at_25);
        leaf.photosynthesis.electron_transport.at_25 =
            of(columns.electron_transport, kind.photosynthesis.electron_transport.at_25);
        leaf.photosynthesis.respiration.at_25 = of(columns.respiration, kind.photosynthesis.respiration.at_25);
        leaf.stomata.slope = of(columns.slope, kind.stomata.slope);
        leaf.width = of(columns.width, kind.width);
        gas_exchange(leaf, {of(columns.photons, 0), of(columns.near_infrared, 0), of(columns.thermal, 0)}, air,
                     of(columns.potential, 0));  // says what is wrong
    }
}

}  // namespace espalier::environment::leaf
