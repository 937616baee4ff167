// Which steps of a run become frames.
#pragma once

#include <vector>

namespace espalier {

/// Frame `first`, and from each frame the next one some steps later; within an interval, by the interval's own step.
/// From outside the intervals the next one's beginning follows; after the last of them, the ordinary step counts again.
struct FrameSelection {
    struct Interval {
        int begin = 0, end = 0;
        int step = 1;  ///< 0: its first frame only
    };

    int first = 0;
    int step = 1;
    std::vector<Interval> intervals;

    /// The frame after `frame`.
    int after(int frame) const;
};

}  // namespace espalier
