#include "archive/meshes/outline_cost.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <tuple>

namespace espalier::archive {
namespace {

double area_of_piece(const TubeNode& from, const TubeNode& to) {
    return glm::distance(from.position, to.position) * (double(from.radius) + to.radius);
}

/// How far a node lies from a straight and evenly tapering piece: its middle, and its outline.
struct Deviation {
    double middle, radius;
};

Deviation deviation(const TubeNode& node, const TubeNode& from, const TubeNode& to) {
    const glm::dvec3 a(from.position), along = glm::dvec3(to.position) - a, here = glm::dvec3(node.position) - a;
    const double square = glm::dot(along, along);
    const double share = square > 0 ? std::clamp(glm::dot(here, along) / square, 0.0, 1.0) : 0.0;
    return {glm::length(here - share * along),
            std::abs(node.radius - std::lerp(double{from.radius}, double{to.radius}, share))};
}

/// Lets the nodes of a tube go one after the other, always where the least area changes.
class Leaving {
public:
    Leaving(const TubeLine& line, const FrameAttributes& of_points, double borne, double organs)
        : nodes_(line.nodes),
          of_(of_points),
          borne_(borne),
          organs_(organs),
          before_(nodes_.size()),
          behind_(nodes_.size()) {
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            before_[i] = i - 1;
            behind_[i] = i + 1;
        }
        // Of equal changes the shortest comes first, so that no piece is looked at again and again.
        tie_ = 1e-9 * outline_area(line) / double(nodes_.size());
    }

    std::vector<std::pair<double, std::size_t>> order() {
        for (std::size_t i = 1; i + 1 < nodes_.size(); ++i) push(i);
        std::vector<bool> gone(nodes_.size(), false);
        std::vector<std::pair<double, std::size_t>> result;
        double most = 0;
        while (!changes_.empty()) {
            const Change change = changes_.top();
            changes_.pop();
            const std::size_t i = change.node, from = before_[i], to = behind_[i];
            if (gone[i] || from != change.from || to != change.to) continue;
            gone[i] = true;
            most = std::max(most, change.area);
            result.emplace_back(most, i);
            behind_[from] = to;
            before_[to] = from;
            changed_[{from, to}] = area_changed(from, to);
            if (from > 0) push(from);
            if (to + 1 < nodes_.size()) push(to);
        }
        return result;
    }

private:
    struct Change {
        double area;
        std::size_t node, from, to;

        bool operator<(const Change& other) const { return std::tie(area, node) > std::tie(other.area, other.node); }
    };

    void push(std::size_t i) {
        const std::size_t from = before_[i], to = behind_[i];
        const double area = area_changed(from, to) - already_changed(from, i) - already_changed(i, to);
        changes_.push({std::max(0.0, area) + tie_ * double(to - from), i, from, to});
    }

    double already_changed(std::size_t from, std::size_t to) const {
        const auto found = changed_.find({from, to});
        return found == changed_.end() ? 0 : found->second;
    }

    double area_changed(std::size_t from, std::size_t to) const {
        double area = 0, out_of_wood = 0, farthest = 0;
        Deviation last{0, 0};
        for (std::size_t i = from + 1; i <= to; ++i) {
            Deviation now = deviation(nodes_[i], nodes_[from], nodes_[to]);
            if (i < to && !same_look(of_, nodes_[i].point, nodes_[i + 1].point)) {
                now.middle = std::max(now.middle, double(nodes_[i].radius));
            }
            const double width = double(nodes_[i - 1].radius) + nodes_[i].radius;
            const double moved = (last.middle + now.middle) / 2 + last.radius + now.radius;
            if (width > 0) area += 2 * area_of_piece(nodes_[i - 1], nodes_[i]) * std::min(1.0, moved / width);
            out_of_wood = std::max(out_of_wood, now.middle / std::max(1e-9, double(nodes_[i].radius)) - 1);
            farthest = std::max(farthest, now.middle);
            last = now;
        }
        const double length = std::max(1e-9, double(glm::distance(nodes_[from].position, nodes_[to].position)));
        return area + borne_ * std::clamp(out_of_wood, 0.0, 1.0) +
               organs_above(from) * std::min(1.0, farthest / length);
    }

    /// Wood is as thick as what it bears (the pipe model of Shinozaki et al. 1964).
    double organs_above(std::size_t node) const {
        const double share = nodes_[node].radius / std::max(1e-12F, nodes_.front().radius);
        return organs_ * std::min(1.0, share * share);
    }

    const std::vector<TubeNode>& nodes_;
    const FrameAttributes& of_;
    double borne_, organs_, tie_;
    std::vector<std::size_t> before_, behind_;  ///< of those that are left
    std::map<std::pair<std::size_t, std::size_t>, double> changed_;
    std::priority_queue<Change> changes_;
};

}  // namespace

double outline_area(const TubeLine& line) {
    double area = 0;
    for (std::size_t i = 1; i < line.nodes.size(); ++i) area += area_of_piece(line.nodes[i - 1], line.nodes[i]);
    return area;
}

std::vector<std::pair<double, std::size_t>> leaving_nodes(const TubeLine& line, const FrameAttributes& of_points,
                                                          double borne, double organs) {
    return Leaving(line, of_points, borne, organs).order();
}

}  // namespace espalier::archive
