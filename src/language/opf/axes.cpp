#include "language/opf/axes.h"

#include "espalier/base/file.h"
#include "espalier/base/math.h"

#include "base/number.h"
#include "base/text.h"
#include "language/measured/cells.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/units.h"
#include "language/opf/document.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <iterator>
#include <map>

namespace espalier::language::opf {
namespace {

constexpr std::size_t most_corners = 10'000'000;  ///< of all faces of organs

/// Where a plant of a scene stands; lengths in metres, in the file's axes.
struct Stand {
    glm::dmat3 turn{1};
    double scale = 1;
    glm::dvec3 at{0};
};

/// What is said of a file's lengths and axes.
class Axes {
public:
    explicit Axes(const MeasuredOptions& options)
        : unit(options.unit.empty() ? "cm" : options.unit),
          up(options.up.empty() ? "z" : options.up),
          metres(options.pixel ? *options.pixel : measured::metres_of_unit(unit)),
          upright(measured::upright(up)) {}

    std::string unit, up;
    double metres;
    glm::dmat3 upright;
};

/// The pieces of a document as axes, behind those of others.
class Pieces {
public:
    /// `first_mesh` is the number that the document's first mesh has among those of all.
    Pieces(const Document& document, const Axes& axes, const Stand& stand, std::size_t first_mesh)
        : document_(document),
          first_mesh_(first_mesh),
          axes_(axes),
          stand_(stand),
          last_inside_(document.entities.size(), none),
          complex_of_(document.entities.size(), none) {
        for (std::uint32_t v = 0; v < complex_of_.size(); ++v) {
            const Entity& entity = document.entities[v];
            if (entity.inside == none) continue;
            complex_of_[v] = entity.relation == '/' ? entity.inside : complex_of_[entity.inside];
        }
    }

    void add_to(std::vector<measured::LooseAxis>& loose, std::vector<MeasuredPlant>& plants) {
        std::vector<std::uint32_t> axis_of(document_.entities.size(), none);
        std::vector<bool> is_continued(document_.entities.size());
        std::map<std::uint32_t, std::size_t> plant_of;
        for (std::uint32_t v = 0; v < document_.entities.size(); ++v) {
            if (!document_.entities[v].mesh) continue;
            char relation = '/';
            const std::uint32_t bearer = bearer_of(v, relation);
            if (bearer != none && !is_piece(v)) {
                std::vector<MeasuredNode>& nodes = loose[axis_of[bearer]].nodes;
                loose[axis_of[bearer]].organs.push_back(organ(v, nodes.size() - 1));
                continue;
            }
            if (is_piece(v)) remember(v);
            if (bearer != none && relation == '<' && !is_continued[bearer]) {
                is_continued[bearer] = true;
                axis_of[v] = axis_of[bearer];
                add_piece(v, loose[axis_of[v]].nodes);
                continue;
            }
            axis_of[v] = static_cast<std::uint32_t>(loose.size());
            measured::LooseAxis& axis = loose.emplace_back();
            axis.label = document_.entities[v].label;
            axis.place = document_.entities[v].at;
            if (bearer != none) {
                axis.bearer = axis_of[bearer];
                axis.plant = loose[*axis.bearer].plant;
            } else {
                const std::uint32_t whole = whole_of(v);
                const auto [found, is_new] = plant_of.try_emplace(whole, plants.size());
                if (is_new) plants.push_back({document_.entities[whole].label});
                axis.plant = found->second;
            }
            if (is_piece(v)) {
                add_piece(v, axis.nodes);
            } else {
                // Nothing bears it: it is an axis of one node.
                axis.nodes.push_back({placed(document_.entities[v].place[3]), 0, 0, false});
                axis.organs.push_back(organ(v, 0));
            }
        }
    }

private:
    const Mesh& mesh_of(std::uint32_t v) const { return document_.meshes[*document_.entities[v].mesh]; }

    bool is_piece(std::uint32_t v) const { return mesh_of(v).is_tube(); }

    MeasuredOrgan organ(std::uint32_t v, std::size_t node) const {
        const Entity& entity = document_.entities[v];
        MeasuredOrgan organ;
        organ.mesh = first_mesh_ + *entity.mesh;
        organ.on_node = node;
        const glm::dmat3 turn = stand_.scale * axes_.metres * (axes_.upright * stand_.turn);
        for (int column = 0; column < 3; ++column) organ.place[column] = turn * entity.place[column];
        organ.place[3] = placed(entity.place[3]);
        if (mesh_of(v).is_scaled) {
            organ.below = entity.lower;
            organ.above = entity.upper;
        }
        return organ;
    }

    /// The piece that an entity stands on, and how: what it is nested in, or the last piece of that.
    std::uint32_t bearer_of(std::uint32_t v, char& relation) const {
        relation = '/';
        while (document_.entities[v].inside != none) {
            const Entity& entity = document_.entities[v];
            v = entity.inside;
            // A part stands on what its whole stands on, unless it follows another.
            if (entity.relation == '/' && last_inside_[v] == none) continue;
            if (relation == '/') relation = entity.relation == '/' ? '+' : entity.relation;
            if (document_.entities[v].mesh && is_piece(v)) return v;
            if (last_inside_[v] != none) return last_inside_[v];
        }
        return none;
    }

    /// Makes a piece the last of what it is a part of, unless it is borne by another part.
    void remember(std::uint32_t piece) {
        for (std::uint32_t v = piece; v != none && document_.entities[v].relation != '+';) {
            v = complex_of_[v];
            if (v != none) last_inside_[v] = piece;
        }
    }

    /// What is coarsest around it, except a scene.
    std::uint32_t whole_of(std::uint32_t v) const {
        while (document_.entities[v].inside != none && document_.entities[document_.entities[v].inside].scale > 0) {
            v = document_.entities[v].inside;
        }
        return v;
    }

    glm::dvec3 placed(const glm::dvec3& at) const {
        return axes_.upright * (stand_.at + stand_.turn * (stand_.scale * axes_.metres * at));
    }

    void add_piece(std::uint32_t v, std::vector<MeasuredNode>& nodes) const {
        const Entity& entity = document_.entities[v];
        const Mesh& mesh = mesh_of(v);
        const auto at = [&](double x) { return placed(entity.place * glm::dvec4(x, 0, 0, 1)); };
        const double across = (mesh.upper.y - mesh.lower.y) * glm::length(entity.place[1]);
        const double factor = mesh.is_scaled ? 0.5 * (entity.upper + entity.lower) : 1;
        const double diameter = stand_.scale * axes_.metres * std::abs(across * factor);
        const glm::dvec3 begin = at(mesh.lower.x), end = at(mesh.upper.x);
        const double tolerance = 1e-5 * glm::distance(begin, end);
        if (nodes.empty() || glm::distance(nodes.back().at, begin) > tolerance) {
            nodes.push_back({begin, diameter, 0, !nodes.empty()});
        }
        nodes.push_back({end, diameter, 0, false});
    }

    const Document& document_;
    std::size_t first_mesh_;
    const Axes& axes_;
    const Stand& stand_;
    std::vector<std::uint32_t> last_inside_;  ///< the last piece that is a part of each
    std::vector<std::uint32_t> complex_of_;   ///< what each is a part of
};

void require_fit(const std::vector<measured::LooseAxis>& loose, const std::vector<MeasuredMesh>& meshes,
                 const std::string& name) {
    std::size_t corners = 0;
    for (const measured::LooseAxis& axis : loose) {
        for (const MeasuredOrgan& organ : axis.organs) {
            for (const std::vector<std::uint32_t>& face : meshes[organ.mesh].faces) corners += face.size();
        }
    }
    if (corners <= most_corners) return;
    throw UserError(
        Place{name, 1, 1},
        fmt::format("the faces of all organs have {} corners together: {} are read at most", corners, most_corners));
}

MeasuredPlants finished(std::vector<measured::LooseAxis> loose, std::vector<MeasuredPlant> plants,
                        std::vector<MeasuredMesh> meshes, const Axes& axes, const std::string& name,
                        const measured::Notes& notes) {
    if (loose.empty()) throw UserError(Place{name, 1, 1}, "no entity of this file has a mesh with points and faces");
    require_fit(loose, meshes, name);
    MeasuredPlants read;
    read.meshes = std::move(meshes);
    read.axes = measured::joined(std::move(loose));
    read.plants = std::move(plants);
    read.unit = axes.unit;
    read.up = axes.up;
    read.warnings = notes.warnings();
    return read;
}

std::vector<MeasuredMesh> shapes_of(const Document& document) {
    std::vector<MeasuredMesh> shapes;
    for (const Mesh& mesh : document.meshes) shapes.push_back(mesh.shape);
    return shapes;
}

/// Rows of an .ops file: scene, plant, file, x, y, z (m), scale, azimuth and angle of inclination, twist (radians).
class SceneRow {
public:
    SceneRow(const std::vector<std::string_view>& cells, const Place& place) : cells_(cells), place_(place) {}

    std::string file() const { return std::string(cells_[2]); }

    Stand stand() const {
        Stand stand;
        stand.at = {number(3), number(4), number(5)};
        stand.scale = number(6);
        const glm::dmat3 azimuth = about_z(number(7));
        stand.turn = azimuth * about_y(number(8)) * glm::transpose(azimuth) * about_z(number(9));
        return stand;
    }

private:
    double number(std::size_t column) const {
        const std::optional<double> value = column < cells_.size() ? finite_number(cells_[column]) : std::nullopt;
        if (value && std::abs(*value) < 1e12) return *value;
        throw UserError(place_, "a plant of a scene is 'scene plant file x y z scale azimuth angle twist'");
    }

    static glm::dmat3 about_z(double angle) {
        const double c = math::cos(angle), s = math::sin(angle);
        return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
    }
    static glm::dmat3 about_y(double angle) {
        const double c = math::cos(angle), s = math::sin(angle);
        return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    }

    const std::vector<std::string_view>& cells_;
    Place place_;
};

}  // namespace

MeasuredPlants read_plants(std::string text, const std::string& name, const MeasuredOptions& options) {
    measured::Notes notes(name);
    const Axes axes(options);
    const Document document = read(std::move(text), name, notes);
    std::vector<measured::LooseAxis> loose;
    std::vector<MeasuredPlant> plants;
    Pieces(document, axes, Stand(), 0).add_to(loose, plants);
    return finished(std::move(loose), std::move(plants), shapes_of(document), axes, name, notes);
}

MeasuredPlants read_scene(const std::string& text, const std::filesystem::path& path, const MeasuredOptions& options) {
    const std::string name = path.string();
    measured::Notes notes(name);
    const Axes axes(options);
    std::map<std::string, std::pair<Document, std::size_t>> documents;  ///< and where its meshes begin
    std::vector<MeasuredMesh> meshes;
    std::vector<measured::LooseAxis> loose;
    std::vector<MeasuredPlant> plants;
    std::vector<std::string_view> cells;
    int line = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        measured::split_cells(measured::next_line(text, begin), ' ', cells);
        const Place place{name, ++line, 1};
        if (cells.empty() || cells[0].starts_with('#')) continue;
        if (cells[0] == "T") {
            notes.unused("the terrain", place);
            continue;
        }
        const SceneRow row(cells, place);
        const Stand stand = row.stand();
        auto found = documents.find(row.file());
        if (found == documents.end()) {
            const std::filesystem::path file = path.parent_path() / row.file();
            if (!is_readable(file)) {
                throw UserError(place, fmt::format("there is no file {}, which this plant is in", file.string()));
            }
            Document document = read(read_text(file), file.string(), notes);
            std::vector<MeasuredMesh> further = shapes_of(document);
            found = documents.emplace(row.file(), std::pair(std::move(document), meshes.size())).first;
            meshes.insert(meshes.end(), std::make_move_iterator(further.begin()),
                          std::make_move_iterator(further.end()));
        }
        const auto& [document, first_mesh] = found->second;
        Pieces(document, axes, stand, first_mesh).add_to(loose, plants);
    }
    return finished(std::move(loose), std::move(plants), std::move(meshes), axes, name, notes);
}

}  // namespace espalier::language::opf
