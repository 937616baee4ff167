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

    InternodeIndex of(const FrameInternode& first) const {
        const Spot spot{first.plant, first.base};
        const InternodeIndex ended = best(tips_, spot, first.order);
        return ended.is_none() ? best(bases_, spot, first.order) : ended;
    }

    void add(InternodeIndex number) {
        const FrameInternode& internode = internodes_[number.row()];
        put(tips_[{internode.plant, internode.tip}], internode.order, number);
        put(bases_[{internode.plant, internode.base}], internode.order, number);
    }

private:
    /// The last internode of each order at one spot: any number of axes may meet there.
    using Candidates = std::vector<std::pair<std::uint16_t, InternodeIndex>>;
    using Spots = std::unordered_map<Spot, Candidates, SpotHash>;

    static void put(Candidates& candidates, std::uint16_t order, InternodeIndex number) {
        for (auto& [known, last] : candidates) {
            if (known != order) continue;
            last = number;
            return;
        }
        candidates.emplace_back(order, number);
    }

    // The last of lower order; if none is of lower order, the last.
    static InternodeIndex best(const Spots& spots, const Spot& spot, std::uint16_t order) {
        InternodeIndex lower, any;
        const auto found = spots.find(spot);
        if (found == spots.end()) return any;
        for (const auto& [known, last] : found->second) {
            any = std::max(any, last);
            if (known < order) lower = std::max(lower, last);
        }
        return lower.is_none() ? any : lower;
    }

    const std::vector<FrameInternode>& internodes_;
    Spots tips_, bases_;
};

FrameInternode internode(const FrameGeometry& geometry, LineIndex line, PointIndex base, PointIndex tip) {
    const std::size_t from = base.row(), to = tip.row();
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
            line,
            InternodeIndex(),
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
            FrameInternode next =
                internode(geometry, LineIndex(line), PointIndex(points[i - 1]), PointIndex(points[i]));
            next.bearer = i == 1 ? bearers.of(next) : InternodeIndex(internodes.size() - 1);
            internodes.push_back(next);
        }
        for (std::size_t i = first; i < internodes.size(); ++i) bearers.add(InternodeIndex(i));
    }
    return internodes;
}

}  // namespace espalier::geometry
