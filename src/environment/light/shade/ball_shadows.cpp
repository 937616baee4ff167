#include "environment/light/shade/ball_shadows.h"

#include "base/vector_clones.h"
#include "environment/light/shade/eight_reals.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace espalier::environment {
namespace {

/// (acos c - c sqrt(1 - c^2)) / (1 - c)^(3/2) as a polynomial of 1 - c from 0 to 1: interpolation at 16 Chebyshev
/// nodes, wrong by 1e-15 at most.
constexpr double segment_coefficients[] = {
    1.8856180831641272,      -0.2828427124748155,     -0.02525381359717591,    -0.0049104643125098225,
    -0.0012555066393815219,  -0.0003719273737249993,  -0.00012014876484699161, -4.515667683028001e-05,
    -4.3412131542225495e-06, -3.186213738549924e-05,  4.3186052405489646e-05,  -5.770839026047147e-05,
    4.970976574930569e-05,   -2.9805370067048284e-05, 1.0652941367779749e-05,  -1.8581786001011903e-06};

/// The areas of segments of the unit circle beyond chords at these distances from the centre; below -1 it is all of the
/// circle, above 1 nothing.
__attribute__((always_inline)) inline void turn_to_segments(EightReals& distances) {
    const EightReals size = distances < 0.0 ? -distances : distances;
    const EightReals height = size > 1.0 ? EightReals{} : 1.0 - size;
    EightReals area = EightReals{} + segment_coefficients[std::size(segment_coefficients) - 1];
#pragma GCC unroll 16
    for (std::size_t k = std::size(segment_coefficients) - 1; k-- > 0;) area = area * height + segment_coefficients[k];
    EightReals roots = height;
    take_roots(roots);
    area *= height * roots;
    distances = distances < 0.0 ? std::numbers::pi - area : area;
}

/// The areas that discs of radius `own` and these radii share, in units of own^2, from the squares of the distances of
/// their centres: of each a segment beyond the chord that the circles share. Where there is no chord, these are whole
/// or nothing.
__attribute__((always_inline)) inline void find_shared(const EightReals& aside2, const EightReals& radius, double own,
                                                       EightReals& shared) {
    EightReals apart = aside2;
    take_roots(apart);
    apart += 1e-150;  // discs with one centre have no chord
    const EightReals from_own = (apart * apart + (own - radius) * (own + radius)) / (2.0 * apart);
    EightReals of_own = from_own / own, of_other = (apart - from_own) / radius;
    turn_to_segments(of_own);
    turn_to_segments(of_other);
    const EightReals ratio = radius / own;
    shared = of_own + ratio * ratio * of_other;
}

ESPALIER_VECTOR_CLONES
double product_of_areas(const double* ahead, const double* aside2, const double* radius, std::size_t count, double own,
                        double opacity) {
    EightReals parts = EightReals{} + 1.0;
    for (std::size_t begin = 0; begin < count; begin += lanes) {
        EightReals along, aside, radii, shared;
        load(along, ahead + begin);
        load(aside, aside2 + begin);
        load(radii, radius + begin);
        find_shared(aside, radii, own, shared);
        const EightReals part = 1.0 - opacity * shared;
        parts *= along > 0.0 ? part : EightReals{} + 1.0;
    }
    double product = 1;
    for (std::size_t k = 0; k < lanes; ++k) product *= parts[k];
    return product;
}

}  // namespace

double sum_of_chords(const BallsMet& met, double margin) {
    double sum = 0;
    for (std::size_t k = 0; k < met.count; ++k) {
        const double reach = met.radius[k] + margin;
        const double half = std::sqrt(std::max(reach * reach - met.aside2[k], 0.0));
        const double behind = std::max(half - met.ahead[k], 0.0);
        sum += (2 * half - behind) / (2 * reach);
    }
    return sum;
}

double passed_by_areas(BallsMet& met, double radius, double transmittance) {
    for (std::size_t k = met.count; k < met.count + lanes - 1; ++k) {
        met.ahead[k] = -1;
        met.aside2[k] = 0;
        met.radius[k] = 1;
    }
    const double opacity = (1 - transmittance) / std::numbers::pi;
    return product_of_areas(met.ahead.data(), met.aside2.data(), met.radius.data(), met.count, radius, opacity);
}

}  // namespace espalier::environment
