// The plants of every frame: plants.pvd, and plants/NNNN.vtp with a line per axis; polygons, organs, generalized
// cylinders and patches; labels.
//
// Parameters: skeleton (true or false, default true); parameters (table of array name = "SYMBOL.NUMBER"): module
// parameters that become point arrays; a query's ("?E.1") also makes its queries vertices.
// Cell and point arrays: identity, parent, plant, symbol (index into symbol_names), birth, order, colour, kind
// (0 query, 1 axis, 2 polygon, 3 organ, 4 generalized cylinder, 5 patch, 6 label), and rgb where a plant has a palette;
// cell arrays besides: texture (index into texture_files) and back_colour; point arrays besides: Normals, TCoords,
// radius and the chosen parameters. Field data: the texts of the labels, in the order of their vertices.
#include "espalier/timeline/recorder.h"

#include "timeline/attribute_arrays.h"
#include "timeline/chosen_parameters.h"
#include "timeline/collection_file.h"
#include "timeline/folder.h"
#include "timeline/plant_mesh.h"
#include "timeline/vtk_file.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>

#include <algorithm>

namespace espalier {
namespace {

vtkSmartPointer<vtkCellArray> cell_array(Cells& cells) {
    auto array = vtkSmartPointer<vtkCellArray>::New();
    array->SetData(array_over<vtkTypeInt32Array>("", cells.offsets.data(), cells.offsets.size()),
                   array_over<vtkTypeInt32Array>("", cells.connectivity.data(), cells.connectivity.size()));
    return array;
}

class Skeleton final : public Recorder {
public:
    Skeleton(const Settings& settings, const RecorderContext& context)
        : folder_(context.folder),
          collection_(context.folder / "plants.pvd"),
          chosen_(read_chosen_parameters(settings.table("parameters"))) {}

    void record(const Frame& frame) override {
        if (!checked_) require_known(chosen_, frame.plants);
        checked_ = true;
        fill_mesh(frame);
        const std::string file = fmt::format("plants/{:04}.vtp", frame.step);
        make_folder(folder_ / "plants");
        write_vtk(folder_ / file, *poly_data(frame));
        collection_.add(frame.time, 0, "plants", file);
        collection_.write();
    }

    void finish() override {}

private:
    void fill_mesh(const Frame& frame) {
        mesh_.clear();
        for (std::uint32_t i = 0; i < frame.plants.size(); ++i) {
            const PlantFrame& plant = frame.plants[i];
            add_asked_queries(plant, i);
            add_axes(mesh_, plant.interpretation->geometry, i);
            add_polygons(mesh_, plant.interpretation->geometry, i);
            add_organs(mesh_, plant.interpretation->geometry, i);
            add_pieces(mesh_, plant.interpretation->geometry, i);
            add_labels(mesh_, plant.interpretation->geometry, i);
        }
    }

    void add_asked_queries(const PlantFrame& plant, std::uint32_t index) {
        std::vector<ParameterSlots> slots;
        for (const ChosenParameter& parameter : chosen_) {
            if (parameter.of_query()) slots.emplace_back(parameter, plant.model->alphabet);
        }
        const auto wanted = [&](const Query& query) {
            return std::any_of(slots.begin(), slots.end(),
                               [&](const ParameterSlots& slot) { return slot.find(*plant.string, query.module) >= 0; });
        };
        if (!slots.empty()) add_queries(mesh_, plant.interpretation->queries, wanted, index);
    }

    vtkSmartPointer<vtkPolyData> poly_data(const Frame& frame) {
        auto data = vtkSmartPointer<vtkPolyData>::New();
        vtkNew<vtkPoints> points;
        points->SetData(array_over<vtkFloatArray>("points", mesh_.points.data(), mesh_.points.size(), 3));
        data->SetPoints(points);
        data->SetVerts(cell_array(mesh_.vertices));
        data->SetLines(cell_array(mesh_.lines));
        data->SetPolys(cell_array(mesh_.polygons));

        const AttributeArrays arrays(frame, symbols_, chosen_);
        vtkPointData& of_points = *data->GetPointData();
        of_points.AddArray(array_over<vtkFloatArray>("radius", mesh_.radii.data(), mesh_.radii.size()));
        of_points.SetNormals(array_over<vtkFloatArray>("Normals", mesh_.normals.data(), mesh_.normals.size(), 3));
        of_points.SetTCoords(array_over<vtkFloatArray>("TCoords", mesh_.uvs.data(), mesh_.uvs.size(), 2));
        arrays.add_attributes(of_points, mesh_.owners);
        arrays.add_colours(of_points, mesh_.owners);
        arrays.add_parameters(of_points, mesh_.owners);
        vtkCellData& of_cells = *data->GetCellData();
        arrays.add_attributes(of_cells, cell_owners());
        arrays.add_looks(of_cells, cell_owners_, texture_files_);
        arrays.add_colours(of_cells, cell_owners_);
        add_texts(*data->GetFieldData(), "texture_files", texture_files_);
        add_texts(*data->GetFieldData(), "label_texts", mesh_.labels);
        add_time(*data->GetFieldData(), frame.time, frame.step);
        add_texts(*data->GetFieldData(), "symbol_names", symbols_.names());
        return data;
    }

    // VTK counts a data set's cells so: vertices, lines, polygons.
    const Column<Owner>& cell_owners() {
        cell_owners_.clear();
        for (const Cells* cells : {&mesh_.vertices, &mesh_.lines, &mesh_.polygons}) {
            cell_owners_.insert(cell_owners_.end(), cells->owners.begin(), cells->owners.end());
        }
        return cell_owners_;
    }

    std::filesystem::path folder_;
    CollectionFile collection_;
    std::vector<ChosenParameter> chosen_;
    bool checked_ = false;  ///< the chosen parameters against the models
    SymbolNumbers symbols_;
    std::vector<std::string> texture_files_;  ///< of the run so far, the first ""
    PlantMesh mesh_;
    Column<Owner> cell_owners_;
};

const RegisteredRecorder entry{
    {"skeleton", "plants.pvd and plants/NNNN.vtp: a line per axis, organs and surfaces, with identities",
     "skeleton (true or false, true): write them\n"
     "parameters (table, none): arrays from module parameters, as in { vigour = \"F.2\", light = \"?E.1\" }:\n"
     "    the 2nd parameter of F, and the 1st of ?E after its answer, whose queries become points"},
    [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
        auto recorder = std::make_unique<Skeleton>(settings, context);
        if (!settings.flag_or("skeleton", true)) return nullptr;
        return recorder;
    }};

}  // namespace
}  // namespace espalier
