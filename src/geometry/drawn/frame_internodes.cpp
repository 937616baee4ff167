#include "espalier/geometry/frame_geometry.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>
#include <vector>

namespace espalier::geometry {
namespace {

/// A place of a plant, bit for bit: an axis begins exactly where the turtle was.
struct Spot {
    std::uint32_t plant;
    glm::vec3 position;

    bool operator==(const Spot&) const = default;
};

struct SpotHash {
    std::size_t operator()(const Spot& spot) const {
        std::uint64_t hash = spot.plant;
        for (int k = 0; k < 3; ++k) {
            const float coordinate = spot.position[k] == 0 ? 0.0f : spot.position[k];  // -0 is equal to 0
            hash = (hash ^ std::bit_cast<std::uint32_t>(coordinate)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        return static_cast<std::size_t>(hash);
    }
};

/// Finds what an axis stands on, among the axes that came before it.
class Bearers {
public:
    explicit Bearers(const std::vector<FrameInternode>& internodes) : internodes_(internodes) {}

    std::int32_t of(const FrameInternode& first) const {
        const Spot spot{first.plant, first.base};
        const std::int32_t ended = best(tips_, spot, first.order);
        return ended != FrameInternode::none ? ended : best(bases_, spot, first.order);
    }

    void add(std::int32_t number) {
        const FrameInternode& internode = internodes_[static_cast<std::size_t>(number)];
        put(tips_[{internode.plant, internode.tip}], internode.order, number);
        put(bases_[{internode.plant, internode.base}], internode.order, number);
    }

private:
    /// The last internode of each order at one spot: any number of axes may meet there.
    using Candidates = std::vector<std::pair<std::uint16_t, std::int32_t>>;
    using Spots = std::unordered_map<Spot, Candidates, SpotHash>;

    static void put(Candidates& candidates, std::uint16_t order, std::int32_t number) {
        for (auto& [known, last] : candidates) {
            if (known != order) continue;
            last = number;
            return;
        }
        candidates.emplace_back(order, number);
    }

    // The last of lower order; if none is of lower order, the last.
    static std::int32_t best(const Spots& spots, const Spot& spot, std::uint16_t order) {
        std::int32_t lower = FrameInternode::none, any = FrameInternode::none;
        const auto found = spots.find(spot);
        if (found == spots.end()) return any;
        for (const auto& [known, last] : found->second) {
            any = std::max(any, last);
            if (known < order) lower = std::max(lower, last);
        }
        return lower != FrameInternode::none ? lower : any;
    }

    const std::vector<FrameInternode>& internodes_;
    Spots tips_, bases_;
};

FrameInternode internode(const FrameGeometry& geometry, std::size_t line, std::int32_t base, std::int32_t tip) {
    const auto from = static_cast<std::size_t>(base), to = static_cast<std::size_t>(tip);
    const FrameAttributes& of = geometry.of_points;
    return {geometry.points[from],
            geometry.points[to],
            geometry.radii[from],
            geometry.radii[to],
            of.identities[to],
            of.parents[to],
            of.plants[to],
            of.symbols[to],
            of.orders[to],
            of.colours[to],
            of.births[to],
            static_cast<std::uint32_t>(line),
            FrameInternode::none,
            base,
            tip};
}

}  // namespace

std::vector<FrameInternode> internodes_of(const FrameGeometry& geometry) {
    std::vector<FrameInternode> internodes;
    Bearers bearers(internodes);
    for (std::size_t line = 0; line < geometry.lines.size(); ++line) {
        if (geometry.of_cells.kinds[geometry.lines.first + line] != Kind::axis) continue;
        const auto points = geometry.lines[line];
        const std::size_t first = internodes.size();
        for (std::size_t i = 1; i < points.size(); ++i) {
            FrameInternode next = internode(geometry, line, points[i - 1], points[i]);
            next.bearer = i == 1 ? bearers.of(next) : static_cast<std::int32_t>(internodes.size()) - 1;
            internodes.push_back(next);
        }
        for (std::size_t i = first; i < internodes.size(); ++i) bearers.add(static_cast<std::int32_t>(i));
    }
    return internodes;
}

}  // namespace espalier::geometry
