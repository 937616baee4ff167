#include "analysis/convex_hull.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace espalier::analysis {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

}  // namespace

double convex_hull_area(std::vector<glm::dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<glm::dvec2> hull;
    for (int side = 0; side < 2; ++side) {  // the lower side from left to right, then the upper one back
        const std::size_t begin = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        if (!hull.empty()) hull.pop_back();  // where the other side begins
        std::reverse(points.begin(), points.end());
    }
    double area = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        area += cross(hull[i] - hull[0], hull[(i + 1) % hull.size()] - hull[0]) / 2;
    }
    return area;
}

namespace {

constexpr std::uint32_t none = 0xFFFFFFFF;

class Quickhull {
public:
    explicit Quickhull(std::span<const glm::dvec3> points) : points_(points) {}

    double volume() {
        if (!begin_with_tetrahedron()) return 0;
        while (!pending_.empty()) {
            const std::uint32_t face = pending_.back();
            pending_.pop_back();
            if (faces_[face].alive && !faces_[face].outside.empty()) include_farthest(face);
        }
        double sum = 0;
        for (const Face& face : faces_) {
            if (!face.alive) continue;
            const glm::dvec3 a = at(face.corners[0]), b = at(face.corners[1]), c = at(face.corners[2]);
            sum += glm::dot(a, glm::cross(b, c)) / 6;
        }
        return sum;
    }

private:
    /// A triangle, counter-clockwise from outside. `neighbours[k]` is across the edge from corner k to corner k + 1.
    struct Face {
        std::array<std::uint32_t, 3> corners, neighbours{none, none, none};
        glm::dvec3 normal;
        double offset;
        std::vector<std::uint32_t> outside;  ///< points in front of it
        bool alive = true;
    };
    struct Edge {
        std::uint32_t from, to, behind;  ///< `behind` is the face that stays
    };

    glm::dvec3 at(std::uint32_t point) const { return points_[point] - origin_; }
    double distance(const Face& face, std::uint32_t point) const {
        return glm::dot(face.normal, at(point)) - face.offset;
    }

    std::uint32_t add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::dvec3 across = glm::cross(at(b) - at(a), at(c) - at(a));
        const double length = glm::length(across);
        // A sliver without area faces nobody.
        const glm::dvec3 normal = length > 0 ? across / length : glm::dvec3(0);
        faces_.push_back({{a, b, c}, {none, none, none}, normal, glm::dot(normal, at(a)), {}, true});
        return static_cast<std::uint32_t>(faces_.size() - 1);
    }

    template <class Measure>
    std::uint32_t farthest_of_all(const Measure& measure) const {
        std::uint32_t best = 0;
        for (std::uint32_t i = 1; i < points_.size(); ++i) {
            if (measure(at(i)) > measure(at(best))) best = i;
        }
        return best;
    }

    bool begin_with_tetrahedron() {
        if (points_.size() < 4) return false;
        origin_ = points_[0];
        const std::uint32_t a = farthest_of_all([](const glm::dvec3& p) { return glm::dot(p, p); });
        const std::uint32_t b = farthest_of_all([&](const glm::dvec3& p) { return glm::dot(p - at(a), p - at(a)); });
        const glm::dvec3 line = at(b) - at(a);
        tolerance_ = 1e-10 * glm::length(line);
        const std::uint32_t c = farthest_of_all([&](const glm::dvec3& p) {
            const glm::dvec3 across = glm::cross(p - at(a), line);
            return glm::dot(across, across);
        });
        const glm::dvec3 across = glm::cross(line, at(c) - at(a));
        if (!(glm::length(across) > tolerance_ * glm::length(line))) return false;
        const glm::dvec3 normal = glm::normalize(across);
        const std::uint32_t d =
            farthest_of_all([&](const glm::dvec3& p) { return std::abs(glm::dot(p - at(a), normal)); });
        const double height = glm::dot(at(d) - at(a), normal);
        if (!(std::abs(height) > tolerance_)) return false;
        build_tetrahedron(height < 0 ? std::array{a, b, c, d} : std::array{a, c, b, d});
        return true;
    }

    /// The last corner is behind the face of the first three.
    void build_tetrahedron(const std::array<std::uint32_t, 4>& corners) {
        const auto [a, b, c, d] = corners;
        add_face(a, b, c);
        add_face(a, d, b);
        add_face(b, d, c);
        add_face(c, d, a);
        faces_[0].neighbours = {1, 2, 3};
        faces_[1].neighbours = {3, 2, 0};
        faces_[2].neighbours = {1, 3, 0};
        faces_[3].neighbours = {2, 1, 0};
        std::vector<std::uint32_t> all(points_.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        assign(all, 0);
    }

    /// Gives each point to one of the faces from `first` on that it is in front of; the others are inside.
    void assign(const std::vector<std::uint32_t>& points, std::size_t first) {
        for (const std::uint32_t point : points) {
            for (std::size_t face = first; face < faces_.size(); ++face) {
                if (distance(faces_[face], point) <= tolerance_) continue;
                faces_[face].outside.push_back(point);
                break;
            }
        }
        for (std::size_t face = first; face < faces_.size(); ++face) {
            if (!faces_[face].outside.empty()) pending_.push_back(static_cast<std::uint32_t>(face));
        }
    }

    void include_farthest(std::uint32_t face) {
        std::vector<std::uint32_t>& outside = faces_[face].outside;
        const auto farthest = std::max_element(outside.begin(), outside.end(), [&](std::uint32_t a, std::uint32_t b) {
            return distance(faces_[face], a) < distance(faces_[face], b);
        });
        const std::uint32_t point = *farthest;
        outside.erase(farthest);
        std::vector<std::uint32_t> visible;
        const std::vector<Edge> horizon = horizon_around(face, point, visible);
        if (!is_loop(horizon)) {  // rounding; the point is as good as on the hull
            for (const std::uint32_t seen : visible) faces_[seen].alive = true;
            if (!outside.empty()) pending_.push_back(face);
            return;
        }
        std::vector<std::uint32_t> orphans;
        for (const std::uint32_t seen : visible) {
            orphans.insert(orphans.end(), faces_[seen].outside.begin(), faces_[seen].outside.end());
            faces_[seen].outside = {};
        }
        const std::size_t first = faces_.size();
        join(horizon, point);
        assign(orphans, first);
    }

    /// Takes the faces that see the point off the hull; returns the edges to those that stay.
    std::vector<Edge> horizon_around(std::uint32_t face, std::uint32_t point, std::vector<std::uint32_t>& visible) {
        std::vector<Edge> horizon;
        visible = {face};
        faces_[face].alive = false;
        for (std::size_t i = 0; i < visible.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Face& seen = faces_[visible[i]];
                const std::uint32_t neighbour = seen.neighbours[k];
                if (!faces_[neighbour].alive) continue;
                if (distance(faces_[neighbour], point) > tolerance_) {
                    faces_[neighbour].alive = false;
                    visible.push_back(neighbour);
                } else {
                    horizon.push_back({seen.corners[k], seen.corners[(k + 1) % 3], neighbour});
                }
            }
        }
        return horizon;
    }

    static bool is_loop(const std::vector<Edge>& horizon) {
        std::unordered_map<std::uint32_t, std::uint32_t> next;
        for (const Edge& edge : horizon) {
            if (!next.emplace(edge.from, edge.to).second) return false;
        }
        std::uint32_t corner = horizon.empty() ? none : horizon.front().from;
        for (std::size_t i = 0; i < horizon.size(); ++i) {
            const auto found = next.find(corner);
            if (found == next.end()) return false;
            corner = found->second;
            if (corner == horizon.front().from) return i + 1 == horizon.size() && horizon.size() >= 3;
        }
        return false;
    }

    /// A face from every edge of the horizon to the point.
    void join(const std::vector<Edge>& horizon, std::uint32_t point) {
        std::unordered_map<std::uint32_t, std::uint32_t> face_from;
        for (const Edge& edge : horizon) {
            const std::uint32_t face = add_face(edge.from, edge.to, point);
            faces_[face].neighbours[0] = edge.behind;
            Face& behind = faces_[edge.behind];
            for (std::size_t k = 0; k < 3; ++k) {
                if (behind.corners[k] == edge.to && behind.corners[(k + 1) % 3] == edge.from) {
                    behind.neighbours[k] = face;
                }
            }
            face_from.emplace(edge.from, face);
        }
        for (const Edge& edge : horizon) {
            const std::uint32_t face = face_from.at(edge.from), after = face_from.at(edge.to);
            faces_[face].neighbours[1] = after;
            faces_[after].neighbours[2] = face;
        }
    }

    std::span<const glm::dvec3> points_;
    glm::dvec3 origin_{0};
    double tolerance_ = 0;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> pending_;  ///< faces that may have points outside
};

}  // namespace

double convex_hull_volume(std::span<const glm::dvec3> points) {
    return Quickhull(points).volume();
}

}  // namespace espalier::analysis
