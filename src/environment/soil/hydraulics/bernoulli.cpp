#include "environment/soil/hydraulics/bernoulli.h"

#include "espalier/base/math.h"

#include "base/octave_table.h"

#include <cmath>
#include <vector>

namespace espalier::environment {
namespace {

using Table = OctaveTable<-50, 6>;

struct Node {
    double b, x, slope;
};

/// Newton on ln B(x) = ln b, from a start near by.
double solve(double b, double x) {
    for (int i = 0; i < 50; ++i) {
        const ValueAndSlope at = bernoulli(x);
        const double step = (math::log(at.value) - math::log(b)) * at.value / at.slope;
        x -= step;
        if (std::abs(step) <= 1e-14 * (1 + std::abs(x))) break;
    }
    return x;
}

std::vector<Node> make_nodes() {
    std::vector<Node> nodes(Table::node_count);
    double x = -64;
    for (std::size_t i = Table::node_count; i-- > 0;) {
        const double b = Table::node(i);
        x = b == 1 ? 0 : solve(b, x);
        nodes[i] = {b, x, 1 / bernoulli(x).slope};
    }
    return nodes;
}

}  // namespace

ValueAndSlope bernoulli(double x) {
    if (std::abs(x) < 0.02) {
        const double x2 = x * x;
        return {1 - x / 2 + x2 / 12 - x2 * x2 / 720, -0.5 + x / 6 - x * x2 / 180};
    }
    if (x > 700) return {0, 0};
    if (x < -700) return {-x, -1};
    const double value = x / (math::exp(x) - 1);
    return {value, value * (1 - (value + x)) / x};  // B(-x) = B(x) + x
}

ValueAndSlope inverse_bernoulli(double b) {
    static const std::vector<Node> nodes = make_nodes();
    if (b >= nodes.back().b) return {-b, -1};  // to 1e-26
    if (b <= nodes.front().b) {
        if (!(b > 1e-300)) b = 1e-300;
        const double x = solve(b, nodes.front().x);
        const double slope = bernoulli(x).slope;
        return {x, slope < 0 ? 1 / slope : -1 / b};
    }
    const std::size_t i = Table::part_of(b);
    const Node &p = nodes[i], &q = nodes[i + 1];
    const double width = q.b - p.b, t = (b - p.b) / width;
    const double d0 = p.slope * width, d1 = q.slope * width, rise = q.x - p.x;
    const double c2 = 3 * rise - 2 * d0 - d1, c3 = d0 + d1 - 2 * rise;
    return {p.x + t * (d0 + t * (c2 + t * c3)), (d0 + t * (2 * c2 + t * 3 * c3)) / width};
}

}  // namespace espalier::environment
