#include "espalier/geometry/generalized_cylinder.h"

#include "espalier/base/error.h"
#include "espalier/base/math.h"

#include "base/cubic_basis.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace espalier::geometry {
namespace {

/// The centre line, stretch by stretch: stretch i leads from control point i to the next.
class CylinderCurve {
public:
    explicit CylinderCurve(const GeneralizedCylinder& cylinder);

    std::size_t stretches() const { return cylinder_.points.size() - (closed_ ? 0 : 1); }
    std::size_t next(std::size_t point) const { return (point + 1) % cylinder_.points.size(); }

    struct Place {
        glm::dvec3 position;
        glm::dvec3 tangent;  ///< unit length
        double width;
    };
    Place at(std::size_t stretch, double u) const;

private:
    struct Stretch {
        glm::dvec3 points[4];  ///< a Hermite curve has position, tangent, position, tangent
        double widths[4];
    };
    void add_hermite(std::size_t i);
    void add_spline(std::size_t i);
    double width_slope(std::size_t point, std::size_t stretch) const;
    double distance(std::size_t stretch) const;

    const GeneralizedCylinder& cylinder_;
    const bool closed_;
    const bool spline_;
    std::vector<Stretch> stretches_;
};

using Weights = std::array<double, 4>;

template <class T>
T combined(const T (&values)[4], const Weights& weights) {
    return values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2] + values[3] * weights[3];
}

CylinderCurve::CylinderCurve(const GeneralizedCylinder& cylinder)
    : cylinder_(cylinder),
      closed_(cylinder.closed()),
      spline_(cylinder.curve == GeneralizedCylinder::Curve::open_spline ||
              cylinder.curve == GeneralizedCylinder::Curve::closed_spline) {
    for (std::size_t i = 0; i < stretches(); ++i) spline_ ? add_spline(i) : add_hermite(i);
}

double CylinderCurve::distance(std::size_t stretch) const {
    return glm::distance(cylinder_.points[stretch].pose.position, cylinder_.points[next(stretch)].pose.position);
}

void CylinderCurve::add_hermite(std::size_t i) {
    const CylinderPoint &a = cylinder_.points[i], &b = cylinder_.points[next(i)];
    const double length = distance(i);
    stretches_.push_back({{a.pose.position, a.pose.heading * (a.tangent_after * length), b.pose.position,
                           b.pose.heading * (b.tangent_before * length)},
                          {a.width, width_slope(i, i), b.width, width_slope(next(i), i)}});
}

/// In an open spline, points beyond the ends are the inner ones mirrored: it begins and ends at its end points.
void CylinderCurve::add_spline(std::size_t i) {
    const std::size_t size = cylinder_.points.size();
    Stretch stretch{};
    for (std::size_t k = 0; k < 4; ++k) {
        if (closed_) {
            const CylinderPoint& point = cylinder_.points[(i + k + size - 1) % size];
            stretch.points[k] = point.pose.position;
            stretch.widths[k] = point.width;
        } else if (i + k >= 1 && i + k <= size) {
            stretch.points[k] = cylinder_.points[i + k - 1].pose.position;
            stretch.widths[k] = cylinder_.points[i + k - 1].width;
        } else {
            const CylinderPoint& end = cylinder_.points[i + k == 0 ? 0 : size - 1];
            const CylinderPoint& inner = cylinder_.points[i + k == 0 ? 1 : size - 2];
            stretch.points[k] = 2.0 * end.pose.position - inner.pose.position;
            stretch.widths[k] = std::max(2 * end.width - inner.width, 0.0);
        }
    }
    stretches_.push_back(stretch);
}

/// dw/du of a stretch at one of its ends. Without tangents of its own a point has the slope that keeps the width
/// between its neighbours' (Fritsch & Carlson 1980), 0 at an extremum.
double CylinderCurve::width_slope(std::size_t point, std::size_t stretch) const {
    const bool at_start = point == stretch;
    const CylinderPoint& here = cylinder_.points[point];
    if (here.radius) {
        const RadiusTangents& radius = *here.radius;
        const double angle = at_start ? radius.angle_after : radius.angle_before;
        const double length = at_start ? radius.length_after : radius.length_before;
        return 2 * math::sin(angle) * length * (radius.scaled ? distance(stretch) : 1);
    }
    const std::size_t size = cylinder_.points.size();
    const auto secant = [&](std::size_t i) {
        const double length = distance(i);
        return length > 0 ? (cylinder_.points[next(i)].width - cylinder_.points[i].width) / length : 0;
    };
    const bool first = !closed_ && point == 0, last = !closed_ && point + 1 == size;
    const double before = first ? secant(0) : secant((point + size - 1) % size);
    const double after = last ? before : secant(point);
    if (before * after <= 0) return 0;
    return 2 * before * after / (before + after) * distance(stretch);
}

CylinderCurve::Place CylinderCurve::at(std::size_t i, double u) const {
    const Stretch& stretch = stretches_[i];
    const double v = 1 - u;
    const Weights hermite{v * v * (1 + 2 * u), u * v * v, u * u * (3 - 2 * u), -u * u * v};
    const Weights hermite_slopes{-6 * u * v, v * (1 - 3 * u), 6 * u * v, u * (3 * u - 2)};
    const Weights spline = b_spline_weights(u), spline_slopes = b_spline_slopes(u);

    Place place;
    place.position = combined(stretch.points, spline_ ? spline : hermite);
    place.width = std::max(combined(stretch.widths, spline_ ? spline : hermite), 0.0);
    const glm::dvec3 slope = combined(stretch.points, spline_ ? spline_slopes : hermite_slopes);
    const double length = glm::length(slope);
    const CylinderPoint &a = cylinder_.points[i], &b = cylinder_.points[next(i)];
    if (length > 1e-9 * (distance(i) + 1e-300)) {
        place.tangent = slope / length;
    } else {
        // The points coincide, or the tangents cancel: go by the turtle's headings.
        const glm::dvec3 mean = v * a.pose.heading + u * b.pose.heading;
        place.tangent = glm::length(mean) > 1e-9 ? glm::normalize(mean) : b.pose.heading;
    }
    return place;
}

/// The part of `vector` across `tangent`, of unit length; any such vector if there is no such part.
glm::dvec3 across(const glm::dvec3& vector, const glm::dvec3& tangent) {
    const glm::dvec3 part = vector - tangent * glm::dot(vector, tangent);
    if (glm::length(part) > 1e-9) return glm::normalize(part);
    const glm::dvec3 other = std::abs(tangent.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(other - tangent * glm::dot(other, tangent));
}

void set_up(Pose& frame, const glm::dvec3& up) {
    frame.up = across(up, frame.heading);
    frame.left = glm::cross(frame.heading, frame.up);
}

/// The mirror image of a vector; `normal` is the mirror's, of any length but 0.
glm::dvec3 reflected(const glm::dvec3& vector, const glm::dvec3& normal) {
    return vector - normal * (2 * glm::dot(normal, vector) / glm::dot(normal, normal));
}

/// `up` carried from one ring to the next with the least twist, by two reflections: Wang et al. (2008), table I.
glm::dvec3 carried(const Pose& from, const Pose& to) {
    const glm::dvec3 chord = to.position - from.position;
    const glm::dvec3 mirror = glm::dot(chord, chord) > 0 ? chord : from.heading;  // turning on the spot
    const glm::dvec3 up = reflected(from.up, mirror);
    const glm::dvec3 turn = to.heading - reflected(from.heading, mirror);
    return glm::dot(turn, turn) > 1e-24 ? reflected(up, turn) : up;
}

/// The angle about the frame's heading from its up to `up`, in (-pi, pi].
double angle_to(const Pose& frame, const glm::dvec3& up) {
    return math::atan2(glm::dot(glm::cross(frame.up, up), frame.heading), glm::dot(frame.up, up));
}

void turn_up(Pose& frame, double angle) {
    const glm::dvec3 aside = glm::cross(frame.heading, frame.up);
    set_up(frame, frame.up * math::cos(angle) + aside * math::sin(angle));
}

class Sweep {
public:
    explicit Sweep(const GeneralizedCylinder& cylinder) : cylinder_(cylinder), curve_(cylinder) {}

    std::vector<CylinderRing> rings() {
        add_ring(0, 0);
        set_up(rings_[0].frame, cylinder_.points[0].pose.up);
        for (std::size_t i = 0; i < curve_.stretches(); ++i) add_stretch(i);
        if (cylinder_.closed()) close();
        return std::move(rings_);
    }

private:
    void add_ring(std::size_t stretch, double share) {
        const CylinderCurve::Place place = curve_.at(stretch, share);
        CylinderRing ring{{}, place.width, 0, stretch, share};
        ring.frame.position = place.position;
        ring.frame.heading = place.tangent;
        if (!rings_.empty()) {
            const CylinderRing& before = rings_.back();
            set_up(ring.frame, carried(before.frame, ring.frame));
            ring.along = before.along + glm::distance(before.frame.position, ring.frame.position);
        }
        rings_.push_back(ring);
    }

    /// Rolls the rings of a stretch by and by where its end follows the turtle's own roll.
    void add_stretch(std::size_t i) {
        const CylinderPoint& end = cylinder_.points[curve_.next(i)];
        const int strips = std::max(end.strips, 1);
        const std::size_t first = rings_.size();
        for (int k = 1; k <= strips; ++k) add_ring(i, double(k) / strips);
        if (!end.follows_roll) return;
        Pose& last = rings_.back().frame;
        const double roll = angle_to(last, across(end.pose.up, last.heading));
        for (int k = 1; k <= strips; ++k) turn_up(rings_[first + std::size_t(k) - 1].frame, roll * k / strips);
    }

    /// Spreads over its length what the frame has turned on its way round.
    void close() {
        const double turned = angle_to(rings_.back().frame, rings_.front().frame.up);
        const double length = rings_.back().along;
        if (length > 0) {
            for (CylinderRing& ring : rings_) turn_up(ring.frame, turned * ring.along / length);
        }
        rings_.back().frame = rings_.front().frame;
        rings_.back().width = rings_.front().width;
    }

    const GeneralizedCylinder& cylinder_;
    const CylinderCurve curve_;
    std::vector<CylinderRing> rings_;
};

/// Turns rings into vertices and triangles.
class Tube {
public:
    Tube(const GeneralizedCylinder& cylinder, PlantGeometry& geometry)
        : cylinder_(cylinder),
          geometry_(geometry),
          mesh_(geometry.mesh),
          sides_(std::max(cylinder.sides, 3)),
          rings_(rings_of(cylinder)) {
        for (const CylinderPoint& point : cylinder.points) {
            const Contour* contour = point.contour ? point.contour : &circle_;
            if (!vertices_.count(contour)) vertices_[contour] = contour->sample(sides_);
            whole_ = whole_ && contour->closed();
        }
        const Contour* first = cylinder.points.front().contour;
        clockwise_ = first && !first->counter_clockwise();
    }

    void draw() {
        const std::size_t size = mesh_.vertices.size() + (rings_.size() + 3) * (std::size_t(sides_) + 1);
        if (size > std::numeric_limits<std::uint32_t>::max() / 8) {
            throw RunError("the generalized cylinders of a plant have more than 500 million vertices");
        }
        const bool capped = whole_ && !cylinder_.closed();
        auto piece_begins = std::uint32_t(mesh_.triangles.size());
        double v = 0;
        std::uint32_t before = add_ring(0, v);
        if (capped) add_cap(0, before, -1);
        for (std::size_t i = 1; i < rings_.size(); ++i) {
            v += texture_length(i);
            const std::uint32_t ring = add_ring(i, v);
            add_strip(before, ring);
            before = ring;
            const bool last = i + 1 == rings_.size();
            if (last && capped) add_cap(i, ring, 1);
            if (!last && rings_[i + 1].after == rings_[i].after) continue;
            end_piece(piece_begins, rings_[i].after + 1);
            piece_begins = std::uint32_t(mesh_.triangles.size());
        }
    }

private:
    const std::vector<Contour::Vertex>& contour(std::size_t point) const {
        const Contour* own = cylinder_.points[point % cylinder_.points.size()].contour;
        return vertices_.at(own ? own : &circle_);
    }

    /// The contour at a ring, between those of the control points on both sides.
    Contour::Vertex contour_vertex(const CylinderRing& ring, int k) const {
        const Contour::Vertex& a = contour(ring.after)[std::size_t(k)];
        const Contour::Vertex& b = contour(ring.after + 1)[std::size_t(k)];
        if (ring.share == 1) return b;  // to the last bit, so that closed cylinders close
        return {a.position + ring.share * (b.position - a.position), a.normal + ring.share * (b.normal - a.normal)};
    }

    /// The contour's x points along up, its y to the right; its unit is half the width.
    static glm::dvec3 in_world(const Pose& frame, const glm::dvec3& v) {
        return v.x * frame.up - v.y * frame.left + v.z * frame.heading;
    }

    /// How fast the radius grows along the curve at a ring.
    double taper(std::size_t i) const {
        const CylinderRing& before = rings_[i > 0 ? i - 1 : i];
        const CylinderRing& after = rings_[i + 1 < rings_.size() ? i + 1 : i];
        const double length = after.along - before.along;
        return length > 0 ? (after.width - before.width) / (2 * length) : 0;
    }

    /// From the ring before to this one, in circumferences.
    double texture_length(std::size_t i) const {
        const double circumference = std::numbers::pi * (rings_[i].width + rings_[i - 1].width) / 2;
        const double length = rings_[i].along - rings_[i - 1].along;
        return circumference > 0 ? length / (circumference * cylinder_.texture_ratio) : 0;
    }

    std::uint32_t add_vertex(const SurfaceVertex& vertex) {
        mesh_.vertices.push_back(vertex);
        geometry_.bounds.add(vertex.position);
        return std::uint32_t(mesh_.vertices.size() - 1);
    }

    /// Returns the number of its first vertex. The last vertex lies on the first, at the other end of the texture.
    std::uint32_t add_ring(std::size_t i, double v) {
        const auto first = std::uint32_t(mesh_.vertices.size());
        const CylinderRing& ring = rings_[i];
        for (int k = 0; k <= sides_; ++k) {
            const Contour::Vertex vertex = contour_vertex(ring, k);
            const double leaning = taper(i) * glm::dot(vertex.position, vertex.normal);
            const glm::dvec3 normal = in_world(ring.frame, vertex.normal) - leaning * ring.frame.heading;
            const double length = glm::length(normal);
            add_vertex({ring.frame.position + ring.width / 2 * in_world(ring.frame, vertex.position),
                        length > 1e-9 ? normal / length : ring.frame.up,
                        {double(k) / sides_, v}});
        }
        return first;
    }

    /// Counter-clockwise in the contour's plane is clockwise seen along the curve.
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh_.triangles.insert(mesh_.triangles.end(), {a, clockwise_ ? c : b, clockwise_ ? b : c});
    }

    void add_strip(std::uint32_t before, std::uint32_t ring) {
        for (auto k = 0u; k < unsigned(sides_); ++k) {
            add_triangle(before + k, ring + k, ring + k + 1);
            add_triangle(before + k, ring + k + 1, before + k + 1);
        }
    }

    /// A fan about the middle of a ring; `side` is 1 at the end of the cylinder, -1 at its start.
    void add_cap(std::size_t i, std::uint32_t ring, int side) {
        const Pose& frame = rings_[i].frame;
        const glm::dvec3 normal = double(side) * frame.heading;
        SurfaceVertex centre{{0, 0, 0}, normal, {0.5, 0.5}};
        for (auto k = 0u; k < unsigned(sides_); ++k) centre.position += mesh_.vertices[ring + k].position;
        centre.position /= sides_;
        const std::uint32_t middle = add_vertex(centre);
        for (int k = 0; k <= sides_; ++k) {
            const glm::dvec3 flat = contour_vertex(rings_[i], k).position;
            add_vertex({mesh_.vertices[ring + unsigned(k)].position, normal, {0.5 + flat.x / 2, 0.5 + flat.y / 2}});
        }
        for (auto k = 1u; k <= unsigned(sides_); ++k) {
            add_triangle(middle, side > 0 ? middle + k + 1 : middle + k, side > 0 ? middle + k : middle + k + 1);
        }
    }

    void end_piece(std::uint32_t first, std::size_t point) {
        const CylinderPoint& owner = cylinder_.points[std::min(point, cylinder_.points.size() - 1)];
        mesh_.pieces.push_back({owner.module, first, std::uint32_t(mesh_.triangles.size()) - first, owner.order,
                                owner.colour, owner.look, MeshPiece::Kind::cylinder, !whole_});
    }

    const GeneralizedCylinder& cylinder_;
    PlantGeometry& geometry_;
    DrawnMesh& mesh_;
    const int sides_;
    const Contour circle_;
    const std::vector<CylinderRing> rings_;
    std::map<const Contour*, std::vector<Contour::Vertex>> vertices_;
    bool whole_ = true;
    bool clockwise_ = false;
};

}  // namespace

std::vector<CylinderRing> rings_of(const GeneralizedCylinder& cylinder) {
    if (cylinder.points.size() < 2) return {};
    return Sweep(cylinder).rings();
}

void draw(const GeneralizedCylinder& cylinder, PlantGeometry& geometry) {
    if (cylinder.points.size() >= 2) Tube(cylinder, geometry).draw();
}
}  // namespace espalier::geometry
