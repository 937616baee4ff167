#include "espalier/timeline/last_frame.h"

#include "timeline/meshes/frame_columns.h"

#include <optional>

namespace espalier::timeline {

LastFrame::LastFrame(const Settings& timeline) : columns_(std::make_unique<FrameColumns>(std::nullopt, timeline)) {}

LastFrame::~LastFrame() = default;

void LastFrame::record(const Frame& frame) {
    if (frame.step == 0) columns_->require_known(frame.models);
    if (!frame.is_last) return;
    step_ = frame.step;
    time_ = frame.time;
    columns_->fill(frame);
    geometry_ = std::make_shared<const FrameGeometry>(columns_->geometry());
    columns_->release();
    quantities_.clear();
    for (const PlantFrame& plant : frame.plants) quantities_.push_back(plant.quantities);
}

// Places, normals and radii stand in the columns of the frame and in what is kept of them, attributes as runs and
// whole.
RecordedMemory LastFrame::memory(int /*step*/, const ModuleString& /*string*/,
                                 const Interpretation& interpretation) const {
    constexpr std::size_t places = 36, attributes = 36, of_run = 80;
    const MeshSize size = columns_->foreseen(interpretation);
    const std::size_t parameters = columns_->chosen() * sizeof(double);
    return {size.points * (2 * places + attributes + parameters) + 8 * size.corners + size.cells * (8 + attributes) +
            (size.point_runs + size.cell_runs) * (of_run + parameters)};
}

}  // namespace espalier::timeline
