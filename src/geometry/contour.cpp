#include "espalier/geometry/contour.h"

#include "espalier/base/error.h"
#include "espalier/base/math.h"

#include "base/cubic_basis.h"
#include "geometry/magnetic_cut.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace espalier::geometry {
namespace {

constexpr int chords_per_segment = 10;  // as cpfg measures the length of a contour

/// A uniform cubic B-spline; segment i begins at point i. Of a closed one the points go round.
struct UniformSpline {
    const std::vector<glm::dvec3>& points;
    bool closed;

    int segments() const { return int(points.size()) - (closed ? 0 : 3); }

    glm::dvec3 weighted(int segment, const std::array<double, 4>& weights) const {
        glm::dvec3 sum(0);
        for (int k = 0; k < 4; ++k) sum += weights[k] * points[std::size_t(segment + k) % points.size()];
        return sum / 6.0;
    }
    glm::dvec3 at(int segment, double u) const { return weighted(segment, b_spline_sixths(u)); }
    glm::dvec3 slope(int segment, double u) const {
        const double v = 1 - u;
        return weighted(segment, {-3 * v * v, 9 * u * u - 12 * u, -9 * u * u + 6 * u + 3, 3 * u * u});
    }
};

/// Points at equal parameters, and the length up to each, measured in x and y.
struct LengthTable {
    std::vector<glm::dvec3> points, slopes;
    std::vector<double> lengths;

    explicit LengthTable(const UniformSpline& spline) {
        const int chords = spline.segments() * chords_per_segment;
        for (int k = 0; k <= chords; ++k) {
            const int segment = std::min(k / chords_per_segment, spline.segments() - 1);
            const double u = double(k) / chords_per_segment - segment;
            points.push_back(spline.at(segment, u));
            slopes.push_back(spline.slope(segment, u));
            const glm::dvec2 chord(k > 0 ? points[std::size_t(k)] - points[std::size_t(k) - 1] : glm::dvec3(0));
            lengths.push_back((k > 0 ? lengths.back() : 0) + glm::length(chord));
        }
    }

    Contour::Vertex at(double length) const {
        const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, length);
        const auto j = std::size_t(after - lengths.begin());
        const double chord = lengths[j] - lengths[j - 1];
        const double share = chord > 0 ? std::clamp((length - lengths[j - 1]) / chord, 0.0, 1.0) : 0;
        const glm::dvec3 slope = slopes[j - 1] + share * (slopes[j] - slopes[j - 1]);
        return {points[j - 1] + share * (points[j] - points[j - 1]), glm::dvec3(slope.y, -slope.x, 0)};
    }
};

/// Turns the contour about the origin so that its first vertex lies on the +x axis.
void turn_to_x_axis(std::vector<Contour::Vertex>& vertices) {
    const double radius = math::hypot(vertices[0].position.x, vertices[0].position.y);
    if (radius == 0) return;
    const double cosine = vertices[0].position.x / radius, sine = vertices[0].position.y / radius;
    const auto turned = [&](const glm::dvec3& v) {
        return glm::dvec3(cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z);
    };
    for (Contour::Vertex& vertex : vertices) vertex = {turned(vertex.position), turned(vertex.normal)};
}

/// Across the chord between the vertices on both sides: at corners the curve has no direction of its own.
glm::dvec3 normal_of_chord(const std::vector<Contour::Vertex>& vertices, std::size_t k, bool closed) {
    const std::size_t last = vertices.size() - 1;
    const std::size_t before = k > 0 ? k - 1 : closed ? last - 1 : 0;
    const std::size_t after = k < last ? k + 1 : closed ? 1 : last;
    const glm::dvec3 chord = vertices[after].position - vertices[before].position;
    return {chord.y, -chord.x, 0};
}

std::vector<Contour::Vertex> circle(int sides) {
    std::vector<Contour::Vertex> vertices;
    for (int k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        const glm::dvec3 point(math::cos(angle), math::sin(angle), 0);
        vertices.push_back({point, point});
    }
    vertices.push_back(vertices.front());
    return vertices;
}

/// Twice the area the polygon of the points encloses, positive if they go round counter-clockwise.
double signed_area(const std::vector<glm::dvec3>& points) {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 &p = points[i], &q = points[(i + 1) % points.size()];
        sum += p.x * q.y - p.y * q.x;
    }
    return sum;
}

}  // namespace

Contour::Contour(std::vector<glm::dvec3> points, bool closed) : points_(std::move(points)), closed_(closed) {
    const std::size_t least = closed ? 3 : 4;
    if (points_.size() < least) {
        throw UserError(fmt::format("{} contour needs at least {} points, not {}", closed ? "a closed" : "an open",
                                    least, points_.size()));
    }
}

Contour::Contour(MagneticCut cut) : closed_(!cut.flat), cut_(std::make_shared<MagneticCut>(std::move(cut))) {}

bool Contour::counter_clockwise() const {
    return points_.empty() || signed_area(points_) >= 0;
}

std::vector<Contour::Vertex> Contour::sample(int sides) const {
    sides = std::max(sides, 1);
    if (cut_) return cut_->sample(sides);
    if (is_circle()) return circle(sides);
    const LengthTable table(UniformSpline{points_, closed_});
    std::vector<Vertex> vertices;
    for (int k = 0; k <= sides; ++k) vertices.push_back(table.at(table.lengths.back() * k / sides));
    if (closed_) {
        vertices.back() = vertices.front();
        turn_to_x_axis(vertices);
    }
    const double outward = closed_ && !counter_clockwise() ? -1 : 1;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
        glm::dvec3& normal = vertices[k].normal;
        if (glm::length(normal) < 1e-9 * table.lengths.back()) normal = normal_of_chord(vertices, k, closed_);
        const double length = glm::length(normal);
        normal = length > 0 ? normal * (outward / length) : glm::dvec3(1, 0, 0);
    }
    return vertices;
}

}  // namespace espalier::geometry
