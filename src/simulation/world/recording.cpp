#include "simulation/world/recording.h"

#include <algorithm>
#include <string>

namespace espalier::simulation {

template <class Is>
bool Recording::is_any(const Is& is) const {
    return any(ranks_, is_first(ranks_) && std::any_of(recorders_.begin(), recorders_.end(), is));
}

const Recording::Known& Recording::known() {
    if (known_) return *known_;
    Known found;
    found.is_there = is_any([](const Recorder*) { return true; });
    found.reads_fields = is_any([](const Recorder* recorder) { return !recorder->fields().empty(); });
    return known_.emplace(found);
}

bool Recording::reads_plants() {
    return is_any([](const Recorder* recorder) { return recorder->reads_plants(); });
}

bool Recording::reads_plants_at(int step, bool may_end) {
    return is_any([&](const Recorder* recorder) { return recorder->reads_plants_at(step, may_end); });
}

std::size_t Recording::points_per_file(bool may_cut) {
    std::size_t points = may_cut && recorders_.size() == 1 ? recorders_.front()->points_per_file() : 0;
    for (const std::string& told : from_all(ranks_, std::to_string(points))) {
        points = std::min<std::size_t>(points, std::stoull(told));
    }
    return points;
}

bool Recording::takes(std::optional<int> piece) const {
    return !recorders_.empty() && (is_first(ranks_) || piece);
}

void Recording::record(const Frame& frame) const {
    for (Recorder* recorder : recorders_) recorder->record(frame);
}

}  // namespace espalier::simulation
