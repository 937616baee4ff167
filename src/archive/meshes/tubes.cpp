#include "archive/meshes/tubes.h"

#include "geometry/vectors.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace espalier::archive {
namespace {

/// How far a node lies from the straight and evenly tapering piece between two others.
double off_line(const TubeNode& node, const TubeNode& from, const TubeNode& to) {
    const glm::dvec3 a(from.position), along = glm::dvec3(to.position) - a, here = glm::dvec3(node.position) - a;
    const double square = glm::dot(along, along);
    const double share = square > 0 ? std::clamp(glm::dot(here, along) / square, 0.0, 1.0) : 0.0;
    const double radius = from.radius + share * (to.radius - from.radius);
    return std::max(glm::length(here - share * along), std::abs(node.radius - radius));
}

// Marks in `keep` what must stay between two nodes that stay.
void mark(const std::vector<TubeNode>& nodes, std::size_t first, std::size_t last, double tolerance,
          std::vector<bool>& keep) {
    std::vector<std::pair<std::size_t, std::size_t>> pieces{{first, last}};
    while (!pieces.empty()) {
        const auto [from, to] = pieces.back();
        pieces.pop_back();
        std::size_t worst = from;
        double most = tolerance;
        for (std::size_t i = from + 1; i < to; ++i) {
            const double off = off_line(nodes[i], nodes[from], nodes[to]);
            if (off <= most) continue;
            most = off;
            worst = i;
        }
        if (worst == from) continue;
        keep[worst] = true;
        pieces.emplace_back(from, worst);
        pieces.emplace_back(worst, to);
    }
}

std::vector<TubeNode> simplified(const std::vector<TubeNode>& nodes, const FrameAttributes& of, double tolerance) {
    std::vector<bool> keep(nodes.size(), false);
    keep.front() = keep.back() = true;
    std::size_t begin = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        const bool ends = i + 1 == nodes.size() || !same_look(of, nodes[i].point, nodes[i + 1].point);
        if (!ends) continue;
        keep[i] = true;
        mark(nodes, begin, i, tolerance, keep);
        begin = i;
    }
    std::vector<TubeNode> result;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (keep[i]) result.push_back(nodes[i]);
    }
    return result;
}

/// Across what the rings of a tube stand: where the node does not say so, the middle of the pieces before and behind.
std::vector<glm::dvec3> tangents_of(const TubeLine& line) {
    const std::vector<TubeNode>& nodes = line.nodes;
    std::vector<glm::dvec3> pieces, tangents;
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        pieces.push_back(glm::normalize(glm::dvec3(nodes[i].position) - glm::dvec3(nodes[i - 1].position)));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const glm::dvec3 before = pieces[i == 0 ? 0 : i - 1], behind = pieces[std::min(i, pieces.size() - 1)];
        const glm::dvec3 said(nodes[i].across_of), sum = said == glm::dvec3(0) ? before + behind : said;
        tangents.push_back(glm::length(sum) > 1e-6 ? glm::normalize(sum) : before);
    }
    if (line.first) tangents.front() = line.first->tangent;
    return tangents;
}

/// Returns the length of the texture between two nodes.
double texture_length(const TubeLine& line, const TubeNode& from, const TubeNode& to) {
    const double metres = glm::distance(from.position, to.position);
    if (line.pictures_around == 0) return metres;
    return metres * line.pictures_around / (std::numbers::pi * (double(from.radius) + to.radius));
}

class Sweeper {
public:
    Sweeper(const TubeLine& line, int sides, Caps caps)
        : line_(line), nodes_(line.nodes), sides_(static_cast<std::uint32_t>(sides)), caps_(caps) {}

    Tube tube() {
        const std::vector<TubeFrame> frames = frames_along(line_);
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            add_ring(i, frames[i]);
            if (i > 0) join(i);
        }
        add_cap(0, -frames.front().tangent);
        add_cap(static_cast<std::uint32_t>(nodes_.size() - 1), frames.back().tangent);
        return std::move(tube_);
    }

private:
    std::uint32_t ring(std::uint32_t node) const { return node * (sides_ + 1); }

    /// How fast the radius shrinks along the axis there.
    double taper(std::size_t node) const {
        const TubeNode& before = nodes_[node == 0 ? 0 : node - 1];
        const TubeNode& behind = nodes_[std::min(node + 1, nodes_.size() - 1)];
        return (before.radius - behind.radius) / std::max(1e-12f, glm::distance(before.position, behind.position));
    }

    // The last vertex stands where the first does, at the other end of the texture.
    void add_ring(std::uint32_t node, const TubeFrame& frame) {
        const glm::dvec3 left = glm::cross(frame.tangent, frame.across);
        const double shrinking = taper(node);
        const auto around = static_cast<float>(std::max(1, line_.pictures_around));
        for (std::uint32_t side = 0; side <= sides_; ++side) {
            const double angle = 2 * std::numbers::pi * (side % sides_) / sides_;
            const glm::dvec3 outward = std::cos(angle) * frame.across + std::sin(angle) * left;
            const glm::dvec3 position = glm::dvec3(nodes_[node].position) + double(nodes_[node].radius) * outward;
            tube_.vertices.push_back(
                {glm::vec3(position),
                 glm::vec3(glm::normalize(outward + shrinking * frame.tangent)),
                 {around * static_cast<float>(side) / static_cast<float>(sides_), static_cast<float>(frame.along)},
                 node});
        }
    }

    void join(std::uint32_t node) {
        for (std::uint32_t side = 0; side < sides_; ++side) {
            const std::uint32_t a = ring(node - 1) + side, b = ring(node) + side;
            tube_.triangles.push_back({{a, a + 1, b + 1}, node});
            tube_.triangles.push_back({{a, b + 1, b}, node});
        }
    }

    void add_cap(std::uint32_t node, const glm::dvec3& outward) {
        if (sides_ < 3) return;
        const auto centre = static_cast<std::uint32_t>(tube_.vertices.size());
        const glm::vec3 normal(outward);
        if (caps_ == Caps::round) tube_.vertices.push_back({nodes_[node].position, normal, {0.5f, 0.5f}, node});
        const auto first = static_cast<std::uint32_t>(tube_.vertices.size());
        for (std::uint32_t side = 0; side < sides_; ++side) {
            const double angle = 2 * std::numbers::pi * side / sides_;
            const glm::vec2 uv(0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle));
            tube_.vertices.push_back({tube_.vertices[ring(node) + side].position, normal, uv, node});
        }
        const std::uint32_t owner = std::max(node, 1u);
        const bool is_lean = caps_ == Caps::lean;  // then the centre is the first corner
        for (std::uint32_t side = is_lean ? 1 : 0; side < (is_lean ? sides_ - 1 : sides_); ++side) {
            std::uint32_t here = first + side, next = first + (side + 1) % sides_;
            if (node == 0) std::swap(here, next);
            tube_.triangles.push_back({{centre, here, next}, owner});
        }
    }

    const TubeLine& line_;
    const std::vector<TubeNode>& nodes_;
    std::uint32_t sides_;
    Caps caps_;
    Tube tube_;
};

float radius_of(const FrameGeometry& geometry, std::size_t row, float thinnest) {
    const float radius = geometry.radii[row];
    if (std::isfinite(radius) && radius > 0) return radius;
    const float pixels = geometry.pixels.empty() ? 0 : geometry.pixels[row];
    return std::isfinite(pixels) && pixels > 0 ? pixels * thinnest : 0;
}

}  // namespace

bool same_look(const FrameAttributes& of, PointIndex a, PointIndex b) {
    const std::size_t i = a.row(), k = b.row();
    return of.colours[i] == of.colours[k] && (of.rgb.empty() || of.rgb[i] == of.rgb[k]);
}

TubeLine tube_line(const FrameGeometry& geometry, std::span<const PointIndex> points, double tolerance,
                   float thinnest) {
    std::vector<TubeNode> nodes;
    float thickest = 0;
    for (const PointIndex point : points) {
        const std::size_t row = point.row();
        const float radius = radius_of(geometry, row, thinnest);
        thickest = std::max(thickest, radius);
        const bool moved = nodes.empty() || nodes.back().position != geometry.points[row];
        if (moved) {
            nodes.push_back({geometry.points[row], radius, point});
        } else {
            nodes.back().radius = radius;
        }
    }
    const float least = thickest > 0 ? thickest / 1000 : thinnest;
    for (TubeNode& node : nodes) node.radius = std::max(node.radius, least);
    if (nodes.size() > 2 && tolerance > 0) nodes = simplified(nodes, geometry.of_points, tolerance);
    return {std::move(nodes)};
}

std::vector<double> node_errors(const TubeLine& line, const FrameAttributes& of_points) {
    const std::vector<TubeNode>& nodes = line.nodes;
    struct Piece {
        std::size_t from, to;
        double most;  ///< the error of the node that split it off
    };
    constexpr double stays = std::numeric_limits<double>::infinity();
    std::vector<double> errors(nodes.size(), stays);
    std::vector<Piece> pieces{{0, nodes.size() - 1, stays}};
    while (!pieces.empty()) {
        const auto [from, to, most] = pieces.back();
        pieces.pop_back();
        std::size_t worst = from;
        double error = -1;
        for (std::size_t i = from + 1; i < to; ++i) {
            double off = off_line(nodes[i], nodes[from], nodes[to]);
            if (!same_look(of_points, nodes[i].point, nodes[i + 1].point)) off = std::max(off, double(nodes[i].radius));
            if (off <= error) continue;
            error = off;
            worst = i;
        }
        if (worst == from) continue;
        errors[worst] = std::min(error, most);
        pieces.push_back({from, worst, errors[worst]});
        pieces.push_back({worst, to, errors[worst]});
    }
    return errors;
}

std::vector<TubeFrame> frames_along(const TubeLine& line) {
    const std::vector<glm::dvec3> tangents = tangents_of(line);
    std::vector<TubeFrame> frames;
    glm::dvec3 across = line.first ? line.first->across : any_across(tangents.front());
    double along = line.first ? line.first->along : 0;
    for (std::size_t i = 0; i < line.nodes.size(); ++i) {
        across -= tangents[i] * glm::dot(across, tangents[i]);
        across = glm::length(across) > 1e-6 ? glm::normalize(across) : any_across(tangents[i]);
        if (i > 0) along += texture_length(line, line.nodes[i - 1], line.nodes[i]);
        frames.push_back({tangents[i], across, along});
    }
    return frames;
}

Tube sweep(const TubeLine& line, int sides, Caps caps) {
    return Sweeper(line, sides, caps).tube();
}

}  // namespace espalier::archive
