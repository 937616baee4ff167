#include "espalier/timeline/frame_selection.h"

#include <algorithm>

namespace espalier::timeline {
namespace {

int sum(int frame, int step) {
    return frame > FrameSelection::never - step ? FrameSelection::never : frame + step;
}

const FrameSelection::Interval* interval_with(const std::vector<FrameSelection::Interval>& intervals, int frame) {
    const auto holds = [frame](const auto& interval) { return interval.begin <= frame && frame <= interval.end; };
    const auto found = std::find_if(intervals.begin(), intervals.end(), holds);
    return found == intervals.end() ? nullptr : &*found;
}

int after_by_step(const FrameSelection& selection, int frame) {
    if (frame < selection.first) return selection.first;
    const int step = std::max(1, selection.step);
    return sum(selection.first + (frame - selection.first) / step * step, step);
}

}  // namespace

int FrameSelection::after(int frame) const {
    if (intervals.empty()) {
        const auto key = std::upper_bound(keyframes.begin(), keyframes.end(), frame);
        const int regular = after_by_step(*this, frame);
        return key == keyframes.end() ? regular : std::min(regular, *key);
    }
    const Interval* const here = interval_with(intervals, frame);
    const int ordinary = sum(frame, std::max(1, step));
    const int next = !here ? ordinary : here->step > 0 ? sum(frame, here->step) : sum(here->end, 1);
    if (interval_with(intervals, next)) return next;
    int beginning = never;
    for (const Interval& interval : intervals) {
        if (interval.begin > frame) beginning = std::min(beginning, interval.begin);
    }
    return beginning < never ? beginning : ordinary;
}

}  // namespace espalier::timeline
