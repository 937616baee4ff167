// The last frame of a run, in memory instead of in a file.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/frame_geometry.h"
#include "espalier/timeline/recorder.h"

#include <memory>
#include <vector>

namespace espalier::timeline {

class FrameColumns;

/// Keeps what a run ends with: its plants as their file in a timeline would hold them, but for textures, which are
/// named by their whole paths.
class LastFrame final : public Recorder {
public:
    /// `timeline` chooses parameters and quantities of organs, as it does for the recorder 'skeleton'. Throws UserError
    /// as that does.
    explicit LastFrame(const Settings& timeline = {});
    ~LastFrame() override;

    void record(const Frame& frame) override;
    void finish() override {}
    RecordedMemory memory(int step, const ModuleString& string, const Interpretation& interpretation) const override;

    int step() const { return step_; }
    double time() const { return time_; }
    /// Null before the last step.
    const std::shared_ptr<const FrameGeometry>& geometry() const { return geometry_; }
    /// Quantities of each plant.
    const std::vector<std::vector<Quantity>>& quantities() const { return quantities_; }

private:
    std::unique_ptr<FrameColumns> columns_;
    int step_ = 0;
    double time_ = 0;
    std::shared_ptr<const FrameGeometry> geometry_;
    std::vector<std::vector<Quantity>> quantities_;
};

}  // namespace espalier::timeline
