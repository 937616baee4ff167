// A frame that outlives its step: the world goes on while somebody still reads it.
#pragma once

#include "espalier/timeline/frame.h"

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <vector>

namespace espalier {

/// Models and palettes are shared, grids too: nobody writes into one that somebody holds. Reused from frame to frame,
/// it keeps its memory.
class FrameCopy {
public:
    /// With these of its fields; {"all"}, or the name of one that is not there, stands for all of them.
    void take(const Frame& frame, std::span<const std::string> fields);
    /// Valid until the next is taken.
    Frame frame() const { return {step_, time_, plants_, &fields_}; }

    /// What a copy of this frame takes, without the grids.
    static std::size_t bytes(const Frame& frame);

private:
    void take_fields(const Fields& all, std::span<const std::string> wanted);

    struct Plant {
        ModuleString string;
        Interpretation interpretation;
    };

    int step_ = 0;
    double time_ = 0;
    std::deque<Plant> storage_;
    std::vector<PlantFrame> plants_;
    Fields fields_;
};

}  // namespace espalier
