// One frame of the timeline: everything about one step that a recorder may read, after its exchange.
#pragma once

#include "espalier/environment/environment.h"
#include "espalier/geometry/palette.h"
#include "espalier/lsystem/module_string.h"
#include "espalier/turtle/background.h"
#include "espalier/turtle/interpretation.h"

#include <cstdint>
#include <memory>
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
};

/// A quantity of the environment for the modules of each plant of the frame; null where there is none.
struct OrganColumn {
    OrganQuantity quantity;
    std::vector<std::shared_ptr<const std::vector<float>>> of_plants;
};

struct Frame {
    int step = 0;     ///< frame k is k derivations
    double time = 0;  ///< scene's unit
    std::vector<PlantFrame> plants;
    const Fields* fields = nullptr;     ///< as they are until the next step
    bool is_last = false;               ///< no step follows in this run
    std::vector<OrganColumn> organs{};  ///< all that processes know of organs; values of those the scene asks for
};

}  // namespace espalier::timeline

namespace espalier {

using timeline::Frame;
using timeline::OrganColumn;
using timeline::PlantFrame;

}  // namespace espalier
