#include "language/opf/document.h"

#include "espalier/language/measured_plants.h"

#include "base/number.h"
#include "base/text.h"
#include "base/xml_reader.h"
#include "language/measured/cells.h"
#include "language/measured/notes.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace espalier::language::opf {
namespace {

bool is_flat(const MeasuredMesh& mesh) {
    constexpr double rounding = 1e-6;
    glm::dvec3 normal(0), lower = mesh.points[0], upper = lower;
    for (const std::vector<std::uint32_t>& face : mesh.faces) {
        const glm::dvec3& corner = mesh.points[face[0]];
        for (std::size_t i = 1; i + 1 < face.size(); ++i) {
            normal += glm::cross(mesh.points[face[i]] - corner, mesh.points[face[i + 1]] - corner);
        }
    }
    for (const glm::dvec3& point : mesh.points) lower = glm::min(lower, point), upper = glm::max(upper, point);
    const double size = glm::length(upper - lower), length = glm::length(normal);
    return length > 0 && std::all_of(mesh.points.begin(), mesh.points.end(), [&](const glm::dvec3& point) {
               return std::abs(glm::dot(normal, point - mesh.points[0])) <= rounding * size * length;
           });
}

/// Flat meshes become one polygon, so that a leaf is one thing that is drawn: the border of a mesh, if that is flat and
/// has one without holes.
std::optional<std::vector<std::uint32_t>> outline_of(const MeasuredMesh& mesh) {
    if (mesh.faces.empty() || !is_flat(mesh)) return std::nullopt;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const std::vector<std::uint32_t>& face : mesh.faces) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (!edges.emplace(face[i], face[(i + 1) % face.size()]).second) return std::nullopt;
        }
    }
    std::unordered_map<std::uint32_t, std::uint32_t> next;  // along the border
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from}) && !next.emplace(from, to).second) return std::nullopt;
    }
    if (next.empty()) return std::nullopt;
    std::vector<std::uint32_t> outline{mesh.faces[0][0]};
    if (!next.contains(outline[0])) outline[0] = std::min_element(next.begin(), next.end())->first;
    while (outline.size() <= next.size()) {
        const auto further = next.find(outline.back());
        if (further == next.end()) return std::nullopt;
        if (further->second == outline[0]) break;
        outline.push_back(further->second);
    }
    return outline.size() == next.size() ? std::optional(outline) : std::nullopt;
}

constexpr int most_depth = 100'000;  ///< each internode stands inside the one before
constexpr double largest = 1e12;
constexpr double largest_index = 1e9;

class Reader final : public XmlReader {
public:
    Reader(const std::string& name, measured::Notes& notes) : XmlReader(name, most_depth), notes_(notes) {}

    Document read(std::string text) {
        parse(std::move(text));
        if (!is_opf_) fail("this is no OPF file: its outermost element is not <opf>");
        for (const auto& [element, place] : not_drawn_) {
            notes_.warn(fmt::format("'{}' has meshes without faces, and is not drawn", escaped(element)), place.first,
                        place.second);
        }
        return std::move(document_);
    }

private:
    struct Shape {
        std::string mesh;
    };

    std::vector<double> numbers(std::size_t count) {
        std::vector<double> numbers;
        for (const std::string& word : words_of(text(), " \t\r\n,")) {
            const std::optional<double> number = finite_number(word);
            if (!number || std::abs(*number) > largest) fail(fmt::format("'{}' is no number", escaped(word)));
            numbers.push_back(*number);
        }
        if (count > 0 && numbers.size() != count) {
            fail(fmt::format("here are {} numbers, not {}", numbers.size(), count));
        }
        return numbers;
    }

    std::string word() const {
        const std::vector<std::string> words = words_of(text(), " \t\r\n");
        return words.empty() ? "" : words[0];
    }

    void begin(const std::string& element, const XmlAttributes& attributes) override {
        if (element == "opf") is_opf_ = true;
        if (element == "mesh") {
            number_of_mesh_.try_emplace(attributes.value("Id"), document_.meshes.size());
            document_.meshes.emplace_back().is_scaled = attributes.value("enableScale") == "true";
        }
        if (element == "shape") shape_ = attributes.value("Id");
        if (element == "geometry") is_in_geometry_ = true;
        const char relation = element == "topology" || element == "decomp" ? '/'
                              : element == "follow"                        ? '<'
                              : element == "branch"                        ? '+'
                                                                           : ' ';
        if (relation != ' ') begin_entity(relation, attributes);
    }

    void begin_entity(char relation, const XmlAttributes& attributes) {
        Entity entity;
        entity.relation = relation;
        entity.at = here();
        entity.label = attributes.value("class");
        const std::optional<double> scale = finite_number(attributes.value("scale"));
        entity.scale = scale ? static_cast<int>(std::clamp(*scale, -1.0, 1000.0)) : 0;
        if (!open_.empty()) entity.inside = open_.back();
        open_.push_back(static_cast<std::uint32_t>(document_.entities.size()));
        document_.entities.push_back(std::move(entity));
    }

    void end(const std::string& element) override {
        if (is_in_geometry_) return end_in_geometry(element);
        if (element == "points") return end_points();
        if (element == "face") return end_face();
        if (element == "normals" || element == "textureCoords" || element == "material") {
            return notes_.unused("element <" + element + ">", here());
        }
        if (element == "mesh") return end_mesh();
        if (element == "meshIndex") shapes_[shape_].mesh = word();
        if (open_.empty()) return;
        if (element == "topology" || element == "decomp" || element == "follow" || element == "branch") {
            open_.pop_back();
        } else {
            notes_.unused(fmt::format("attribute '{}'", escaped(element)), here());
        }
    }

    void end_points() {
        const std::vector<double> all = numbers(0);
        if (all.size() % 3 != 0) fail("points have three coordinates each");
        Mesh& mesh = open_mesh();
        mesh.shape.points.clear();
        mesh.lower = glm::dvec3(INFINITY);
        mesh.upper = glm::dvec3(-INFINITY);
        for (std::size_t i = 0; i < all.size(); i += 3) {
            const glm::dvec3 at(all[i], all[i + 1], all[i + 2]);
            mesh.shape.points.push_back(at);
            mesh.lower = glm::min(mesh.lower, at);
            mesh.upper = glm::max(mesh.upper, at);
        }
        mesh.shape.lowest = mesh.lower.x;
        mesh.shape.highest = mesh.upper.x;
    }

    Mesh& open_mesh() {
        if (document_.meshes.empty()) fail("this stands in no <mesh>");
        return document_.meshes.back();
    }

    void end_face() {
        std::vector<std::uint32_t> face;
        for (const double number : numbers(0)) {
            if (number < 0 || number > largest_index || number != std::floor(number)) {
                fail(fmt::format("'{}' is no number of a point", number));
            }
            face.push_back(static_cast<std::uint32_t>(number));
        }
        if (face.size() < 3) fail("a face has three points or more");
        open_mesh().shape.faces.push_back(std::move(face));
    }

    /// Faces may stand before points.
    void end_mesh() {
        MeasuredMesh& shape = open_mesh().shape;
        for (const std::vector<std::uint32_t>& face : shape.faces) {
            const std::uint32_t last = *std::max_element(face.begin(), face.end());
            if (last >= shape.points.size()) {
                fail(fmt::format("a face names point {} of {}; they count from 0", last, shape.points.size()));
            }
        }
        if (std::optional<std::vector<std::uint32_t>> outline = outline_of(shape)) shape.faces = {*std::move(outline)};
    }

    void end_in_geometry(const std::string& element) {
        if (element == "geometry") is_in_geometry_ = false;
        if (open_.empty()) return;
        Entity& entity = document_.entities[open_.back()];
        if (element == "shapeIndex") {
            give_mesh(entity);
        } else if (element == "mat") {
            const std::vector<double> m = numbers(12);
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 4; ++column) entity.place[column][row] = m[std::size_t(4 * row + column)];
            }
        } else if (element == "dUp") {
            entity.upper = numbers(1)[0];
        } else if (element == "dDwn") {
            entity.lower = numbers(1)[0];
        } else if (element != "geometry") {
            notes_.unused(fmt::format("element <{}> of a geometry", escaped(element)), here());
        }
    }

    void give_mesh(Entity& entity) {
        const auto shape = shapes_.find(word());
        if (shape == shapes_.end()) fail(fmt::format("there is no shape '{}'", escaped(word())));
        const auto number = number_of_mesh_.find(shape->second.mesh);
        if (number == number_of_mesh_.end()) fail(fmt::format("there is no mesh '{}'", escaped(shape->second.mesh)));
        const Mesh& mesh = document_.meshes[number->second];
        if (mesh.is_tube() || !mesh.shape.faces.empty()) {
            entity.mesh = static_cast<std::uint32_t>(number->second);
            return;
        }
        auto& [place, count] = not_drawn_[entity.label];
        if (count++ == 0) place = here();
    }

    measured::Notes& notes_;
    bool is_opf_ = false, is_in_geometry_ = false;
    std::string shape_;  ///< that is open
    std::map<std::string, std::size_t> number_of_mesh_;
    std::map<std::string, Shape> shapes_;
    std::vector<std::uint32_t> open_;
    std::map<std::string, std::pair<Place, std::size_t>> not_drawn_;
    Document document_;
};

}  // namespace

bool Mesh::is_tube() const {
    const glm::dvec3 size = upper - lower, middle = 0.5 * (upper + lower);
    const double across = std::max(size.y, size.z);
    return size.x > 0 && across > 0 && std::abs(size.y - size.z) < 0.2 * across &&
           std::max(std::abs(middle.y), std::abs(middle.z)) < 0.1 * across;
}

Document read(std::string text, const std::string& name, measured::Notes& notes) {
    return Reader(name, notes).read(std::move(text));
}

}  // namespace espalier::language::opf
