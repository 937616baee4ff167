// Which steps of a run become frames.
#pragma once

#include "espalier/base/stations.h"

#include <limits>
#include <vector>

namespace espalier::timeline {

/// Frame `first`, and from each frame the next one some steps later; within an interval, by the interval's own step.
/// From outside the intervals the next one's beginning follows; after the last of them, the ordinary step counts again.
/// Without intervals there may be keyframes, which are frames besides and move no other.
struct FrameSelection {
    struct Interval {
        int begin = 0, end = 0;
        int step = 1;  ///< 0: its first frame only
    };

    int first = 0;
    int step = 1;
    std::vector<Interval> intervals;
    std::vector<int> keyframes{};  ///< ascending

    static constexpr int never = std::numeric_limits<int>::max();  ///< a `step` that leads to no frame

    /// The first frame of a later step than `frame`, which is one itself or -1.
    int after(int frame) const;
};

}  // namespace espalier::timeline
