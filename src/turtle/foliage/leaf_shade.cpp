#include "turtle/foliage/leaf_shade.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace espalier::turtle {

void thin_in_shade(std::vector<std::uint32_t>& counts, const std::vector<BearingNode>& nodes,
                   const PlantGeometry& geometry, const LeafShade& shade, RandomKey key) {
    const double column = 4 * shade.size;
    const auto place = [&](std::size_t node) -> const glm::dvec3& {
        return geometry.internodes[nodes[node].first].tip;
    };
    std::vector<std::size_t> downwards(nodes.size());
    std::iota(downwards.begin(), downwards.end(), std::size_t{0});
    std::stable_sort(downwards.begin(), downwards.end(),
                     [&](std::size_t a, std::size_t b) { return place(a).y > place(b).y; });
    std::map<std::pair<std::int64_t, std::int64_t>, double> kept;  // leaves so far, by column
    for (const std::size_t node : downwards) {
        const glm::dvec3& at = place(node);
        double& above = kept[{std::llround(at.x / column), std::llround(at.z / column)}];
        const double index = above * shade.area / (column * column);
        const double wanted = counts[node] * math::exp(-shade.extinction * index), sure = std::floor(wanted);
        const bool one_more = RandomSamples(key, nodes[node].identity, 0x7368).uniform() < wanted - sure;
        counts[node] = static_cast<std::uint32_t>(sure) + (one_more ? 1 : 0);
        above += counts[node];
    }
}

}  // namespace espalier::turtle
