#include "environment/soil/grid/queries.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "base/text.h"
#include "environment/exchange/changing_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

void require_finite(Queries queries) {
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
glm::dvec3 weigh(const SensedSoil& soil, const SoilQuerying& querying, const Query& query, const glm::dvec3& gradient) {
    const glm::dvec3 down = soil.down_at ? soil.down_at(query.pose.position.y) : glm::dvec3(0, -1, 0);
    const double per_metre = querying.gradient_length / querying.range;
    return query.parameters[1] * down + query.parameters[2] * per_metre * gradient;
}

WaterWish sense_one(const SensedSoil& soil, const SoilQuerying& querying, const Query& query, Answer answer) {
    if (answer.empty()) return {};
    const std::size_t arity = answer.size();
    const WaterSample sample = sample_water(soil.grid, soil.faces, soil.contents, query.pose.position);
    if (arity == 2 || arity == 3) answer[1] = sample.content;
    if (arity >= 4) {
        const glm::dvec3 direction = weigh(soil, querying, query, sample.gradient);
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
    return {sample.stencil, std::clamp(query.parameters[0], 0.0, 1e100) / querying.amount};
}

}  // namespace

SoilQueries::SoilQueries(const SoilQuerying& querying, const EnvironmentContext& context)
    : querying_(querying),
      name_(context.name),
      warnings_(context.warnings),
      uptake_(context.plants, 0),
      wish_(context.plants, 0) {}

std::vector<WaterWish> SoilQueries::sense(const SensedSoil& soil, Queries queries, std::span<Answer> answers) {
    std::fill(uptake_.begin(), uptake_.end(), 0);
    std::fill(wish_.begin(), wish_.end(), 0);
    require_finite(queries);
    std::vector<WaterWish> wishes(queries.size());
    for_in_parallel(tbb::blocked_range<std::size_t>(0, queries.size(), 64), [&](const auto& range) {
        for (std::size_t q = range.begin(); q != range.end(); ++q) {
            wishes[q] = sense_one(soil, querying_, queries[q], answers[q]);
        }
    });
    warn_of_wishes_beyond_voxels(queries);
    return wishes;
}

double SoilQueries::obtain(const WaterGrid& grid, std::span<const WaterWish> wishes, Queries queries,
                           std::span<Answer> answers, WaterBrick& stock) {
    const ShareResult result = querying_.depletion ? share_water(grid, wishes, stock) : lend_water(grid, wishes, stock);
    for (std::size_t q = 0; q < queries.size(); ++q) {
        if (answers[q].empty()) continue;
        answers[q][0] = result.obtained[q] * querying_.amount;
        if (queries[q].plant >= uptake_.size()) continue;
        uptake_[queries[q].plant] += answers[q][0];
        wish_[queries[q].plant] += wishes[q].amount * querying_.amount;
    }
    return result.taken;
}

// Once. Wishes in content times voxels are a million times too large where voxels of a centimetre count as volumes.
void SoilQueries::warn_of_wishes_beyond_voxels(Queries queries) {
    const double most = 8 * querying_.amount;  // eight voxels of nothing but water
    if (!warnings_ || querying_.amount == 1) return;
    for (const Query& query : queries) {
        if (query.parameters[0] <= most) continue;
        warnings_->push_back({Diagnostic::Severity::warning, querying_.amount_place,
                              fmt::format("plant {} requests {:g} of '{}', but a voxel holds at most {:.3g}: with "
                                          "amount = \"volume\", requests are content times m3. Request less, or use "
                                          "amount = \"content\"",
                                          query.plant, query.parameters[0], name_, querying_.amount),
                              ""});
        warnings_ = nullptr;
        return;
    }
}

std::vector<Quantity> SoilQueries::statistics(std::uint32_t plant, std::vector<Quantity> others) const {
    others.insert(others.begin(), {{"uptake", plant < uptake_.size() ? uptake_[plant] : 0, querying_.unit()},
                                   {"wish", plant < wish_.size() ? wish_[plant] : 0, querying_.unit()}});
    return others;
}

void SoilQueries::save(std::ostream& out) const {
    write_doubles(out, uptake_);
    write_doubles(out, wish_);
}

void SoilQueries::restore(std::istream& in) {
    read_doubles(in, uptake_);
    read_doubles(in, wish_);
}

std::vector<ChangingSetting> changing_settings_of(SoilQuerying& querying) {
    return {changing("range", Range::positive(), querying.range),
            changing("gradient_length", Range::positive(), querying.gradient_length)};
}

}  // namespace espalier::environment
