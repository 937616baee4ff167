// A frame that outlives its step: the world goes on while a recorder still reads it.
#pragma once

#include "espalier/timeline/frame.h"

#include <cstddef>
#include <span>
#include <string>

namespace espalier::timeline {

/// Nothing large is copied: strings, interpretations, models, palettes and grids are shared, and the world does not
/// write into what a frame holds.
class KeptFrame {
public:
    /// With these of its fields; {"all"}, or the name of one that is not there, stands for all of them. `organs`: what
    /// its plants are to know of their organs.
    void take(const Frame& frame, std::span<const std::string> fields, std::span<const std::string> organs = {});
    /// Valid until the next is taken, or this one released.
    const Frame& frame() const { return frame_; }
    /// Holds nothing of the frame any longer.
    void release();

    /// What the plants of a frame take, without the grids.
    static std::size_t bytes(const Frame& frame);

private:
    void take_fields(const Fields& all, std::span<const std::string> wanted);

    Frame frame_;
    Fields fields_;  // instead of the world's, which change with its next step
};

}  // namespace espalier::timeline
