// Water that queries take from the soil between its steps, and the soil in checkpoints.
#include "base/bytes.h"
#include "environment/soil/richards/richards.h"

#include <algorithm>
#include <istream>
#include <ostream>

namespace espalier::environment {

/// What lies above the wilting point.
WaterBrick Richards::available() const {
    WaterBrick available(grid_.cells(), 0.0);
    layout_.for_free([&](std::size_t c) {
        available[c] = std::max(0.0, content_[c] - layout_.kind(c).at(parameters_.wilting_head).content);
    });
    return available;
}

void Richards::drink(const std::function<double(WaterBrick&)>& take) {
    WaterBrick left = available();
    const WaterBrick before = left;
    const double taken = take(left);
    if (taken == 0) return;
    layout_.for_free([&](std::size_t c) {
        if (left[c] == before[c]) return;
        content_[c] -= before[c] - left[c];
        head_[c] = layout_.kind(c).head_at(content_[c], head_[c]);
    });
    balance_.flown.drunk += taken * edge_;
    measure();
}

void Richards::save(std::ostream& out) const {
    for (const WaterBrick* brick : {&head_, &content_, &rate_, &ponding_}) {
        write_doubles(out, {brick->data(), brick->size()});
    }
    const double numbers[] = {
        day_, next_substep_, last_days_, has_rate_ ? 1.0 : 0.0, smooth_ ? 1.0 : 0.0, static_cast<double>(substeps_)};
    write_doubles(out, numbers);
    put(out, balance_);
    put(out, rates_);
    put(out, forcing_);
    movement_.save(out);
}

void Richards::restore(std::istream& in) {
    for (WaterBrick* brick : {&head_, &content_, &rate_, &ponding_}) read_doubles(in, {brick->data(), brick->size()});
    double numbers[6];
    read_doubles(in, numbers);
    day_ = numbers[0];
    next_substep_ = numbers[1];
    last_days_ = numbers[2];
    has_rate_ = numbers[3] != 0;
    smooth_ = numbers[4] != 0;
    substeps_ = static_cast<std::size_t>(numbers[5]);
    balance_ = get<SoilBalance>(in);
    rates_ = get<SoilRates>(in);
    forcing_ = get<SoilForcing>(in);
    movement_.restore(in);
    measure();
}

}  // namespace espalier::environment
