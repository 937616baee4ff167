#include "espalier/timeline/frame_selection.h"

#include <algorithm>
#include <limits>

namespace espalier {
namespace {

int sum(int frame, int step) {
    const int most = std::numeric_limits<int>::max();
    return frame > most - step ? most : frame + step;
}

const FrameSelection::Interval* interval_with(const std::vector<FrameSelection::Interval>& intervals, int frame) {
    const auto holds = [frame](const auto& interval) { return interval.begin <= frame && frame <= interval.end; };
    const auto found = std::find_if(intervals.begin(), intervals.end(), holds);
    return found == intervals.end() ? nullptr : &*found;
}

}  // namespace

int FrameSelection::after(int frame) const {
    const Interval* const here = interval_with(intervals, frame);
    const int ordinary = sum(frame, std::max(1, step));
    const int next = !here ? ordinary : here->step > 0 ? sum(frame, here->step) : sum(here->end, 1);
    if (interval_with(intervals, next)) return next;
    int beginning = std::numeric_limits<int>::max();
    for (const Interval& interval : intervals) {
        if (interval.begin > frame) beginning = std::min(beginning, interval.begin);
    }
    return beginning < std::numeric_limits<int>::max() ? beginning : ordinary;
}

}  // namespace espalier
