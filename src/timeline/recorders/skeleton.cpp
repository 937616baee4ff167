// The plants of every frame: plants.pvd, and plants/NNNN.vtp with a line per axis; polygons, organs, generalized
// cylinders and patches; labels.
//
// Parameters: skeleton (true or false, default true); parameters (table of array name = "SYMBOL.NUMBER"): module
// parameters that become point arrays; a query's ("?E.1") also makes its queries vertices.
// Cell and point arrays: identity, parent, plant, symbol (index into symbol_names), birth, order, colour, kind
// (0 query, 1 axis, 2 polygon, 3 organ, 4 generalized cylinder, 5 patch, 6 label), and rgb where a plant has a palette;
// cell arrays besides: texture (index into texture_files) and back_colour; point arrays besides: Normals, TCoords,
// radius, the chosen parameters, and pixels where a view file gives widths in pixels. Field data: the texts of the
// labels, in the order of their vertices.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "base/folder.h"
#include "timeline/files/collection_file.h"
#include "timeline/files/vtk_file.h"
#include "timeline/meshes/attribute_arrays.h"
#include "timeline/meshes/chosen_parameters.h"
#include "timeline/meshes/mesh_size.h"
#include "timeline/meshes/plant_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace espalier::timeline {
namespace {

/// All that a file of plants holds but its time, written anew for every frame.
struct PlantData {
    PlantMesh mesh;
    Owners cell_owners;  ///< VTK counts a data set's cells so: vertices, lines, polygons
    OwnerArrays of_points, of_cells;
    std::vector<std::string> texture_files;  ///< files of the run so far, the first ""
    std::vector<std::string> symbol_names;

    bool texts_changed = false;  ///< one of these two has changed

    void begin(bool with_pixels) {
        mesh.begin(with_pixels);
        cell_owners.begin();
        of_points.begin();
        of_cells.begin();
    }
    /// Since the frame before.
    bool changed() const { return mesh.changed() || of_points.changed() || of_cells.changed() || texts_changed; }
};

// Most organs are rhombi.
std::size_t points_foreseen(const Frame& frame) {
    std::size_t points = 0;
    for (const PlantFrame& plant : frame.plants) {
        const PlantGeometry& geometry = plant.interpretation->geometry;
        points += 2 * geometry.internodes.size() + 4 * geometry.organs.size() + geometry.vertices.size();
    }
    return points;
}

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

// Bytes of the arrays and of the texts that they become. Measured, as the texts' bytes in files of 13 models rich in
// one kind of organ each: 28 a point, nearly all of them coordinates, which hardly compress; 5.4 a corner and a cell;
// up to 28 for the attributes of a run. An array that grows beyond its memory is there twice for a moment.
std::size_t bytes_to_write(const MeshSize& size, std::size_t parameters) {
    constexpr std::size_t of_owner = sizeof(Owner) + sizeof(std::uint32_t);
    constexpr std::size_t attributes = 38, texts_of_attributes = 28;
    constexpr std::size_t of_point = 36 + 28, of_corner = 4 + 6, of_cell = 4 + 6;
    const std::size_t of_point_run =
        of_owner + sizeof(std::uint32_t) + attributes + texts_of_attributes + parameters * (8 + 11);
    const std::size_t of_cell_run = 2 * of_owner + attributes + texts_of_attributes;
    const std::size_t largest = std::max(16 * size.points, 6 * size.corners);
    return size.points * of_point + size.corners * of_corner + size.cells * of_cell + size.point_runs * of_point_run +
           size.cell_runs * of_cell_run + largest;
}

class Skeleton final : public Recorder {
public:
    Skeleton(const Settings& settings, const RecorderContext& context)
        : folder_(context.folder),
          scene_folder_(std::filesystem::path(settings.place().file).parent_path()),
          collection_(context.folder / "plants.pvd"),
          chosen_(read_chosen_parameters(settings.table("parameters"))),
          shows_queries_(std::any_of(chosen_.begin(), chosen_.end(), [](const auto& one) { return one.of_query(); })) {}

    void record(const Frame& frame) override {
        if (written_.empty()) require_known(chosen_, frame.plants);
        data_.begin(is_in_pixels(frame));
        fill_mesh(frame);
        fill_arrays(frame);
        if (!is_written()) write(frame);
        collection_.add(frame.time, 0, "plants", written_);
        collection_.write();
    }

    void finish() override {
        data_ = {};
        file_ = {};
    }

    RecordedMemory memory(int, const ModuleString& string, const Interpretation& interpretation) const override {
        return {bytes_to_write(mesh_size(interpretation, shows_queries_, surface_sizes_), chosen_.size()) +
                (chosen_.empty() ? 0 : sizeof(std::size_t) * string.size())};
    }

    void save(std::ostream& out) const override {
        collection_.save(out);
        put_text(out, written_);
        put(out, static_cast<std::uint64_t>(texture_files_.size()));
        for (const std::string& file : texture_files_) put_text(out, file);
        put(out, restored_ ? *restored_ : digest_of(data_));
    }

    void restore(std::istream& in) override {
        collection_.restore(in);
        written_ = get_text(in, longest_name);
        for (auto files = get<std::uint64_t>(in); files > 0; --files) {
            texture_files_.push_back(get_text(in, longest_name));
        }
        restored_ = get<std::uint64_t>(in);
    }

private:
    static constexpr std::uint64_t longest_name = 1 << 16;

    // True if the last file shows what is there now.
    bool is_written() {
        const auto digest = std::exchange(restored_, std::nullopt);
        if (written_.empty()) return false;
        return digest ? digest_of(data_) == *digest : !data_.changed();
    }

    static std::uint64_t digest_of(const PlantData& data) {
        VtkFile file;
        file.begin("PolyData");
        fill(file, data, 0, 0);
        return file.digest();
    }

    void fill_mesh(const Frame& frame) {
        PlantMesh& mesh = data_.mesh;
        mesh.reserve(points_foreseen(frame));
        for (std::uint32_t i = 0; i < frame.plants.size(); ++i) {
            const PlantFrame& plant = frame.plants[i];
            add_asked_queries(plant, i);
            add_axes(mesh, plant.interpretation->geometry, i);
            add_polygons(mesh, plant.interpretation->geometry, i);
            add_organs(mesh, plant.interpretation->geometry, organs_, i, plant.palette);
            add_pieces(mesh, plant.interpretation->geometry, i);
            add_labels(mesh, plant.interpretation->geometry, i);
        }
        mesh.end();
        for (const Cells* cells : {&mesh.vertices, &mesh.lines, &mesh.polygons}) data_.cell_owners.add(cells->owners);
        data_.cell_owners.end();
    }

    void add_asked_queries(const PlantFrame& plant, std::uint32_t index) {
        std::vector<ParameterSlots> slots;
        for (const ChosenParameter& parameter : chosen_) {
            if (parameter.of_query()) slots.emplace_back(parameter, plant.model->alphabet);
        }
        const auto wanted = [&](std::uint32_t module) {
            return std::any_of(slots.begin(), slots.end(),
                               [&](const ParameterSlots& slot) { return slot.find(*plant.string, module) >= 0; });
        };
        if (!slots.empty()) add_queries(data_.mesh, *plant.interpretation, wanted, index);
    }

    void fill_arrays(const Frame& frame) {
        const AttributeArrays arrays(frame, symbols_, chosen_);
        const Owners& of_points = data_.mesh.owners;
        arrays.add_attributes(data_.of_points, of_points);
        arrays.add_colours(data_.of_points, of_points);
        arrays.add_parameters(data_.of_points, of_points);
        arrays.add_attributes(data_.of_cells, data_.cell_owners);
        arrays.add_looks(data_.of_cells, data_.cell_owners, scene_folder_, texture_files_);
        arrays.add_colours(data_.of_cells, data_.cell_owners);
        data_.texts_changed = data_.texture_files != texture_files_ || data_.symbol_names != symbols_.names();
        data_.texture_files = texture_files_;
        data_.symbol_names = symbols_.names();
    }

    void write(const Frame& frame) {
        const std::string before = std::exchange(written_, {});  // in case something throws
        before.empty() ? file_.begin("PolyData") : file_.begin_after("PolyData");
        fill(file_, data_, frame.time, frame.step);
        const std::string name = fmt::format("plants/{:04}.vtp", frame.step);
        make_folder(folder_ / "plants");
        file_.write(folder_ / name);
        written_ = name;
    }

    static void fill(VtkFile& file, const PlantData& data, double time, int step) {
        const PlantMesh& mesh = data.mesh;
        file.open("PolyData");
        file.open("FieldData");
        file.add_texts("texture_files", data.texture_files);
        file.add_texts("label_texts", mesh.labels);
        file.add_time(time, step);
        file.add_texts("symbol_names", data.symbol_names);
        file.close();
        const auto cells = [](const Cells& of_kind) { return of_kind.offsets.size(); };
        file.open("Piece",
                  fmt::format(R"(NumberOfPoints="{}" NumberOfVerts="{}" NumberOfLines="{}" NumberOfPolys="{}")",
                              mesh.size(), cells(mesh.vertices), cells(mesh.lines), cells(mesh.polygons)));
        file.open("PointData", R"(Normals="Normals" TCoords="TCoords")");
        file.add(array_of("radius", mesh.radii, 1));
        if (mesh.pixels.size() > 0) file.add(array_of("pixels", mesh.pixels, 1));
        file.add(array_of("Normals", mesh.normals, 3));
        file.add(array_of("TCoords", mesh.uvs, 2));
        add_arrays(file, data.of_points);
        file.close();
        file.open("CellData");
        add_arrays(file, data.of_cells);
        file.close();
        file.add_points(array_of("points", mesh.points, 3));
        add_cells(file, "Verts", mesh.vertices);
        add_cells(file, "Lines", mesh.lines);
        add_cells(file, "Polys", mesh.polygons);
    }

    std::filesystem::path folder_, scene_folder_;
    CollectionFile collection_;
    std::vector<ChosenParameter> chosen_;
    bool shows_queries_;
    mutable SurfaceSizes surface_sizes_;
    SymbolNumbers symbols_;
    std::vector<std::string> texture_files_;
    OrganSource organs_;
    PlantData data_;                         ///< what the last file shows
    std::optional<std::uint64_t> restored_;  ///< what a checkpoint holds of the last file
    std::string written_;                    ///< the last file, relative to the folder; empty before the first
    VtkFile file_;
};

const Registered<RecorderType> entry{
    {"skeleton", "plants.pvd and plants/NNNN.vtp: a line per axis, organs and surfaces, with identities",
     "skeleton    true; false: the files are not written\n"
     "parameters  {}; arrays from module parameters, as in { vigour = \"F.2\", light = \"?E.1\" }: the 2nd parameter\n"
     "            of F, and the 1st of ?E after its answer, whose queries become points",
     [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
         auto recorder = std::make_unique<Skeleton>(settings, context);
         if (!settings.flag_or("skeleton", true)) return nullptr;
         return recorder;
     }}};

}  // namespace
}  // namespace espalier::timeline
