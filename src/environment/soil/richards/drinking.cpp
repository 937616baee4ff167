// Water that queries take from the soil between its steps, and the soil in checkpoints.
#include "environment/soil/linear/stock.h"
#include "environment/soil/richards/richards.h"

#include <algorithm>
#include <istream>
#include <ostream>

namespace espalier::environment {

/// What lies above the wilting point.
WaterBrick Richards::available() const {
    WaterBrick available(grid_.cells(), 0.0);
    layout_.for_rows([&](std::size_t row) {
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            if (!layout_.free(c)) continue;
            available[c] = std::max(0.0, content_[c] - layout_.kind(c).at(parameters_.wilting_head).content);
        }
    });
    return available;
}

std::vector<double> Richards::share(std::span<const WaterWish> wishes) {
    if (wishes.empty()) return {};
    WaterBrick left = available();
    const WaterBrick before = left;
    ShareResult result = share_water(grid_, wishes, left);
    layout_.for_rows([&](std::size_t row) {
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            if (left[c] == before[c]) continue;
            content_[c] -= before[c] - left[c];
            head_[c] = layout_.kind(c).head_at(content_[c], head_[c]);
        }
    });
    balance_.flown.drunk += result.taken * edge_;
    measure();
    return std::move(result.obtained);
}

std::vector<double> Richards::lend(std::span<const WaterWish> wishes) const {
    const WaterBrick stock = available();
    std::vector<double> obtained;
    obtained.reserve(wishes.size());
    for (const WaterWish& wish : wishes) obtained.push_back(obtain_alone(grid_, wish, stock));
    return obtained;
}

void Richards::save(std::ostream& out) const {
    for (const WaterBrick* brick : {&head_, &content_, &rate_, &ponding_}) {
        write_doubles(out, {brick->data(), brick->size()});
    }
    const double numbers[] = {
        day_, next_substep_, last_days_, has_rate_ ? 1.0 : 0.0, smooth_ ? 1.0 : 0.0, static_cast<double>(substeps_)};
    write_doubles(out, numbers);
    out.write(reinterpret_cast<const char*>(&balance_), sizeof balance_);
    out.write(reinterpret_cast<const char*>(&rates_), sizeof rates_);
    out.write(reinterpret_cast<const char*>(&forcing_), sizeof forcing_);
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
    in.read(reinterpret_cast<char*>(&balance_), sizeof balance_);
    in.read(reinterpret_cast<char*>(&rates_), sizeof rates_);
    in.read(reinterpret_cast<char*>(&forcing_), sizeof forcing_);
    movement_.restore(in);
    measure();
}

}  // namespace espalier::environment
