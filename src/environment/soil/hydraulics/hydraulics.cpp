#include "environment/soil/hydraulics/hydraulics.h"

#include "espalier/base/math.h"

#include "base/octave_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::environment {
namespace {

using Suctions = OctaveTable<-10, 30>;
constexpr std::size_t node_count = Suctions::node_count;

/// A cubic by values and slopes at both ends (Hermite), at a part t of the way.
struct Cubic {
    double value, slope;
};

Cubic cubic(double t, double width, double v0, double v1, double s0, double s1) {
    const double d0 = s0 * width, d1 = s1 * width, rise = v1 - v0;
    const double c2 = 3 * rise - 2 * d0 - d1, c3 = d0 + d1 - 2 * rise;
    return {v0 + t * (d0 + t * (c2 + t * c3)), (d0 + t * (2 * c2 + t * 3 * c3)) / width};
}

/// By differences of the exact curve.
template <class Curve>
double slope_of(Curve curve, double suction) {
    const double step = 1e-4 * suction;
    return (curve(suction + step) - curve(suction - step)) / (2 * step);
}

}  // namespace

SoilHydraulics::SoilHydraulics(const SoilKind& soil) : soil_(soil), nodes_(node_count) {
    fill();
    integrate();
    limit_slopes();
}

void SoilHydraulics::fill() {
    const auto saturation = [&](double suction) { return effective_saturation(soil_, -suction); };
    const auto conducts = [&](double suction) { return conductivity(soil_, -suction); };
    for (std::size_t i = 0; i < node_count; ++i) {
        const double s = Suctions::node(i);
        nodes_[i] = {s, saturation(s), slope_of(saturation, s), conducts(s), slope_of(conducts, s), 0};
    }
}

/// From the dry end, so that differences of small potentials keep their digits. Gauss-Legendre with four points.
void SoilHydraulics::integrate() {
    static constexpr std::array<double, 2> points{0.3399810435848563, 0.8611363115940526};
    static constexpr std::array<double, 2> weights{0.6521451548625461, 0.3478548451374538};
    Node& last = nodes_.back();
    // Beyond the table the conductivity is a power of the suction.
    const double power = last.conductivity > 0 ? -last.conductivity_slope * last.suction / last.conductivity : 2;
    last.potential = power > 1 ? last.conductivity * last.suction / (power - 1) : last.conductivity * last.suction;
    for (std::size_t i = node_count - 1; i-- > 0;) {
        const double half = 0.5 * (nodes_[i + 1].suction - nodes_[i].suction);
        const double middle = 0.5 * (nodes_[i + 1].suction + nodes_[i].suction);
        double sum = 0;
        for (std::size_t p = 0; p < 2; ++p) {
            sum += weights[p] * (conductivity(soil_, -(middle - half * points[p])) +
                                 conductivity(soil_, -(middle + half * points[p])));
        }
        nodes_[i].potential = nodes_[i + 1].potential + half * sum;
    }
}

/// At most three times the rise to either side (Fritsch & Carlson 1980): no curve overshoots at an air-entry head.
void SoilHydraulics::limit_slopes() {
    const auto limit = [](double slope, double before, double after) {
        return std::max(slope, 3 * std::max(before, after));  // all fall with suction
    };
    for (std::size_t i = 0; i < node_count; ++i) {
        const std::size_t a = i > 0 ? i - 1 : i, b = i + 1 < node_count ? i + 1 : i;
        const auto rise = [&](std::size_t from, std::size_t to, double Node::*value) {
            if (from == to) return 0.0;
            return (nodes_[to].*value - nodes_[from].*value) / (nodes_[to].suction - nodes_[from].suction);
        };
        Node& node = nodes_[i];
        node.saturation_slope =
            limit(node.saturation_slope, rise(a, i, &Node::saturation), rise(i, b, &Node::saturation));
        node.conductivity_slope =
            limit(node.conductivity_slope, rise(a, i, &Node::conductivity), rise(i, b, &Node::conductivity));
    }
}

/// Between the table and full soil, a thousandth of a centimetre, all curves are straight: where n < 2 the conductivity
/// falls infinitely steeply from its value in full soil, which Newton's method would never settle at.
SoilPoint SoilHydraulics::nearly_full(double head) const {
    const Node& wettest = nodes_.front();
    const double width = wettest.suction, ks = soil_.conductivity;
    const double slope = (ks - wettest.conductivity) / width;
    const double full = wettest.potential + 0.5 * width * (ks + wettest.conductivity);
    if (!(head < 0)) return {head, soil_.saturated, 0, ks, 0, full + ks * head};
    const double capacity = (soil_.saturated - soil_.residual) * (1 - wettest.saturation) / width;
    return {head,  soil_.saturated + capacity * head,      capacity, ks + slope * head,
            slope, full + head * (ks + 0.5 * slope * head)};
}

/// Between two nodes: a part t of the way.
struct SoilHydraulics::Place {
    const Node &a, &b;
    double width, t;
};

SoilHydraulics::Place SoilHydraulics::place_of(double head) const {
    const double s = std::min(-head, nodes_.back().suction * (1 - 1e-15));
    const std::size_t i = Suctions::part_of(s);
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    const double width = b.suction - a.suction;
    return {a, b, width, (s - a.suction) / width};
}

SoilFlow SoilHydraulics::flow_at(const Place& place) {
    const auto& [a, b, width, t] = place;
    const Cubic conducts = cubic(t, width, a.conductivity, b.conductivity, a.conductivity_slope, b.conductivity_slope);
    const Cubic potential = cubic(t, width, a.potential, b.potential, -a.conductivity, -b.conductivity);
    return {conducts.value, -conducts.slope, potential.value};
}

SoilFlow SoilHydraulics::flow_at(double head) const {
    if (head < -nodes_.front().suction) return flow_at(place_of(head));
    const SoilPoint point = nearly_full(head);
    return {point.conductivity, point.slope, point.potential};
}

SoilPoint SoilHydraulics::at(double head) const {
    if (!(head < -nodes_.front().suction)) return nearly_full(head);
    const Place place = place_of(head);
    const auto& [a, b, width, t] = place;
    const Cubic saturation = cubic(t, width, a.saturation, b.saturation, a.saturation_slope, b.saturation_slope);
    const SoilFlow flow = flow_at(place);
    const double range = soil_.saturated - soil_.residual;
    return {head,
            soil_.residual + range * saturation.value,
            -range * saturation.slope,
            flow.conductivity,
            flow.slope,
            flow.potential};
}

double SoilHydraulics::head_at(double content, double guess) const {
    const double saturation = (content - soil_.residual) / (soil_.saturated - soil_.residual);
    return -suction_at(saturation, 1, &Node::saturation, &Node::saturation_slope, -guess);
}

double SoilHydraulics::head_of_conductivity(double value, double guess) const {
    return -suction_at(value, soil_.conductivity, &Node::conductivity, &Node::conductivity_slope, -guess);
}

/// The last node whose value is greater; the first one's is, and the last one's is not. Steps from `guess` that double
/// in length find two that bound it.
std::size_t SoilHydraulics::node_before(double wanted, double Node::*value, double guess) const {
    const double s = std::clamp(guess, nodes_.front().suction, nodes_[node_count - 2].suction);
    std::size_t low = Suctions::part_of(s), high = low + 1, step = 1;
    for (; !(nodes_[low].*value > wanted); step *= 2) {
        high = low;
        low -= std::min(step, low);
    }
    for (; nodes_[high].*value > wanted; step *= 2) {
        low = high;
        high = std::min(high + step, node_count - 1);
    }
    const auto first = nodes_.begin() + static_cast<std::ptrdiff_t>(low);
    const auto last = nodes_.begin() + static_cast<std::ptrdiff_t>(high);
    const auto after = std::partition_point(first, last, [&](const Node& node) { return node.*value > wanted; });
    return static_cast<std::size_t>(after - nodes_.begin()) - 1;
}

double SoilHydraulics::suction_at(double wanted, double full, double Node::*value, double Node::*slope,
                                  double guess) const {
    const Node &wettest = nodes_.front(), &driest = nodes_.back();
    if (wanted >= full) return 0;
    if (wanted >= wettest.*value) return wettest.suction * (full - wanted) / (full - wettest.*value);
    if (wanted <= driest.*value) return driest.suction * (1 - 1e-15);
    const std::size_t before = node_before(wanted, value, guess);
    const Node &a = nodes_[before], &b = nodes_[before + 1];
    const double width = b.suction - a.suction;
    double low = 0, high = 1, t = (a.*value - wanted) / (a.*value - b.*value);
    for (int i = 0; i < 60; ++i) {  // Newton between bounds
        const Cubic at = cubic(t, width, a.*value, b.*value, a.*slope, b.*slope);
        (at.value > wanted ? low : high) = t;
        const double step = at.slope < 0 ? (wanted - at.value) / (at.slope * width) : 2;
        const double next = t + step;
        if (std::abs(step) <= 1e-8) return a.suction + next * width;  // the next step would be its square
        t = next > low && next < high ? next : 0.5 * (low + high);
    }
    return a.suction + t * width;
}

}  // namespace espalier::environment
