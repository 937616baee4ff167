// Soil that stands still: its heads are given, and what roots take is put back.
#include "espalier/base/stop.h"

#include "environment/soil/richards/richards.h"

#include <algorithm>

namespace espalier::environment {

void Richards::set_measured_heads(double day) {
    if (!parameters_.measured.any()) return;
    layout_.for_rows([&](std::size_t row) {
        const double head = parameters_.measured.at(grid_.centre({0, grid_.y_of(row), 0}).y, day);
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            if (!layout_.free(c)) continue;
            head_[c] = head;
            content_[c] = layout_.kind(c).at(head).content;
        }
    });
}

void Richards::stand_still(double days, std::span<SoilSink* const> sinks) {
    const double end = day_ + days;
    while (end - day_ > 1e-12 * (1 + std::abs(end))) {
        end_if_asked();
        const double span = longest_substep(end, sinks), stored = balance_.stored;
        set_measured_heads(day_ + 0.5 * span);
        measure();
        trial_ = head_;
        find_points();
        std::fill(uptake_.begin(), uptake_.end(), 0);
        std::fill(uptake_by_head_.begin(), uptake_by_head_.end(), 0);
        for (SoilSink* sink : sinks) {
            sink->has_jumped(day_);
            sink->draw(points_, day_, span, 1, uptake_, uptake_by_head_);
        }
        double drunk = 0;
        for (const double uptake : uptake_) drunk += uptake * edge_ * span;
        balance_.flown.drunk += drunk;
        balance_.flown.added += drunk + (balance_.stored - stored);
        if (!followers_.empty()) record_movement(span, 1);
        for (SoilSink* sink : sinks) sink->accept(span, 1);
        day_ = std::abs(end - day_ - span) < 1e-12 * (1 + std::abs(end)) ? end : day_ + span;
        ++substeps_;
    }
}

}  // namespace espalier::environment
