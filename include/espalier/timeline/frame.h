// One frame of the timeline: everything about one step that a recorder may read, after its exchange.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/environment/environment.h"
#include "espalier/geometry/palette.h"
#include "espalier/lsystem/module_string.h"
#include "espalier/turtle/background.h"
#include "espalier/turtle/interpretation.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace espalier::timeline {

/// One plant of a frame. It shares the values of its step, so that a recorder may keep them while the world goes on;
/// a process sees the same plant as a PlantView, which only borrows them for the exchange.
struct PlantFrame {
    std::uint32_t plant = 0;
    std::string name;
    const Model* model = nullptr;
    std::shared_ptr<const ModuleString> string;
    std::shared_ptr<const Interpretation> interpretation;
    std::vector<Quantity> quantities;        ///< "light.mean", ... of this plant, the same names in every frame
    const Palette* palette = nullptr;        ///< what colour indices look like; null: unknown
    const Background* background = nullptr;  ///< what stands around it in pictures; null: nothing
    /// Of a frame that is kept: what its environment knew of its modules, by the names that recorders read.
    std::map<std::string, std::shared_ptr<const std::vector<float>>> organs = {};
};

struct Frame {
    int step = 0;     ///< frame k is k derivations
    double time = 0;  ///< scene's unit
    std::vector<PlantFrame> plants;
    const Fields* fields = nullptr;            ///< as they are until the next step
    bool is_last = false;                      ///< no step follows in this run
    const Environment* environment = nullptr;  ///< knows what organs have met, until the next step; null: nothing
    // A world that is larger than memory gives its frames in parts, which have some of the plants each, in order.
    bool begins = true;                     ///< the first part
    bool ends = true;                       ///< the last part
    std::vector<const Model*> models = {};  ///< in the first part: those of all plants, each once, in their order
    /// Of a frame that several processes write, a file each in turn: the number of the file that shows these plants. In
    /// the last part, which has none and comes when all files are there: how many there are.
    std::optional<int> piece = {};
    double dt = 1;                   ///< between steps, scene's unit
    std::string time_unit = "step";  ///< name of that unit
};

}  // namespace espalier::timeline
