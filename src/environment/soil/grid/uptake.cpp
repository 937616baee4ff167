#include "environment/soil/grid/uptake.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>

namespace espalier::environment {
namespace {

/// A wish's demand on one voxel.
struct Demand {
    std::size_t cell;
    double amount;
    std::size_t entry;  ///< wish * 8 + corner

    bool operator<(const Demand& other) const {
        return std::tie(cell, amount, entry) < std::tie(other.cell, other.amount, other.entry);
    }
};

std::vector<Demand> demands_of(const WaterGrid& grid, std::span<const WaterWish> wishes) {
    std::vector<Demand> demands;
    for (std::size_t wish = 0; wish < wishes.size(); ++wish) {
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const double amount = wishes[wish].amount * wishes[wish].stencil.weight[corner];
            if (amount > 0)
                demands.push_back({grid.cell(wishes[wish].stencil.voxel[corner]), amount, 8 * wish + corner});
        }
    }
    // Sorted by amount within a voxel, demands add up to the same bits in whatever order they were asked.
    tbb::parallel_sort(demands.begin(), demands.end());
    return demands;
}

}  // namespace

ShareResult share_water(const WaterGrid& grid, std::span<const WaterWish> wishes, WaterBrick& contents) {
    const std::vector<Demand> demands = demands_of(grid, wishes);
    ShareResult result;
    std::vector<std::array<double, 8>> shares(wishes.size(), std::array<double, 8>{});
    for (auto first = demands.begin(); first != demands.end();) {
        const auto last =
            std::find_if(first, demands.end(), [&](const Demand& demand) { return demand.cell != first->cell; });
        double total = 0;
        for (auto demand = first; demand != last; ++demand) total += demand->amount;
        double& stock = contents[first->cell];
        const double granted = total > stock ? stock / total : 1;
        for (auto demand = first; demand != last; ++demand) {
            shares[demand->entry / 8][demand->entry % 8] = granted * demand->amount;
        }
        result.taken += std::min(total, stock);
        stock = total > stock ? 0 : stock - total;
        first = last;
    }
    result.obtained.reserve(wishes.size());
    for (const auto& share : shares) result.obtained.push_back(sum_in_pairs(share));
    return result;
}

ShareResult lend_water(const WaterGrid& grid, std::span<const WaterWish> wishes, const WaterBrick& contents) {
    ShareResult result;
    result.obtained.reserve(wishes.size());
    for (const WaterWish& wish : wishes) {
        std::array<double, 8> shares{};
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const double demand = wish.amount * wish.stencil.weight[corner];
            if (demand > 0) shares[corner] = std::min(demand, contents[grid.cell(wish.stencil.voxel[corner])]);
        }
        result.obtained.push_back(sum_in_pairs(shares));
    }
    return result;
}

}  // namespace espalier::environment
