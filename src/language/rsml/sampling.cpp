#include "language/rsml/sampling.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace espalier::language::rsml {
namespace {

struct Knot {
    double position, value;
};

/// Places along the root of all samples: numbers of points, or lengths.
std::vector<double> positions_of(const RawRoot& root, const RawFunction& function, double length,
                                 measured::Notes& notes) {
    const std::size_t count = function.samples.size();
    std::vector<double> positions(count);
    if (function.domain == Domain::length && function.positions.empty()) {
        notes.warn(fmt::format("function '{}' is along the length, and its samples have no positions: they are spread "
                               "evenly",
                               function.name),
                   function.place);
    }
    const bool is_even = function.domain == Domain::uniform || function.domain == Domain::length;
    if (is_even || !function.positions.empty()) {
        const double step = function.step.value_or(count > 1 ? (length - function.origin) / double(count - 1) : 0);
        for (std::size_t i = 0; i < count; ++i) positions[i] = function.origin + static_cast<double>(i) * step;
        return function.positions.empty() ? positions : function.positions;
    }
    if (count != root.points.size() && count > 1) {
        notes.warn(
            fmt::format("function '{}' has another number of samples than its root has points: {}", function.name,
                        count < root.points.size() ? "the last one counts on" : "those behind are not used"),
            function.place);
    }
    std::iota(positions.begin(), positions.end(), 0.0);
    return positions;
}

bool is_by_number(const RawFunction& function) {
    return function.domain == Domain::polyline && function.positions.empty();
}

}  // namespace

std::vector<double> arc_lengths(const RawRoot& root) {
    std::vector<double> lengths(root.points.size(), 0.0);
    for (std::size_t i = 1; i < root.points.size(); ++i) {
        const bool breaks = std::binary_search(root.breaks.begin(), root.breaks.end(), i);
        lengths[i] = lengths[i - 1] + (breaks ? 0 : glm::distance(root.points[i - 1], root.points[i]));
    }
    return lengths;
}

std::vector<double> values_at_nodes(const RawRoot& root, const RawFunction& function, measured::Notes& notes) {
    const std::vector<double> lengths = arc_lengths(root);
    const std::vector<double> positions = positions_of(root, function, lengths.back(), notes);
    std::vector<Knot> knots;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (std::isnan(function.samples[i])) {
            notes.warn(fmt::format("a sample of function '{}' has no value: its neighbours count", function.name),
                       function.place);
            continue;
        }
        knots.push_back({positions[i], function.term.factor * function.samples[i]});
    }
    if (knots.empty()) return {};
    std::stable_sort(knots.begin(), knots.end(), [](const Knot& a, const Knot& b) { return a.position < b.position; });
    std::vector<double> values;
    auto next = knots.begin();
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const double at = is_by_number(function) ? static_cast<double>(i) : lengths[i];
        while (next != knots.end() && next->position < at) ++next;
        if (next == knots.begin() || next == knots.end()) {
            values.push_back(next == knots.begin() ? next->value : knots.back().value);
            continue;
        }
        const Knot& before = *(next - 1);
        const double share = (at - before.position) / (next->position - before.position);
        values.push_back(before.value + share * (next->value - before.value));
    }
    return values;
}

}  // namespace espalier::language::rsml
