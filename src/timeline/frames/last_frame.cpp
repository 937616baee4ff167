#include "espalier/timeline/last_frame.h"

#include "timeline/meshes/frame_columns.h"
#include "timeline/meshes/mesh_size.h"

#include <optional>

namespace espalier::timeline {

struct LastFrame::Columns {
    FrameColumns columns;
    SurfaceSizes sizes;
};

LastFrame::LastFrame(const Settings& timeline)
    : columns_(new Columns{FrameColumns(std::nullopt, read_chosen_parameters(timeline.table("parameters"))), {}}) {}

LastFrame::~LastFrame() = default;

void LastFrame::record(const Frame& frame) {
    FrameColumns& columns = columns_->columns;
    if (frame.step == 0) require_known(columns.chosen(), frame.plants);
    if (!frame.is_last) return;
    step_ = frame.step;
    time_ = frame.time;
    columns.fill(frame);
    geometry_ = std::make_shared<const FrameGeometry>(columns.geometry());
    columns.release();
    quantities_.clear();
    for (const PlantFrame& plant : frame.plants) quantities_.push_back(plant.quantities);
}

// Places, normals and radii stand in the columns of the frame and in what is kept of them, attributes as runs and
// whole.
RecordedMemory LastFrame::memory(int /*step*/, const ModuleString& /*string*/,
                                 const Interpretation& interpretation) const {
    constexpr std::size_t places = 36, attributes = 36, of_run = 64;
    const FrameColumns& columns = columns_->columns;
    const MeshSize size = mesh_size(interpretation, columns.shows_queries(), columns_->sizes);
    const std::size_t parameters = columns.chosen().size() * sizeof(double);
    return {size.points * (2 * places + attributes + parameters) + 8 * size.corners + size.cells * (8 + attributes) +
            (size.point_runs + size.cell_runs) * (of_run + parameters)};
}

}  // namespace espalier::timeline
