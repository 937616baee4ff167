// lifespans.vtp: every internode of the run once, with birth and death, written at the end of the run.
// A threshold birth <= t < death shows the plant as it stood at step t.
//
// Parameters: lifespans (true or false, default true).
// Each internode is a line of two points, where it was last seen. Cell arrays: identity, parent, plant, symbol (index
// into symbol_names), birth (step its module was born), death (first step without it; last step + 1 if it lives),
// alive (1 or 0), order, colour. Point array: radius.
#include "espalier/timeline/recorder.h"

#include "timeline/internode_lives.h"
#include "timeline/symbol_numbers.h"
#include "timeline/vtk_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeUInt16Array.h>
#include <vtkTypeUInt32Array.h>
#include <vtkTypeUInt64Array.h>
#include <vtkTypeUInt8Array.h>

#include <map>

namespace espalier {
namespace {

class Lifespans final : public Recorder {
public:
    explicit Lifespans(const RecorderContext& context) : path_(context.folder / "lifespans.vtp") {}

    bool sees_every_step() const override { return true; }

    void record(const Frame& frame) override {
        for (const PlantFrame& plant : frame.plants) {
            plants_[plant.plant].record(frame.step, plant, symbols_.of(*plant.model));
        }
        last_step_ = frame.step;
        time_ = frame.time;
    }

    void finish() override {
        gather();
        auto data = geometry();
        vtkFieldData& cells = *data->GetCellData();
        add_array<vtkTypeUInt64Array>(cells, "identity", [](const Row& row) { return row.life->identity; });
        add_array<vtkTypeUInt64Array>(cells, "parent", [](const Row& row) { return row.life->parent; });
        add_array<vtkTypeUInt32Array>(cells, "plant", [](const Row& row) { return row.plant; });
        add_array<vtkTypeUInt16Array>(cells, "symbol", [](const Row& row) { return row.life->symbol; });
        add_array<vtkTypeInt32Array>(cells, "birth", [](const Row& row) { return row.life->birth; });
        add_array<vtkTypeInt32Array>(
            cells, "death", [this](const Row& row) { return row.life->alive ? last_step_ + 1 : row.life->death; });
        add_array<vtkTypeUInt8Array>(cells, "alive", [](const Row& row) { return row.life->alive; });
        add_array<vtkTypeUInt16Array>(cells, "order", [](const Row& row) { return row.life->order; });
        add_array<vtkTypeUInt16Array>(cells, "colour", [](const Row& row) { return row.life->colour; });
        add_time(*data->GetFieldData(), time_, last_step_);
        add_texts(*data->GetFieldData(), "symbol_names", symbols_.names());
        write_vtk(path_, *data);
    }

private:
    struct Row {
        std::uint32_t plant;
        const InternodeLife* life;
    };

    void gather() {
        rows_.clear();
        for (const auto& [plant, lives] : plants_) {
            for (const InternodeLife& life : lives.all()) rows_.push_back({plant, &life});
        }
    }

    // Two points an internode: neighbours may have been seen last at different steps.
    vtkSmartPointer<vtkPolyData> geometry() const {
        vtkNew<vtkFloatArray> coordinates, radii;
        coordinates->SetNumberOfComponents(3);
        radii->SetName("radius");
        vtkNew<vtkCellArray> lines;
        lines->Use32BitStorage();
        for (const Row& row : rows_) {
            const InternodeLife& life = *row.life;
            const vtkIdType ends[] = {radii->InsertNextValue(life.base_radius),
                                      radii->InsertNextValue(life.tip_radius)};
            coordinates->InsertNextTypedTuple(&life.base.x);
            coordinates->InsertNextTypedTuple(&life.tip.x);
            lines->InsertNextCell(2, ends);
        }
        vtkNew<vtkPoints> points;
        points->SetData(coordinates);
        auto data = vtkSmartPointer<vtkPolyData>::New();
        data->SetPoints(points);
        data->SetLines(lines);
        data->GetPointData()->AddArray(radii);
        return data;
    }

    template <class Array, class Value>
    void add_array(vtkFieldData& data, const char* name, const Value& value) const {
        vtkNew<Array> array;
        array->SetName(name);
        array->SetNumberOfTuples(static_cast<vtkIdType>(rows_.size()));
        for (std::size_t i = 0; i < rows_.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), value(rows_[i]));
        data.AddArray(array);
    }

    std::filesystem::path path_;
    SymbolNumbers symbols_;
    std::map<std::uint32_t, InternodeLives> plants_;
    std::vector<Row> rows_;
    int last_step_ = 0;
    double time_ = 0;
};

const RegisteredRecorder entry{
    {"lifespans", "lifespans.vtp: every internode once, with birth and death; written at the end",
     "lifespans (true or false, true): write it"},
    [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
        if (!settings.flag_or("lifespans", true)) return nullptr;
        return std::make_unique<Lifespans>(context);
    }};

}  // namespace
}  // namespace espalier
