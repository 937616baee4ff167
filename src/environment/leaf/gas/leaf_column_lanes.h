// The solver of leaf_columns.h by the instructions that the file is compiled for which includes this one.
#pragma once

#include "environment/leaf/gas/leaf_columns.h"
#include "environment/leaf/gas/leaf_equations.h"

#include <cstring>

namespace espalier::environment::leaf {

extern const SolveColumns solve_with_512_bits, solve_with_256_bits;

template <class T>
ESPALIER_INLINE T lanes_from(const double* column, std::size_t first, std::size_t count, double usual) {
    T lanes = all_of<T>(usual);
    if (!column) return lanes;
    constexpr std::size_t width = sizeof(T) / sizeof(double);
    double each[width];
    for (std::size_t k = 0; k < width; ++k) each[k] = column[first + (k < count ? k : count - 1)];
    std::memcpy(&lanes, each, sizeof lanes);
    return lanes;
}

template <class T>
ESPALIER_INLINE void put_lanes(double* column, std::size_t first, std::size_t count, const T& lanes) {
    if (!column) return;
    double each[sizeof(T) / sizeof(double)];
    std::memcpy(each, &lanes, sizeof lanes);
    for (std::size_t k = 0; k < count; ++k) column[first + k] = each[k];
}

/// Behind the last leaf stand copies of it.
template <class T>
void solve_in_lanes(const LeafKind& kind, const Air& air, const LeafColumns& columns) {
    constexpr std::size_t width = sizeof(T) / sizeof(double);
    for (std::size_t first = 0; first < columns.count; first += width) {
        const std::size_t left = columns.count - first, count = left < width ? left : width;
        const auto from = [&](const double* column, double usual) {
            return lanes_from<T>(column, first, count, usual);
        };
        const LeafInputs<T> in{from(columns.photons, 0),
                               from(columns.near_infrared, 0),
                               from(columns.thermal, 0),
                               from(columns.potential, 0),
                               from(columns.carboxylation, kind.photosynthesis.carboxylation.at_25),
                               from(columns.electron_transport, kind.photosynthesis.electron_transport.at_25),
                               from(columns.respiration, kind.photosynthesis.respiration.at_25),
                               from(columns.slope, kind.stomata.slope),
                               from(columns.width, kind.width)};
        SoughtLeaf<T> sought(kind, air, in);
        const LeafResults<T> found = sought.found();
        const auto put = [&](double* column, const T& lanes) { put_lanes<T>(column, first, count, lanes); };
        put(columns.assimilation, found.assimilation);
        put(columns.transpiration, found.transpiration);
        put(columns.conductance, found.conductance);
        put(columns.temperature, choose<T>(found.is_lost, all_of<T>(__builtin_nan("")), found.temperature));
        put(columns.internal, found.internal);
        put(columns.deficit, found.deficit);
        put(columns.sent, found.sent);
        if (columns.residual) put(columns.residual, leaf_residuals<T>(kind, air, in, found).largest());
        if (columns.by_potential) put(columns.by_potential, sought.transpiration_by_potential(found));
    }
}

}  // namespace espalier::environment::leaf
