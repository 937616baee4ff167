#include "view/small_chart.h"

#include "espalier/picture/chart_page.h"

#include <algorithm>
#include <cmath>

namespace espalier::view {
namespace {

/// From the chart's values to pixels.
class Scale {
public:
    Scale(const Rectangle& at, const Ticks& x, const Ticks& y) : at_(at), x_(x), y_(y) {}

    vtkVector2f operator()(double x, double y) const {
        return {at_.x + at_.width * static_cast<float>((x - x_.low) / (x_.high - x_.low)),
                at_.y + at_.height * static_cast<float>((y - y_.low) / (y_.high - y_.low))};
    }

private:
    const Rectangle& at_;
    const Ticks &x_, &y_;
};

Ticks ticks_of(const std::vector<double>& values, bool from_zero, int count) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (low > high) low = high = 0;
    // What does not change but for its rounding is a line between zero and itself.
    constexpr double rounding = 1e-4;
    const bool is_constant = high - low <= rounding * std::max(std::abs(low), std::abs(high));
    if (from_zero && low > 0 && (is_constant || low < high / 2)) low = 0;
    if (from_zero && high < 0 && is_constant) high = 0;
    if (low == high) high = low + 1;
    return ticks_over(low, high, count);
}

}  // namespace

void paint_chart(Painter& painter, const Rectangle& at, const SmallChart& chart, double now,
                 const WindowColours& colours) {
    painter.text(at.x, at.y + at.height - painter.scaled(8), chart.title, colours.dim, 12);
    const Ticks x = ticks_of(chart.x, false, 4), y = ticks_of(chart.y, true, 3);
    const float left = painter.scaled(40), below = painter.scaled(16), above = painter.scaled(24);
    const Rectangle plot{at.x + left, at.y + below, at.width - left - painter.scaled(8), at.height - below - above};
    const Scale place(plot, x, y);
    for (std::size_t i = 0; i < y.places.size(); ++i) {
        const vtkVector2f from = place(x.low, y.places[i]);
        painter.line({from, place(x.high, y.places[i])}, colours.line);
        painter.text(from.GetX() - painter.scaled(6), from.GetY(), y.labels[i], colours.dim, 11, false, Align::right);
    }
    for (std::size_t i = 0; i < x.places.size(); ++i) {
        const vtkVector2f from = place(x.places[i], y.low);
        painter.text(from.GetX(), at.y + painter.scaled(5), x.labels[i], colours.dim, 11, false, Align::centre);
    }
    if (now >= x.low && now <= x.high) painter.line({place(now, y.low), place(now, y.high)}, colours.dim);
    std::vector<vtkVector2f> points;
    const auto end_line = [&] {
        painter.line(points, colours.accent, 2);
        if (points.size() == 1) {
            painter.disc(points[0].GetX(), points[0].GetY(), painter.scaled(2), colours.accent);
        }
        points.clear();
    };
    for (std::size_t i = 0; i < chart.x.size(); ++i) {
        if (std::isfinite(chart.y[i])) {
            points.push_back(place(chart.x[i], chart.y[i]));
        } else {
            end_line();
        }
    }
    end_line();
}

}  // namespace espalier::view
