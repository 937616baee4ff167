// A frame that outlives its step: the world goes on while somebody still reads it.
#pragma once

#include "espalier/timeline/frame.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace espalier {

/// Nothing large is copied: strings, interpretations, models, palettes and grids are shared, and nobody writes into one
/// that somebody holds.
class KeptFrame {
public:
    /// With these of its fields; {"all"}, or the name of one that is not there, stands for all of them.
    void take(const Frame& frame, std::span<const std::string> fields);
    /// Valid until the next is taken, or this one released.
    Frame frame() const { return {step_, time_, plants_, &fields_}; }
    /// Holds nothing of the frame any longer.
    void release();

    /// What the plants of a frame take, without the grids.
    static std::size_t bytes(const Frame& frame);

private:
    void take_fields(const Fields& all, std::span<const std::string> wanted);

    int step_ = 0;
    double time_ = 0;
    std::vector<PlantFrame> plants_;
    Fields fields_;
};

}  // namespace espalier
