#include "environment/soil/solutes/root_uptake.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

struct VoxelUptake {
    double rate = 0, slope = 0;  ///< amount per volume and day; with the concentration
};

VoxelUptake uptake_at(const UptakeKinetics& kinetics, std::span<const RootSurface> roots, double concentration) {
    VoxelUptake all;
    for (const RootSurface& root : roots) {
        const SoluteFlow flow = solute_flow(kinetics, root.path, concentration);
        all.rate += root.surface * flow.flux;
        all.slope += root.surface * flow.by_concentration;
    }
    return all;
}

/// The concentration after an implicit step of `days`: amount(c) + days uptake(c) = `before`.
double implicit_step(const UptakeKinetics& kinetics, const Sorption& sorption, double content, double before,
                     std::span<const RootSurface> roots, double days) {
    double low = 0, high = sorption.concentration(content, before), guess = high;
    for (int i = 0; i < 200 && high > 0; ++i) {
        const VoxelUptake uptake = uptake_at(kinetics, roots, guess);
        const double excess = sorption.amount(content, guess) + days * uptake.rate - before;
        (excess > 0 ? high : low) = guess;
        double next = guess - excess / (sorption.capacity(content, guess) + days * uptake.slope);
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        const bool done = std::abs(next - guess) <= 1e-14 * guess;
        guess = next;
        if (done) break;
    }
    return guess;
}

void add_uptake(const UptakeKinetics& kinetics, std::span<const RootSurface> roots, double concentration, double days,
                std::span<double> taken) {
    for (std::size_t i = 0; i < roots.size(); ++i) {
        taken[i] += days * roots[i].surface * solute_flow(kinetics, roots[i].path, concentration).flux;
    }
}

}  // namespace

SolutePath SolutePath::of(double water, double distance, double conductivity) {
    if (!(distance > 0)) return {1, 0, water};
    const double x = std::min(water * distance / std::max(conductivity, 1e-300), 50.0);
    if (x < 1e-5) return {1 + x, distance / std::max(conductivity, distance * 1e-12) * (1 + 0.5 * x), water};
    const double enrichment = math::exp(x);
    return {enrichment, (enrichment - 1) / water, water};
}

SoluteFlow solute_flow(const UptakeKinetics& kinetics, const SolutePath& path, double concentration) {
    const double passive = kinetics.passive * path.water;
    const double g = 1 + path.resistance * passive, supply = path.enrichment * concentration;
    const double above = supply - g * kinetics.cmin;
    if (!(above > 0) || kinetics.vmax == 0) {
        const double surface = supply / g;
        return {passive * surface, passive * path.enrichment / g, surface};
    }
    // With u = c - cmin at the surface: g u^2 + b u - km above = 0.
    const double v = path.resistance * kinetics.vmax, b = g * kinetics.km + v - above;
    const double root = std::sqrt(b * b + 4 * g * kinetics.km * above);
    const double u = b > 0 ? 2 * kinetics.km * above / (b + root) : (root - b) / (2 * g);
    const double all = kinetics.km + u, slope = kinetics.vmax * kinetics.km / (all * all);
    const double surface = u + kinetics.cmin;
    return {kinetics.vmax * u / all + passive * surface,
            (slope + passive) * path.enrichment / (g + path.resistance * slope), surface};
}

double take_up(const UptakeKinetics& kinetics, const Sorption& sorption, double content, double amount,
               std::span<const RootSurface> roots, double days, std::span<double> taken) {
    constexpr double part = 0.29289321881345254;  // 1 - sqrt(1/2)
    std::fill(taken.begin(), taken.end(), 0);
    if (!(amount > 0)) return amount;
    const double first = implicit_step(kinetics, sorption, content, amount, roots, part * days);
    const double second_start = amount - (1 - part) * days * uptake_at(kinetics, roots, first).rate;
    if (second_start >= 0) {
        const double second = implicit_step(kinetics, sorption, content, second_start, roots, part * days);
        add_uptake(kinetics, roots, first, (1 - part) * days, taken);
        add_uptake(kinetics, roots, second, part * days, taken);
    } else {
        add_uptake(kinetics, roots, implicit_step(kinetics, sorption, content, amount, roots, days), days, taken);
    }
    double all = 0;
    for (const double one : taken) all += one;
    if (all > amount) {  // by rounding
        for (double& one : taken) one *= amount / all;
        return 0;
    }
    return amount - all;
}

}  // namespace espalier::environment
