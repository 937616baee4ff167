#include "timeline/meshes/frame_columns.h"

#include "espalier/base/error.h"

#include "base/text.h"
#include "timeline/files/vtk_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace espalier::timeline {
namespace {

bool is_in_pixels(const Frame& frame) {
    return std::any_of(frame.plants.begin(), frame.plants.end(),
                       [](const PlantFrame& plant) { return plant.interpretation->geometry.in_pixels; });
}

template <class T>
DataArray array_of(const std::string& name, const RewrittenColumn<T>& column, int components = 1) {
    DataArray array = data_array<T>(name, column.values(), components);
    array.changed = column.changed();
    return array;
}

void add_cells(VtkFile& file, const char* element, const Cells& cells) {
    file.open(element);
    file.add(array_of("connectivity", cells.connectivity));
    file.add(array_of("offsets", cells.offsets));
    file.close();
}

void add_arrays(VtkFile& file, const OwnerArrays& arrays) {
    for (std::size_t i = 0; i < arrays.size(); ++i) file.add(arrays[i]);
}

/// The numbers as values of several numbers each.
template <class Value, class Number>
Column<Value> column_of(const RewrittenColumn<Number>& numbers) {
    Column<Value> values(numbers.size() * sizeof(Number) / sizeof(Value));
    if (!values.empty()) std::memcpy(values.data(), numbers.values().data(), values.size() * sizeof(Value));
    return values;
}

/// The queries whose modules are `wanted`, as vertices in string order.
template <class Wanted>
void add_queries(PlantMesh& mesh, const Interpretation& interpretation, const Wanted& wanted, std::uint32_t plant) {
    const auto add = [&](std::uint32_t module, const glm::dvec3& position, double width) {
        if (!wanted(module)) return;
        const Owner owner{plant, module, 0, 0, Kind::query};
        mesh.vertices.connectivity.add(mesh.add_point({position, {0, 0, 1}, {}}, width / 2, owner));
        mesh.vertices.close(owner);
    };
    auto answer = interpretation.answers.begin();
    const auto add_answers_before = [&](std::size_t module) {
        for (; answer != interpretation.answers.end() && answer->module < module; ++answer) {
            add(answer->module, answer->position, answer->width);
        }
    };
    for (const Query& query : interpretation.queries) {
        add_answers_before(query.module);
        add(query.module, query.pose.position, query.width);
    }
    add_answers_before(std::numeric_limits<std::size_t>::max());
}

FrameCells cells_of(const Cells& cells, std::size_t first) {
    FrameCells result;
    result.offsets.insert(result.offsets.end(), cells.offsets.values().begin(), cells.offsets.values().end());
    result.connectivity = column_of<std::int32_t>(cells.connectivity);
    result.first = first;
    return result;
}

FrameAttributes attributes_of(const OwnerArrays& arrays) {
    FrameAttributes result;
    result.for_columns([&](const char* name, auto& column) { arrays.copy(name, column); });
    arrays.copy("rgb", result.rgb);
    arrays.copy("organ", result.organs);
    return result;
}

}  // namespace

FrameColumns::FrameColumns(std::optional<std::filesystem::path> folder, const Settings& timeline)
    : folder_(std::move(folder)),
      chosen_(read_chosen_parameters(timeline.table("parameters"))),
      organ_quantities_(timeline) {}

bool FrameColumns::shows_queries() const {
    return std::any_of(chosen_.begin(), chosen_.end(), [](const ChosenParameter& one) { return one.of_query(); });
}

void FrameColumns::expect(std::span<const Model* const> models) {
    for (const Model* model : models) symbols_.of(*model);
}

MeshSize FrameColumns::foreseen(const Interpretation& interpretation) const {
    const std::size_t queries =
        shows_queries() ? interpretation.queries.size() + interpretation.answers.size() : std::size_t{0};
    return mesh_size(interpretation.geometry, surface_sizes_, queries);
}

void FrameColumns::fill(const Frame& frame) {
    organ_quantities_.find(frame);
    mesh_.begin(is_in_pixels(frame));
    cell_owners_.begin();
    of_points_.begin();
    of_cells_.begin();
    fill_mesh(frame);
    fill_arrays(frame);
}

void FrameColumns::fill_mesh(const Frame& frame) {
    std::size_t points = 0;
    for (const PlantFrame& plant : frame.plants) points += points_foreseen(plant.interpretation->geometry);
    mesh_.reserve(points);
    for (std::uint32_t i = 0; i < frame.plants.size(); ++i) {
        const PlantFrame& plant = frame.plants[i];
        add_asked_queries(plant, i);
        add_drawn(mesh_, plant.interpretation->geometry, organs_, i, plant.palette);
    }
    mesh_.end();
    for (const Cells* cells : {&mesh_.vertices, &mesh_.lines, &mesh_.polygons}) cell_owners_.add(cells->owners);
    cell_owners_.end();
}

void FrameColumns::add_asked_queries(const PlantFrame& plant, std::uint32_t index) {
    std::vector<ParameterSlots> slots;
    for (const ChosenParameter& parameter : chosen_) {
        if (parameter.of_query()) slots.emplace_back(parameter, plant.model->alphabet);
    }
    const auto wanted = [&](std::uint32_t module) {
        return std::any_of(slots.begin(), slots.end(),
                           [&](const ParameterSlots& slot) { return slot.find(*plant.string, module) >= 0; });
    };
    if (!slots.empty()) add_queries(mesh_, *plant.interpretation, wanted, index);
}

void FrameColumns::fill_arrays(const Frame& frame) {
    const AttributeArrays arrays(frame, symbols_, chosen_);
    arrays.add_attributes(of_points_, mesh_.owners);
    arrays.add_colours(of_points_, mesh_.owners);
    arrays.add_parameters(of_points_, mesh_.owners);
    if (organ_quantities_.size() > 0) {
        arrays.add_organs(of_points_, mesh_.owners, frame.environment, organ_quantities_.known());
    }
    arrays.add_attributes(of_cells_, cell_owners_);
    arrays.add_looks(of_cells_, cell_owners_, folder_, texture_files_);
    arrays.add_colours(of_cells_, cell_owners_);
    const std::size_t texts = texture_files_.size() + symbols_.names().size();
    texts_changed_ = std::exchange(texts_before_, texts) != texts;
}

void FrameColumns::release() {
    mesh_ = {};
    cell_owners_ = {};
    of_points_ = {};
    of_cells_ = {};
}

bool FrameColumns::changed() const {
    return mesh_.changed() || of_points_.changed() || of_cells_.changed() || texts_changed_;
}

void FrameColumns::put_into(VtkFile& file, double time, int step) const {
    file.open("PolyData");
    file.open("FieldData");
    file.add_texts("texture_files", texture_files_);
    file.add_texts("label_texts", mesh_.labels);
    file.add_time(time, step);
    file.add_texts("symbol_names", symbols_.names());
    if (organ_quantities_.size() > 0) file.add_texts("organ_units", organ_quantities_.units());
    file.close();
    const auto cells = [](const Cells& of_kind) { return of_kind.offsets.size(); };
    file.open("Piece", fmt::format(R"(NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfPolys="{}")",
                                   mesh_.size(), cells(mesh_.vertices), cells(mesh_.lines), cells(mesh_.polygons)));
    file.open("PointData", R"(Normals="Normals" TCoords="TCoords")");
    file.add(array_of("radius", mesh_.radii, 1));
    if (mesh_.pixels.size() > 0) file.add(array_of("pixels", mesh_.pixels, 1));
    file.add(array_of("Normals", mesh_.normals, 3));
    file.add(array_of("TCoords", mesh_.uvs, 2));
    add_arrays(file, of_points_);
    file.close();
    file.open("CellData");
    add_arrays(file, of_cells_);
    file.close();
    file.add_points(array_of("points", mesh_.points, 3));
    add_cells(file, "Verts", mesh_.vertices);
    add_cells(file, "Lines", mesh_.lines);
    add_cells(file, "Polys", mesh_.polygons);
}

FrameGeometry FrameColumns::geometry() const {
    FrameGeometry geometry;
    geometry.points = column_of<glm::vec3>(mesh_.points);
    geometry.normals = column_of<glm::vec3>(mesh_.normals);
    geometry.uvs = column_of<glm::vec2>(mesh_.uvs);
    geometry.radii = column_of<float>(mesh_.radii);
    geometry.pixels = column_of<float>(mesh_.pixels);
    geometry.vertices = cells_of(mesh_.vertices, 0);
    geometry.lines = cells_of(mesh_.lines, geometry.vertices.size());
    geometry.polygons = cells_of(mesh_.polygons, geometry.vertices.size() + geometry.lines.size());
    geometry.of_points = attributes_of(of_points_);
    geometry.of_cells = attributes_of(of_cells_);
    of_cells_.copy("texture", geometry.textures);
    of_cells_.copy("back_colour", geometry.back_colours);
    for (const ChosenParameter& one : chosen_) of_points_.copy(one.name, geometry.parameters[one.name]);
    for (const OrganQuantity& one : organ_quantities_.known()) {
        if (one.components > 1) continue;  // a direction is no number
        Column<float> values;
        of_points_.copy(one.name, values);
        geometry.parameters[one.name].assign(values.begin(), values.end());
        if (!one.unit.empty() && one.unit != "1") geometry.units[one.name] = one.unit;
    }
    geometry.symbol_names = symbols_.names();
    geometry.texture_files = texture_files_;
    geometry.label_texts = mesh_.labels;
    return geometry;
}

OrganQuantities::OrganQuantities(const Settings& timeline)
    : names_(timeline.texts_or("organs", {})), place_(timeline.place("organs")) {}

void OrganQuantities::find(const Frame& frame) {
    if (known_.size() == names_.size()) return;
    const std::vector<OrganQuantity> there =
        frame.environment ? frame.environment->organ_quantities() : std::vector<OrganQuantity>();
    std::vector<std::string> names;
    for (const OrganQuantity& quantity : there) names.push_back(quantity.name);
    for (const std::string& name : names_) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) {
            throw UserError(place_, fmt::format("no process of the scene knows '{}' of organs{}; {}", name,
                                                did_you_mean(name, names),
                                                names.empty() ? "canopy-light and ray-light know what organs absorb"
                                                              : fmt::format("there are: {}", fmt::join(names, ", "))));
        }
        known_.push_back(there[static_cast<std::size_t>(found - names.begin())]);
    }
}

std::vector<std::string> OrganQuantities::units() const {
    std::vector<std::string> units;
    for (const OrganQuantity& quantity : known_) {
        units.push_back(quantity.name + ": " + (quantity.unit.empty() ? "1" : quantity.unit));
    }
    return units;
}

}  // namespace espalier::timeline
