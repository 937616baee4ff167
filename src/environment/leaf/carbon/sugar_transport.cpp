#include "environment/leaf/carbon/sugar_transport.h"

#include "espalier/base/error.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment::carbon {
namespace {

double taken(double most, double half, double concentration) {
    return most * concentration / (half + concentration);
}

double slope(double most, double half, double concentration) {
    return most * half / ((half + concentration) * (half + concentration));
}

}  // namespace

/// One step of Newton's method. Returns the greatest relative change.
double SugarTransport::correct(const std::vector<SugarNode>& nodes, double days, const HalfSaturation& half) {
    std::vector<double>& c = concentrations_;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const SugarNode& node = nodes[i];
        rest_[i] = (node.sugar - node.volume * c[i]) / days + node.source - taken(node.sink, half.sink, c[i]) -
                   taken(node.upkeep, half.upkeep, c[i]);
        diagonal_[i] = node.volume / days + slope(node.sink, half.sink, c[i]) + slope(node.upkeep, half.upkeep, c[i]);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const SugarNode& node = nodes[i];
        if (node.bearer == SugarNode::no_bearer) continue;
        const double flow = node.conductance * (c[node.bearer] - c[i]);
        rest_[i] += flow;
        rest_[node.bearer] -= flow;
        diagonal_[i] += node.conductance;
        diagonal_[node.bearer] += node.conductance;
    }
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const SugarNode& node = nodes[i];
        if (node.bearer == SugarNode::no_bearer) continue;
        const double share = node.conductance / diagonal_[i];
        diagonal_[node.bearer] -= share * node.conductance;
        rest_[node.bearer] += share * rest_[i];
    }
    double greatest = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const SugarNode& node = nodes[i];
        // rest_ becomes the change.
        if (node.bearer != SugarNode::no_bearer) rest_[i] += node.conductance * rest_[node.bearer];
        rest_[i] /= diagonal_[i];
        const double before = c[i];
        c[i] = std::max(0.0, before + rest_[i]);
        greatest = std::max(greatest, std::abs(c[i] - before) / std::max(c[i], 1e-12));
    }
    return greatest;
}

const std::vector<double>& SugarTransport::concentrations(const std::vector<SugarNode>& nodes, double days,
                                                          const HalfSaturation& half) {
    concentrations_.resize(nodes.size());
    diagonal_.resize(nodes.size());
    rest_.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) concentrations_[i] = nodes[i].sugar / nodes[i].volume;
    constexpr int most = 200;
    constexpr double enough = 1e-13;
    double last = 1;
    for (int k = 0; k < most; ++k) {
        const double change = correct(nodes, days, half);
        // Rounding keeps stiff trees from the goal; they stand still just above it.
        if (change < enough || (change < 1e-9 && change >= last)) return concentrations_;
        last = change;
    }
    throw RunError("the transport of sugar does not converge: shorten the step, or widen the thinnest internodes");
}

}  // namespace espalier::environment::carbon
