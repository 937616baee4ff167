#include "environment/soil/grid/senses.h"

#include "base/parallel.h"
#include "base/text.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

void require_finite(std::span<const Query> queries) {
    for (const Query& query : queries) {
        const std::size_t used = std::min<std::size_t>(query.parameters.size(), 4);
        for (std::size_t p = 0; p < used; ++p) {
            if (std::isfinite(query.parameters[p])) continue;
            throw RunError(fmt::format("plant {} asks for water with parameter {} = {}", query.plant, p + 1,
                                       format_general(query.parameters[p])));
        }
    }
}

/// Gravity and gradient, as the query weighs them.
glm::dvec3 weigh(const WaterParameters& parameters, const Query& query, const glm::dvec3& gradient) {
    const WaterLayer* layer = layer_at(parameters, query.pose.position.y);
    const glm::dvec3 down = layer ? layer->gravity : glm::dvec3(0, -1, 0);
    const double per_metre = parameters.gradient_length / parameters.range;
    return query.parameters[1] * down + query.parameters[2] * per_metre * gradient;
}

WaterWish sense(const WaterSenses& soil, const Query& query, Answer answer) {
    if (answer.empty()) return {};
    const std::size_t arity = answer.size();
    const WaterSample sample = sample_water(soil.grid, soil.faces, soil.contents, query.pose.position);
    if (arity == 2 || arity == 3) answer[1] = sample.content;
    if (arity >= 4) {
        const glm::dvec3 direction = weigh(soil.parameters, query, sample.gradient);
        for (int axis = 0; axis < 3; ++axis) answer[1 + axis] = direction[axis];
        if (arity >= 8) {
            const WaterHeading way = clear_heading(soil.grid, soil.solids, query.pose, direction, query.parameters[3]);
            for (int axis = 0; axis < 3; ++axis) answer[4 + axis] = way.heading[axis];
            answer[7] = way.clear;
        }
        if (arity >= 9) answer[8] = sample.content;
        if (arity >= 14) {
            answer[13] = soil.solids.distance_to_wall(query.pose.position, soil.grid, soil.joined_x, soil.joined_z);
        }
    }
    // A bound that no soil reaches keeps sums of wishes finite.
    return {sample.stencil, std::clamp(query.parameters[0], 0.0, 1e100) / soil.parameters.amount};
}

}  // namespace

std::vector<WaterWish> sense_water(const WaterSenses& soil, std::span<const Query> queries, std::span<Answer> answers) {
    require_finite(queries);
    std::vector<WaterWish> wishes(queries.size());
    for_in_parallel(tbb::blocked_range<std::size_t>(0, queries.size(), 64), [&](const auto& range) {
        for (std::size_t q = range.begin(); q != range.end(); ++q) wishes[q] = sense(soil, queries[q], answers[q]);
    });
    return wishes;
}

}  // namespace espalier::environment
