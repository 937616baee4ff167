#include "environment/light/sky/light_series.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::environment {

LightSeries::LightSeries(std::shared_ptr<const WeatherTable> table) : table_(std::move(table)) {
    if (!table_->has(AirQuantity::global)) {
        throw UserError({table_->source, 0, 0},
                        "there is no light in this weather: give it a column 'global (W m-2)' or 'par (umol m-2 s-1)'");
    }
    const auto value = [&](AirQuantity quantity, std::size_t i) { return table_->of(quantity)[i]; };
    for (std::size_t i = 0; i < table_->size(); ++i) {
        const double middle = (table_->from[i] + table_->to[i]) / 2;
        rows_.push_back({table_->has_mean_light ? middle : table_->light_hours[i], value(AirQuantity::global, i),
                         value(AirQuantity::diffuse, i), value(AirQuantity::par, i), table_->lines[i]});
        breaks_.push_back(table_->has_mean_light ? table_->from[i] : rows_.back().hours);
    }
    const auto is_dark = [](const MeasuredLight& row) { return !(row.global > 0) && !(row.par > 0); };
    if (std::all_of(rows_.begin(), rows_.end(), is_dark)) {
        throw UserError({table_->source, 0, 0}, "there is no light in any row");
    }
    first_ = breaks_.front();
    last_ = table_->has_mean_light ? table_->to.back() : rows_.back().hours;
}

MeasuredLight LightSeries::at(double hours) const {
    if (table_->has_mean_light) {
        const auto after = std::upper_bound(table_->to.begin(), table_->to.end() - 1, hours);
        MeasuredLight row = rows_[static_cast<std::size_t>(after - table_->to.begin())];
        row.hours = hours;
        return row;
    }
    const auto after = std::lower_bound(rows_.begin() + 1, rows_.end() - 1, hours,
                                        [](const MeasuredLight& row, double at) { return row.hours < at; });
    const MeasuredLight &a = *(after - 1), &b = *after;
    const double t = std::clamp((hours - a.hours) / (b.hours - a.hours), 0.0, 1.0);
    const auto between = [&](double MeasuredLight::*value) { return (1 - t) * (a.*value) + t * (b.*value); };
    return {hours, between(&MeasuredLight::global), between(&MeasuredLight::diffuse), between(&MeasuredLight::par),
            a.line};
}

}  // namespace espalier::environment
