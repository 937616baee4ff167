// Shapes from a line of TOML, and points to try them at.
#pragma once

#include "espalier/base/random.h"
#include "espalier/environment/shape.h"

#include <memory>
#include <string>
#include <vector>

namespace espalier {

using namespace espalier::environment;

inline std::shared_ptr<const Shape> shape_of(const std::string& toml) {
    Settings table = Settings::parse_toml(toml, "test.toml");
    const std::shared_ptr<const Shape> shape = read_shape(table);
    table.reject_unread();
    return shape;
}

/// `count` points uniformly in a cube around the origin.
inline std::vector<glm::dvec3> random_points(int count, double half_side) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) {
        RandomSamples samples(RandomKey(1, 0, Stream::process), static_cast<std::uint64_t>(i), 0);
        const double x = samples.uniform(), y = samples.uniform(), z = samples.uniform();
        points.push_back((glm::dvec3(x, y, z) * 2.0 - 1.0) * half_side);
    }
    return points;
}

}  // namespace espalier
