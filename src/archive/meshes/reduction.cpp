#include "archive/meshes/reduction.h"

#include "espalier/base/random.h"

#include "archive/meshes/organ_levels.h"
#include "archive/meshes/outline_cost.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace espalier::archive {
namespace {

constexpr double slack = 0.05;  ///< by how much fewer triangles there may be than asked for
constexpr double longest_growth = 2;
constexpr double weight_of_trunk = 10;   ///< of a course: the eye sees a trunk lean by a tenth of what a limb may
constexpr double side_of_outline = 0.2;  ///< a tube of fewer sides is as wide in the mean: its outline hardly changes
constexpr int fewest_sides = 3, sides_of_line = 2;

/// Returns the mean width of a polygon within a circle of radius 1, over all directions (Cauchy: the perimeter by pi).
double mean_width(int sides) {
    return 2 * sides * std::sin(std::numbers::pi / std::max(sides, 1)) / std::numbers::pi;
}

/// The half side of a square of this area: how far the outline moves where such a thing goes.
double outline_error(double area) {
    return std::sqrt(area) / 2;
}

/// The same for an area that is changed for a number of triangles: a card of two has its own area.
double outline_error(double area, std::size_t triangles) {
    return outline_error(2 * area / static_cast<double>(std::max<std::size_t>(1, triangles)));
}

struct PositionOrder {
    bool operator()(const glm::vec3& a, const glm::vec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};

/// The tube that each stands on: it has a node where that begins. A tube that stands on none has its own number.
std::vector<std::size_t> bearers(const std::vector<PlannedTube>& tubes) {
    std::map<glm::vec3, std::size_t, PositionOrder> passed;
    for (std::size_t i = 0; i < tubes.size(); ++i) {
        const std::vector<TubeNode>& nodes = tubes[i].line.nodes;
        for (std::size_t k = 1; k < nodes.size(); ++k) passed.try_emplace(nodes[k].position, i);
    }
    std::vector<std::size_t> result(tubes.size());
    for (std::size_t i = 0; i < tubes.size(); ++i) {
        const auto place = passed.find(tubes[i].line.nodes.front().position);
        result[i] = place == passed.end() || tubes[i].line.stands_free ? i : place->second;
    }
    return result;
}

/// To each tube's own amount those of all that stand on it.
std::vector<double> with_borne(const std::vector<double>& own, const std::vector<std::size_t>& bearer) {
    constexpr int most_orders = 100;  // most orders of branching: crossing lines may seem to bear each other
    std::vector<double> sums = own;
    for (std::size_t i = 0; i < own.size(); ++i) {
        std::size_t at = i;
        for (int order = 0; order < most_orders && bearer[at] != at; ++order) sums[at = bearer[at]] += own[i];
    }
    return sums;
}

/// Finds the tube of a plant that passes nearest to a place.
class NearestTube {
public:
    NearestTube(const std::vector<PlannedTube>& tubes, const FrameAttributes& of_points) {
        for (std::size_t i = 0; i < tubes.size(); ++i) {
            for (const TubeNode& node : tubes[i].line.nodes) {
                nodes_[of_points.plants[node.point.row()]].push_back({node.position, i});
            }
        }
        for (auto& [plant, nodes] : nodes_) std::sort(nodes.begin(), nodes.end(), lower);
    }

    std::optional<std::size_t> of(std::uint32_t plant, const glm::vec3& place) const {
        const auto found = nodes_.find(plant);
        if (found == nodes_.end()) return std::nullopt;
        const std::vector<Node>& nodes = found->second;
        const Node *nearest = nullptr, *const begin = nodes.data(), *const end = begin + nodes.size();
        double least = std::numeric_limits<double>::infinity();
        const auto look = [&](const Node& node) {  // false: what lies farther up or down cannot be nearer
            if (std::abs(double(node.place.y) - place.y) > least) return false;
            const double distance = glm::distance(node.place, place);
            if (distance < least) nearest = &node, least = distance;
            return true;
        };
        const Node* const middle = std::lower_bound(begin, end, Node{place, 0}, lower);
        for (const Node* node = middle; node != end && look(*node);) ++node;
        for (const Node* node = middle; node != begin && look(*(node - 1));) --node;
        return nearest ? std::optional(nearest->tube) : std::nullopt;
    }

private:
    struct Node {
        glm::vec3 place;
        std::size_t tube;
    };

    static bool lower(const Node& a, const Node& b) {
        return std::tie(a.place.y, a.tube) < std::tie(b.place.y, b.tube);
    }

    std::map<std::uint32_t, std::vector<Node>> nodes_;
};

double area_of(const FrameMesh& mesh, const MeshPart& organ) {
    double area = 0;
    for (std::size_t i = 0; i < organ.triangles; ++i) {
        const auto [a, b, c] = mesh.triangles[organ.first_triangle + i];
        area += glm::length(glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
    }
    return area;
}

class Reduction {
public:
    /// What the shape may become.
    struct Limits {
        int fewest_sides;
        double longest_growth;  ///< longest growth of organs that stay
        bool keeps_outline;     ///< what counts is the area that changes, and an axis goes after what stands on it
        char up = 'y';          ///< vertical of the organs
    };

    Reduction(std::vector<PlannedTube>& tubes, FrameMesh& organs, const FrameAttributes& of_points,
              const Limits& limits)
        : tubes_(tubes), organs_(organs), limits_(limits) {
        if (limits_.keeps_outline) {
            bearer_ = bearers(tubes_);
            borne_.assign(tubes_.size(), 0);
            for (std::size_t i = 0; i < tubes_.size(); ++i) borne_[bearer_[i]] += bearer_[i] != i;
        }
        for (std::size_t i = 0; i < organs_.parts.size(); ++i) add_organ(i);
        of_organs_ = areas_of_organs(of_points);
        const std::vector<double> borne = areas_borne();
        for (std::size_t i = 0; i < tubes_.size(); ++i) add_tube(i, of_points, borne);
        add_removals();
    }

    void run_to_count(std::size_t target) {
        const auto fewest =
            std::max<std::size_t>(1, static_cast<std::size_t>((1 - slack) * static_cast<double>(target)));
        while (count_ > target && !moves_.empty()) {
            const Move move = moves_.top();
            moves_.pop();
            const std::size_t saving = saving_of(move);
            if (saving == 0 || count_ - saving < fewest || has_become_worse(move)) continue;
            count_ -= saving;
            apply(move);
        }
        write();
    }

    void run_to_error(double most) {
        while (!moves_.empty() && moves_.top().error <= most) {
            const Move move = moves_.top();
            moves_.pop();
            if (saving_of(move) > 0) apply(move);
        }
        write();
    }

private:
    enum class Effect { caps, node, side, tube, level, organ };
    /// The smallest error first; of equal ones, which comes first is decided by chance.
    struct Move {
        double error;
        std::uint64_t lot;
        Effect effect;
        std::size_t index;

        bool operator<(const Move& other) const {
            return std::tie(error, lot, effect, index) > std::tie(other.error, other.lot, other.effect, other.index);
        }
    };
    struct TubeState {
        std::vector<std::pair<double, std::size_t>> leaving;  ///< nodes by their errors, the next one last
        std::vector<bool> gone;
        std::size_t nodes;
        int sides;  ///< at first
        float thickest;
        double area, changed = 0;  ///< outline, and what has left its place
    };
    struct OrganState {
        const std::vector<OrganLevel>* levels;
        double size, area;
        std::size_t next = 0;  ///< the next of the levels
        std::size_t triangles;
        bool gone = false;
    };

    void add_tube(std::size_t i, const FrameAttributes& of_points, const std::vector<double>& borne) {
        const TubeLine& line = tubes_[i].line;
        TubeState& state = states_.emplace_back();
        state.nodes = line.nodes.size();
        state.sides = tubes_[i].sides;
        state.gone.assign(state.nodes, false);
        state.thickest = 0;
        for (const TubeNode& node : line.nodes) state.thickest = std::max(state.thickest, node.radius);
        state.area = outline_area(line);
        if (limits_.keeps_outline) {
            state.leaving =
                leaving_nodes(line, of_points, borne[i], (bearer_[i] == i ? weight_of_trunk : 1) * of_organs_[i]);
            std::reverse(state.leaving.begin(), state.leaving.end());
        } else {
            const std::vector<double> errors = node_errors(line, of_points);
            for (std::size_t k = 1; k + 1 < state.nodes; ++k) state.leaving.emplace_back(errors[k], k);
            std::sort(state.leaving.rbegin(), state.leaving.rend());
        }
        count_ += triangles_of_tube(i);
        if (tubes_[i].caps == Caps::round) push(0, Effect::caps, i);
        push_node(i);
        push_side(i);
        push_tube(i);
    }

    /// The organs on each tube and on all that it bears.
    std::vector<double> areas_of_organs(const FrameAttributes& of_points) const {
        std::vector<double> own(tubes_.size(), 0);
        if (!limits_.keeps_outline) return own;
        const NearestTube tubes(tubes_, of_points);
        for (std::size_t i = 0; i < organs_.parts.size(); ++i) {
            const glm::vec3& foot = organs_.points[organs_.parts[i].first_vertex];
            const glm::vec3 place = limits_.up == 'z' ? glm::vec3(foot.x, foot.z, -foot.y) : foot;
            if (const auto tube = tubes.of(organs_.parts[i].plant, place)) own[*tube] += organ_states_[i].area;
        }
        return with_borne(own, bearer_);
    }

    /// The outline of all that stands on each tube.
    std::vector<double> areas_borne() const {
        std::vector<double> own, borne;
        if (!limits_.keeps_outline) return borne;
        for (const PlannedTube& tube : tubes_) own.push_back(outline_area(tube.line));
        borne = with_borne(own, bearer_);
        for (std::size_t i = 0; i < borne.size(); ++i) borne[i] -= own[i];
        return borne;
    }

    void add_organ(std::size_t i) {
        const MeshPart& organ = organs_.parts[i];
        organ_states_.push_back(
            {&shapes_.of(organs_, organ), organ_size(organs_, organ), area_of(organs_, organ), 0, organ.triangles});
        count_ += organ.triangles;
        push_level(i);
    }

    // The fewer are left of a kind, the larger is what goes with the next: those that stay have grown.
    void add_removals() {
        for (const auto& [kind, members] : kinds()) {
            std::vector<std::pair<std::uint64_t, std::size_t>> drawn;
            for (const std::size_t i : members) drawn.emplace_back(mix(organs_.parts[i].identity), i);
            std::sort(drawn.begin(), drawn.end());
            for (std::size_t rank = 0; rank < drawn.size(); ++rank) {
                const std::size_t i = drawn[rank].second;
                const double left = static_cast<double>(drawn.size() - rank) / static_cast<double>(drawn.size());
                push(outline_error(organ_states_[i].area / left), Effect::organ, i);
            }
        }
    }

    std::map<std::pair<std::uint32_t, std::string>, std::vector<std::size_t>> kinds() const {
        std::map<std::pair<std::uint32_t, std::string>, std::vector<std::size_t>> result;
        for (std::size_t i = 0; i < organs_.parts.size(); ++i) {
            result[{organs_.parts[i].plant, organs_.parts[i].symbol}].push_back(i);
        }
        return result;
    }

    void push(double error, Effect effect, std::size_t index) { moves_.push({error, mix(index), effect, index}); }

    void push_node(std::size_t i) {
        if (states_[i].leaving.empty()) return;
        const double change = states_[i].leaving.back().first;
        const auto saving = 2 * static_cast<std::size_t>(tubes_[i].sides);
        push(limits_.keeps_outline ? outline_error(change, saving) : change, Effect::node, i);
    }

    void push_tube(std::size_t i) {
        if (!limits_.keeps_outline || borne_[i] == 0) push(error_of_tube(i), Effect::tube, i);
    }

    // Half of what has changed is where the tube is no longer.
    double error_of_tube(std::size_t i) const {
        const TubeState& state = states_[i];
        if (!limits_.keeps_outline) return outline_error(state.area);
        return outline_error(std::max(0.0, state.area - state.changed / 2) + of_organs_[i], triangles_of_tube(i));
    }

    // A tube that has lost nodes saves fewer triangles than when its move was made.
    bool has_become_worse(const Move& move) {
        if (move.effect != Effect::tube || !(error_of_tube(move.index) > move.error)) return false;
        push_tube(move.index);
        return true;
    }

    // A polygon of one corner less lies so far inside the circle.
    void push_side(std::size_t i) {
        const int sides = tubes_[i].sides - 1;
        if (sides < limits_.fewest_sides) return;
        const double inside = 1 - std::cos(std::numbers::pi / sides);
        push(limits_.keeps_outline ? outline_error(side_of_outline * inside * states_[i].area, 2 * states_[i].nodes)
                                   : inside * states_[i].thickest,
             Effect::side, i);
    }

    void push_level(std::size_t i) {
        const OrganState& organ = organ_states_[i];
        if (organ.next < organ.levels->size()) push((*organ.levels)[organ.next].error * organ.size, Effect::level, i);
    }

    std::size_t saving_of(const Move& move) const {
        const std::size_t i = move.index;
        switch (move.effect) {
            case Effect::caps:
                return 4;
            case Effect::node:
                return 2 * static_cast<std::size_t>(tubes_[i].sides);
            case Effect::side:
                return tubes_[i].sides == 0 ? 0 : 2 * states_[i].nodes;
            case Effect::tube:
                return triangles_of_tube(i);
            case Effect::level:
                return organ_states_[i].gone ? 0 : organ_states_[i].triangles - level(i).triangles.size();
            default:
                return organ_states_[i].triangles;
        }
    }

    std::size_t triangles_of_tube(std::size_t i) const {
        return swept_triangles(states_[i].nodes, tubes_[i].sides, tubes_[i].caps);
    }

    const OrganLevel& level(std::size_t i) const { return (*organ_states_[i].levels)[organ_states_[i].next]; }

    void apply(const Move& move) {
        const std::size_t i = move.index;
        if (move.effect == Effect::caps) {
            tubes_[i].caps = Caps::lean;
        } else if (move.effect == Effect::node) {
            states_[i].gone[states_[i].leaving.back().second] = true;
            states_[i].changed += states_[i].leaving.back().first;
            states_[i].leaving.pop_back();
            --states_[i].nodes;
            push_node(i);
        } else if (move.effect == Effect::side) {
            --tubes_[i].sides;
            push_side(i);
        } else if (move.effect == Effect::tube) {
            tubes_[i].sides = 0;
            if (limits_.keeps_outline && bearer_[i] != i && --borne_[bearer_[i]] == 0) push_tube(bearer_[i]);
        } else if (move.effect == Effect::level) {
            organ_states_[i].triangles = level(i).triangles.size();
            ++organ_states_[i].next;
            push_level(i);
        } else {
            organ_states_[i].gone = true;
        }
    }

    void write() {
        write_tubes();
        write_organs();
    }

    // Tubes of fewer sides are as wide as before in the mean.
    void write_tubes() {
        for (std::size_t i = 0; i < tubes_.size(); ++i) {
            std::vector<TubeNode> left;
            if (tubes_[i].sides == 0) continue;
            const auto widening = static_cast<float>(mean_width(states_[i].sides) / mean_width(tubes_[i].sides));
            for (std::size_t k = 0; k < states_[i].gone.size(); ++k) {
                if (states_[i].gone[k]) continue;
                left.push_back(tubes_[i].line.nodes[k]);
                left.back().radius *= widening;
            }
            tubes_[i].line.nodes = std::move(left);
        }
    }

    void write_organs() {
        FrameMesh left;
        left.materials = organs_.materials;
        for (const auto& [kind, members] : kinds()) {
            const float growth = growth_of(members);
            for (const std::size_t i : members) {
                if (!organ_states_[i].gone) write_organ(i, growth, left);
            }
        }
        organs_ = std::move(left);
    }

    float growth_of(const std::vector<std::size_t>& members) const {
        double all = 0, left = 0;
        for (const std::size_t i : members) {
            all += organ_states_[i].area;
            if (!organ_states_[i].gone) left += organ_states_[i].area;
        }
        return static_cast<float>(left > 0 ? std::min(limits_.longest_growth, std::sqrt(all / left)) : 1);
    }

    // Organs grow from their first vertex, where they stand on the plant.
    void write_organ(std::size_t i, float growth, FrameMesh& left) const {
        const MeshPart& organ = organs_.parts[i];
        const OrganState& state = organ_states_[i];
        constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> number(organ.vertices, unknown);
        MeshPart& moved = left.parts.emplace_back(organ);
        moved.first_vertex = left.points.size();
        moved.first_triangle = left.triangles.size();
        for (std::size_t k = 0; k < state.triangles; ++k) {
            std::array<std::uint32_t, 3> corners{};
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t vertex = state.next > 0
                                               ? (*state.levels)[state.next - 1].triangles[k][c]
                                               : organs_.triangles[organ.first_triangle + k][c] - organ.first_vertex;
                if (number[vertex] == unknown) {
                    number[vertex] = static_cast<std::uint32_t>(left.points.size());
                    copy_vertex(organ.first_vertex, organ.first_vertex + vertex, growth, left);
                }
                corners[c] = number[vertex];
            }
            left.triangles.push_back(corners);
            left.material_of.push_back(organs_.material_of[organ.first_triangle + (state.next > 0 ? 0 : k)]);
        }
        moved.vertices = left.points.size() - moved.first_vertex;
        moved.triangles = state.triangles;
    }

    void copy_vertex(std::size_t base, std::size_t vertex, float growth, FrameMesh& to) const {
        to.points.push_back(organs_.points[base] + growth * (organs_.points[vertex] - organs_.points[base]));
        to.normals.push_back(organs_.normals[vertex]);
        to.uvs.push_back(organs_.uvs[vertex]);
        to.rgb.push_back(organs_.rgb[vertex]);
    }

    std::vector<PlannedTube>& tubes_;
    FrameMesh& organs_;
    Limits limits_;
    OrganLevels shapes_;
    std::vector<TubeState> states_;
    std::vector<std::size_t> bearer_, borne_;  ///< the tube that each stands on, and how many stand on it
    std::vector<double>
        of_organs_;  ///< area of organs that would hang in the air without a tube, those on what it bears, too
    std::vector<OrganState> organ_states_;
    std::priority_queue<Move> moves_;
    std::size_t count_ = 0;
};

}  // namespace

void reduce(std::vector<PlannedTube>& tubes, FrameMesh& organs, const FrameAttributes& of_points, std::size_t triangles,
            char up) {
    Reduction(tubes, organs, of_points, {fewest_sides, longest_growth, true, up}).run_to_count(triangles);
}

void degrade(std::vector<PlannedTube>& tubes, FrameMesh& organs, const FrameAttributes& of_points, double tolerance) {
    Reduction(tubes, organs, of_points, {sides_of_line, std::numeric_limits<double>::infinity(), false})
        .run_to_error(tolerance);
    std::erase_if(tubes, [](const PlannedTube& tube) { return tube.sides == 0; });
}

}  // namespace espalier::archive
