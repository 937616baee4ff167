#include "espalier/base/file.h"
#include "espalier/base/math.h"
#include "espalier/geometry/surface.h"
#include "espalier/turtle/background.h"

#include "base/text_cursor.h"
#include "geometry/drawn/rigid_motion.h"
#include "language/preprocessor/preprocessed_text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace espalier::turtle {
namespace {

struct Solid {
    std::vector<SurfaceVertex> vertices;
    std::vector<std::uint32_t> triangles;  ///< three indices each
};

constexpr std::uint32_t sides = 24, stacks = 12;

void add_quadrilateral(Solid& solid, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    solid.triangles.insert(solid.triangles.end(), {a, b, c, a, c, d});
}

glm::dvec3 around(std::uint32_t k) {
    const double angle = 2 * std::numbers::pi * (k % sides) / sides;
    return {math::sin(angle), 0, math::cos(angle)};
}

void add_disc(Solid& solid, double radius, double height, double side) {
    if (radius == 0) return;
    const auto centre = std::uint32_t(solid.vertices.size());
    const glm::dvec3 up(0, height, 0), normal(0, side, 0);
    solid.vertices.push_back({up, normal, {}});
    for (std::uint32_t k = 0; k < sides; ++k) solid.vertices.push_back({up + radius * around(k), normal, {}});
    for (std::uint32_t k = 0; k < sides; ++k) {
        const std::uint32_t here = centre + 1 + k, next = centre + 1 + (k + 1) % sides;
        solid.triangles.insert(solid.triangles.end(), {centre, side > 0 ? here : next, side > 0 ? next : here});
    }
}

/// A corner at the origin.
Solid solid_box(const glm::dvec3& size) {
    Solid box;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 u(0), v(0), w(0);
        u[(axis + 1) % 3] = size[(axis + 1) % 3];
        v[(axis + 2) % 3] = size[(axis + 2) % 3];
        w[axis] = size[axis];
        glm::dvec3 normal(0);
        for (const bool far : {false, true}) {
            normal[axis] = far ? 1 : -1;
            const auto first = std::uint32_t(box.vertices.size());
            for (const glm::dvec3& corner : {glm::dvec3(0), far ? u : v, u + v, far ? v : u}) {
                box.vertices.push_back({(far ? w : glm::dvec3(0)) + corner, normal, {}});
            }
            add_quadrilateral(box, first, first + 1, first + 2, first + 3);
        }
    }
    return box;
}

/// Along +y from the origin, with discs at its ends.
Solid solid_cone(double base_radius, double top_radius, double height) {
    Solid cone;
    for (std::uint32_t k = 0; k <= sides; ++k) {
        const glm::dvec3 out = around(k);
        const glm::dvec3 slope = height * out + glm::dvec3(0, base_radius - top_radius, 0);
        const glm::dvec3 normal = glm::length(slope) > 0 ? glm::normalize(slope) : out;
        cone.vertices.push_back({base_radius * out, normal, {}});
        cone.vertices.push_back({top_radius * out + glm::dvec3(0, height, 0), normal, {}});
    }
    for (std::uint32_t k = 0; k < sides; ++k) add_quadrilateral(cone, 2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1);
    add_disc(cone, base_radius, 0, -1);
    add_disc(cone, top_radius, height, 1);
    return cone;
}

/// About the origin.
Solid solid_sphere(double radius) {
    Solid sphere;
    for (std::uint32_t i = 0; i <= stacks; ++i) {
        const double latitude = std::numbers::pi * (double(i) / stacks - 0.5);
        for (std::uint32_t k = 0; k <= sides; ++k) {
            const glm::dvec3 normal = math::cos(latitude) * around(k) + glm::dvec3(0, math::sin(latitude), 0);
            sphere.vertices.push_back({radius * normal, normal, {}});
        }
    }
    for (std::uint32_t i = 0; i < stacks; ++i) {
        for (std::uint32_t k = 0; k < sides; ++k) {
            const std::uint32_t here = i * (sides + 1) + k, above = here + sides + 1;
            add_quadrilateral(sphere, here, here + 1, above + 1, above);
        }
    }
    return sphere;
}

/// The normal of a polygon whose vertices need not lie in a plane quite (Newell 1972); unit length.
glm::dvec3 fan_normal(const std::vector<SurfaceVertex>& vertices) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        sum += glm::cross(vertices[i].position, vertices[(i + 1) % vertices.size()].position);
    }
    const double length = glm::length(sum);
    return length > 0 ? sum / length : glm::dvec3(0, 0, 1);
}

constexpr std::size_t most_told = 100;
constexpr std::size_t most_matrices = 1000;
constexpr std::string_view between_words = TextCursor::white_space;

// What programs that write such scenes add to them; without meaning here.
constexpr std::array unused_commands{"matrixmode", "loadmatrix", "loadidentity", "light",
                                     "clear",      "ortho",      "perspective",  "lookat"};

using Numbers = std::span<const double>;

glm::dvec3 point_at(Numbers numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

class BackgroundReader {
public:
    BackgroundReader(const TextCursor& text, const Material& material, Background& background,
                     std::vector<Diagnostic>& diagnostics)
        : text_(text), background_(background), material_(material), diagnostics_(diagnostics) {}

    void read() {
        begin_piece();
        for (text_.skip(between_words); !text_.at_end(); text_.skip(between_words)) read_command();
        end_piece();
    }

private:
    struct Command {
        std::size_t least;  ///< numbers it needs
        void (BackgroundReader::*run)(Numbers);
    };
    static const std::unordered_map<std::string_view, Command>& commands();

    void complain(const TextCursor& at, const std::string& message) {
        if (diagnostics_.size() < most_told) diagnostics_.push_back(at.diagnostic(message));
    }

    void read_command() {
        const TextCursor start = text_;
        if (text_.next() == '#') {
            text_.line();
            return;
        }
        const std::string_view word = text_.word(between_words);
        const auto found = commands().find(word);
        if (found == commands().end()) return skip_command(word, start);
        const std::vector<double> numbers = read_numbers();
        if (numbers.size() < found->second.least) {
            return complain(start, fmt::format("'{}' needs at least {} numbers, not {}", word, found->second.least,
                                               numbers.size()));
        }
        place_ = start;
        (this->*found->second.run)(numbers);
    }

    // White space separates numbers; anything else ends them.
    std::vector<double> read_numbers() {
        std::vector<double> numbers;
        for (;;) {
            text_.skip(between_words);
            const std::optional<double> number = text_.number();
            if (!number) return numbers;
            numbers.push_back(*number);
        }
    }

    void skip_command(std::string_view word, const TextCursor& start) {
        read_numbers();
        if (std::find(unused_commands.begin(), unused_commands.end(), word) != unused_commands.end()) return;
        complain(start, fmt::format("background scenes have no command '{}'", word));
    }

    void begin_piece() { background_.pieces.push_back({material_, std::uint32_t(background_.triangles.size()), 0}); }
    void end_piece() {
        Background::Piece& piece = background_.pieces.back();
        piece.count = std::uint32_t(background_.triangles.size()) - piece.first;
        if (piece.count == 0) background_.pieces.pop_back();
    }

    glm::dvec3 world(const glm::dvec3& point) const { return {matrices_.back() * glm::dvec4(point, 1)}; }

    /// Adds a solid in its own coordinates, moved as the matrix says. Normals go by the inverse transpose, which up to
    /// length is the matrix of cofactors.
    void add(const std::vector<SurfaceVertex>& vertices, const std::vector<std::uint32_t>& triangles) {
        const glm::dmat3 m(matrices_.back());
        const glm::dmat3 of_normals(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        const auto first = std::uint32_t(background_.vertices.size());
        for (SurfaceVertex vertex : vertices) {
            vertex.position = world(vertex.position);
            vertex.normal = of_normals * vertex.normal;
            const double length = glm::length(vertex.normal);
            vertex.normal = length > 0 ? vertex.normal / length : glm::dvec3(0, 0, 1);
            if (!glm::all(glm::lessThan(glm::abs(vertex.position), glm::dvec3(most_coordinate)))) {
                return complain(place_, "coordinates beyond all measure");
            }
            background_.vertices.push_back(vertex);
        }
        for (const std::uint32_t index : triangles) background_.triangles.push_back(first + index);
    }

    void add(const Solid& solid) { add(solid.vertices, solid.triangles); }

    void fan(std::vector<SurfaceVertex> vertices, bool with_normals) {
        if (!with_normals) {
            const glm::dvec3 normal = fan_normal(vertices);
            for (SurfaceVertex& vertex : vertices) vertex.normal = normal;
        }
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t i = 2; i < vertices.size(); ++i) triangles.insert(triangles.end(), {0, i - 1, i});
        add(vertices, triangles);
    }

    void polygon(Numbers numbers) {
        std::vector<SurfaceVertex> vertices;
        for (std::size_t i = 0; i + 3 <= numbers.size(); i += 3) vertices.push_back({point_at(numbers, i), {}, {}});
        fan(std::move(vertices), false);
    }

    void polygon_with_normals(Numbers numbers) {
        std::vector<SurfaceVertex> vertices;
        for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6) {
            vertices.push_back({point_at(numbers, i), point_at(numbers, i + 3), {}});
        }
        fan(std::move(vertices), true);
    }

    // Pairs of points; quadrilateral k goes round points 2k, 2k + 2, 2k + 3, 2k + 1.
    void mesh(Numbers numbers) {
        for (std::size_t i = 0; i + 12 <= numbers.size(); i += 6) {
            const glm::dvec3 p0 = point_at(numbers, i), p1 = point_at(numbers, i + 3), p2 = point_at(numbers, i + 6),
                             p3 = point_at(numbers, i + 9);
            const glm::dvec3 normal = glm::cross(p3 - p0, p2 - p1);
            fan({{p0, normal, {}}, {p2, normal, {}}, {p3, normal, {}}, {p1, normal, {}}}, true);
        }
    }

    void rectangle(Numbers numbers) {
        const double x = numbers.size() >= 4 ? numbers[2] : 0, y = numbers.size() >= 4 ? numbers[3] : 0;
        const glm::dvec3 normal(0, 0, 1);
        fan({{{x, y, 0}, normal, {}},
             {{x + numbers[0], y, 0}, normal, {}},
             {{x + numbers[0], y + numbers[1], 0}, normal, {}},
             {{x, y + numbers[1], 0}, normal, {}}},
            true);
    }

    void box(Numbers numbers) { add(solid_box(point_at(numbers, 0))); }
    void cone(Numbers numbers) { add(solid_cone(numbers[0], numbers[1], numbers[2])); }
    void cylinder(Numbers numbers) { add(solid_cone(numbers[0], numbers[0], numbers[1])); }
    void sphere(Numbers numbers) { add(solid_sphere(numbers[0])); }

    // Ambient, diffuse, specular, emissive, shininess; only complete groups count.
    void material(Numbers numbers) {
        end_piece();
        const std::array groups{&material_.ambient, &material_.diffuse, &material_.specular, &material_.emissive};
        for (std::size_t group = 0; group < groups.size() && 4 * group + 4 <= numbers.size(); ++group) {
            for (int i = 0; i < 4; ++i) (*groups[group])[i] = numbers[4 * group + std::size_t(i)];
        }
        if (numbers.size() >= 17) material_.shininess = numbers[16];
        begin_piece();
    }

    void push_matrix(Numbers) {
        if (matrices_.size() == most_matrices) {
            return complain(place_, fmt::format("more than {} matrices are pushed", most_matrices));
        }
        matrices_.push_back(glm::dmat4(matrices_.back()));
    }
    void pop_matrix(Numbers) {
        if (matrices_.size() == 1) return complain(place_, "no matrix was pushed that could be popped");
        matrices_.pop_back();
    }

    // Each transformation is applied before those that are there already, as in OpenGL.
    void apply(const glm::dmat4& matrix) { matrices_.back() *= matrix; }

    void translate(Numbers numbers) { apply(glm::translate(glm::dmat4(1), point_at(numbers, 0))); }
    void scale(Numbers numbers) { apply(glm::scale(glm::dmat4(1), point_at(numbers, 0))); }
    void rotate(Numbers numbers) {
        const glm::dvec3 axis = point_at(numbers, 1);
        if (!(glm::length(axis) > 0)) return complain(place_, "'rotate' needs an axis that is not 0 0 0");
        apply(glm::mat4_cast(turn_about(glm::normalize(axis), numbers[0] * (std::numbers::pi / 180))));
    }
    // Rows of a matrix of row vectors are columns of one of column vectors.
    void multiply(Numbers numbers) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = numbers[std::size_t(i)];
        apply(matrix);
    }

    static constexpr double most_coordinate = 1e30;

    TextCursor text_;
    TextCursor place_ = text_;  // where the command at hand begins
    Background& background_;
    Material material_;
    std::vector<Diagnostic>& diagnostics_;
    std::vector<glm::dmat4> matrices_{glm::dmat4(1)};
};

const std::unordered_map<std::string_view, BackgroundReader::Command>& BackgroundReader::commands() {
    using Reader = BackgroundReader;
    static const std::unordered_map<std::string_view, Command> table{
        {"polygon", {9, &Reader::polygon}},
        {"polygonuv", {18, &Reader::polygon_with_normals}},
        {"mesh", {12, &Reader::mesh}},
        {"rectangle", {2, &Reader::rectangle}},
        {"prism", {3, &Reader::box}},
        {"box", {3, &Reader::box}},
        {"cone", {3, &Reader::cone}},
        {"cylinder", {2, &Reader::cylinder}},
        {"sphere", {1, &Reader::sphere}},
        {"material", {4, &Reader::material}},
        {"pushmatrix", {0, &Reader::push_matrix}},
        {"popmatrix", {0, &Reader::pop_matrix}},
        {"translate", {3, &Reader::translate}},
        {"scale", {3, &Reader::scale}},
        {"rotate", {4, &Reader::rotate}},
        {"multmatrix", {16, &Reader::multiply}},
    };
    return table;
}

}  // namespace

void read_background_text(std::string_view text, const std::string& name, const Material& material,
                          Background& background, std::vector<Diagnostic>& diagnostics) {
    ReadOptions options;
    options.warnings = &diagnostics;
    const auto preprocessed = preprocess_text(text, name, std::filesystem::path(name).parent_path(), options);
    BackgroundReader(TextCursor(preprocessed), material, background, diagnostics).read();
}

void read_background(const std::filesystem::path& path, const Material& material, Background& background,
                     std::vector<Diagnostic>& diagnostics) {
    read_background_text(read_text(path), path.string(), material, background, diagnostics);
}

}  // namespace espalier::turtle
