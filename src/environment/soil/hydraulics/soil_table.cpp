#include "environment/soil/hydraulics/soil_table.h"

#include "espalier/base/math.h"

#include "base/monotone_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::environment {
namespace {

const double oven_dry = 6.8 * math::log(10.0);  ///< log of a suction in cm

}  // namespace

SoilTable::SoilTable(std::vector<Row> rows) : rows_(std::move(rows)) {
    for (const Row& row : rows_) {
        if (row.head < 0) {
            points_.push_back({math::log(-row.head), row.content, 0, math::log(row.conductivity), 0});
        }
    }
    const auto set_slopes = [&](double Point::*value, double Point::*slope) {
        const auto rise = [&](std::size_t i) {
            return (points_[i + 1].*value - points_[i].*value) / (points_[i + 1].log_suction - points_[i].log_suction);
        };
        const std::size_t last = points_.size() - 1;
        points_.front().*slope = rise(0);
        points_.back().*slope = rise(last - 1);
        for (std::size_t i = 1; i < last; ++i) {
            points_[i].*slope =
                monotone_slope(rise(i - 1), rise(i), points_[i].log_suction - points_[i - 1].log_suction,
                               points_[i + 1].log_suction - points_[i].log_suction);
        }
    };
    set_slopes(&Point::content, &Point::content_slope);
    set_slopes(&Point::log_conductivity, &Point::conductivity_slope);
}

/// Wetter than all rows below 0.
double SoilTable::wet(double head, double Row::*column) const {
    const Row& first = rows_.front();
    if (first.head < 0) return first.*column;
    return first.*column + (rows_[1].*column - first.*column) * head / rows_[1].head;
}

const SoilTable::Point& SoilTable::point_before(double log_suction) const {
    const auto behind = std::upper_bound(points_.begin() + 1, points_.end() - 1, log_suction,
                                         [](double at, const Point& point) { return at < point.log_suction; });
    return *(behind - 1);
}

double SoilTable::hermite(const Point& a, const Point& b, double at, double Point::*value, double Point::*slope) {
    const double width = b.log_suction - a.log_suction, t = (at - a.log_suction) / width;
    const double rise = b.*value - a.*value, d0 = a.*slope * width, d1 = b.*slope * width;
    return a.*value + t * (d0 + t * (3 * rise - 2 * d0 - d1 + t * (d0 + d1 - 2 * rise)));
}

double SoilTable::content(double head) const {
    const double at = math::log(-head);
    if (at <= points_.front().log_suction) return wet(head, &Row::content);
    const Point& last = points_.back();
    if (at >= last.log_suction) {
        return last.content * std::max(0.0, (oven_dry - at) / (oven_dry - last.log_suction));
    }
    const Point& before = point_before(at);
    return hermite(before, *(&before + 1), at, &Point::content, &Point::content_slope);
}

double SoilTable::conductivity(double head) const {
    const double at = math::log(-head);
    if (at <= points_.front().log_suction) return wet(head, &Row::conductivity);
    const Point &last = points_.back(), &before_last = *(points_.end() - 2);
    if (at >= last.log_suction) {
        const double power =
            (last.log_conductivity - before_last.log_conductivity) / (last.log_suction - before_last.log_suction);
        return math::exp(last.log_conductivity + power * (at - last.log_suction));
    }
    const Point& before = point_before(at);
    return math::exp(hermite(before, *(&before + 1), at, &Point::log_conductivity, &Point::conductivity_slope));
}

}  // namespace espalier::environment
