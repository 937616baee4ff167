#include "picture/charts/line_chart.h"

#include "picture/charts/chart_look.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPoints2D.h>
#include <vtkRect.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

constexpr std::size_t most_marked = 12;

/// The points of a short line are marked.
bool has_marks(const Series& series) {
    return !series.joined || series.x.size() <= most_marked;
}

struct Span {
    double low = INFINITY, high = -INFINITY;

    void add(const std::vector<double>& values) {
        for (const double value : values) {
            if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
        }
    }
};

/// Along x the lines fill the chart, but no mark is cut in two.
Ticks ticks_along(const Chart& chart, const Span& x, int count) {
    Ticks ticks = ticks_over(x.low, x.high, count);
    if (!chart.x_names.empty()) {
        ticks = {{}, chart.x_names, -0.5, static_cast<double>(chart.x_names.size()) - 0.5};
        for (std::size_t i = 0; i < chart.x_names.size(); ++i) ticks.places.push_back(static_cast<double>(i));
        return ticks;
    }
    if (!(x.low < x.high)) return ticks;
    const double room = std::any_of(chart.series.begin(), chart.series.end(), has_marks) ? 0.03 * (x.high - x.low) : 0;
    ticks.low = x.low - room;
    ticks.high = x.high + room;
    for (std::size_t i = ticks.places.size(); i-- > 0;) {
        if (ticks.places[i] >= ticks.low - 1e-9 && ticks.places[i] <= ticks.high + 1e-9) continue;
        ticks.places.erase(ticks.places.begin() + static_cast<std::ptrdiff_t>(i));
        ticks.labels.erase(ticks.labels.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return ticks;
}

Ticks ticks_up(Span y, int count) {
    if (y.low > 0 && y.low < 0.6 * y.high) y.low = 0;  // sizes are compared from 0 on
    Ticks ticks = ticks_over(y.low, y.high, count);
    const double room = 0.015 * (ticks.high - ticks.low);  // half a line's width, so that none is cut
    if (y.high > ticks.high - room) ticks.high += room;
    if (y.low < ticks.low + room && ticks.low != 0) ticks.low -= room;
    return ticks;
}

class LineChartItem final : public vtkContextItem {
public:
    static LineChartItem* New() {
        auto* made = new LineChartItem;
        made->InitializeObjectBase();
        return made;
    }

    void set(const ChartPage& page, const Chart& chart, const vtkRectf& place, float font) {
        page_ = &page, chart_ = &chart, font_ = font, look_ = look_of(page);
        Span x, y;
        if (chart.upright) x.low = 0;
        for (const Series& series : chart.series) {
            x.add(series.x);
            for (const std::vector<double>* values : {&series.y, &series.low, &series.high}) y.add(*values);
        }
        across_ = ticks_along(chart, x, std::max(2, static_cast<int>(place.GetWidth() / (4.5F * font))));
        up_ = ticks_up(y, std::max(2, static_cast<int>(place.GetHeight() / (3.2F * font))));
        std::size_t longest = 0;
        for (const std::string& label : up_.labels) longest = std::max(longest, label.size());
        labels_ = 0.5F * font * static_cast<float>(longest);
        left_ = place.GetX() + 2.2F * font + labels_;
        right_ = place.GetX() + place.GetWidth() - 1.2F * font;
        bottom_ = place.GetY() + 3.2F * font;
        top_ = place.GetY() + place.GetHeight() - 0.8F * font;
    }

    bool Paint(vtkContext2D* painter) override {
        paint_axes(*painter);
        for (const Series& series : chart_->series) {
            for_stretches(series,
                          [&](std::size_t first, std::size_t last) { paint_band(*painter, series, first, last); });
        }
        for (const Series& series : chart_->series) {
            for_stretches(series,
                          [&](std::size_t first, std::size_t last) { paint_line(*painter, series, first, last); });
        }
        return true;
    }

private:
    float at_x(double x) const {
        return left_ + static_cast<float>((x - across_.low) / (across_.high - across_.low)) * (right_ - left_);
    }
    float at_y(double y) const {
        return bottom_ + static_cast<float>((y - up_.low) / (up_.high - up_.low)) * (top_ - bottom_);
    }

    void pen(vtkContext2D& painter, const ChartColour& colour, float width, int line) const {
        painter.GetPen()->SetColor(colour);
        painter.GetPen()->SetWidth(width);
        painter.GetPen()->SetLineType(line);
    }

    void paint_axes(vtkContext2D& painter) const {
        const float tick = 0.35F * font_;
        for (std::size_t i = 0; i < across_.places.size(); ++i) {
            const float x = at_x(across_.places[i]);
            pen(painter, look_.grid, 1, vtkPen::SOLID_LINE);
            if (chart_->x_names.empty()) painter.DrawLine(x, bottom_, x, top_);
            pen(painter, look_.axis, 1, vtkPen::SOLID_LINE);
            painter.DrawLine(x, bottom_, x, bottom_ - tick);
            write(painter, across_.labels[i], x, bottom_ - 1.05F * font_, 0.85F);
        }
        for (std::size_t i = 0; i < up_.places.size(); ++i) {
            const float y = at_y(up_.places[i]);
            pen(painter, look_.grid, 1, vtkPen::SOLID_LINE);
            painter.DrawLine(left_, y, right_, y);
            pen(painter, look_.axis, 1, vtkPen::SOLID_LINE);
            painter.DrawLine(left_ - tick, y, left_, y);
            write(painter, up_.labels[i], left_ - 1.6F * tick, y, 0.85F, VTK_TEXT_RIGHT);
        }
        painter.DrawLine(left_, bottom_, right_, bottom_);
        painter.DrawLine(left_, bottom_, left_, top_);
        write(painter, chart_->x_title, (left_ + right_) / 2, bottom_ - 2.4F * font_, 1);
        write(painter, chart_->y_title, left_ - labels_ - 1.3F * font_, (bottom_ + top_) / 2, 1, VTK_TEXT_CENTERED, 90);
    }

    void write(vtkContext2D& painter, const std::string& text, float x, float y, float size,
               int justification = VTK_TEXT_CENTERED, double turned = 0) const {
        picture::write(painter, text, x, y, {look_.text, size * font_, justification, turned});
    }

    /// What lies between gaps.
    template <class Paint>
    void for_stretches(const Series& series, const Paint& paint) const {
        const auto shown = [&](std::size_t i) { return std::isfinite(series.x[i]) && std::isfinite(series.y[i]); };
        for (std::size_t first = 0; first < series.x.size();) {
            std::size_t last = first;
            while (last < series.x.size() && shown(last)) ++last;
            if (last > first) paint(first, last);
            first = last + 1;
        }
    }

    const Key& key_of(const Series& series) const { return page_->keys.at(series.key); }
    const ChartColour& colour_of(const Series& series) const {
        return look_.lines[static_cast<std::size_t>(key_of(series).colour)];
    }

    void paint_band(vtkContext2D& painter, const Series& series, std::size_t first, std::size_t last) const {
        if (series.low.empty() || last - first < 2) return;
        vtkNew<vtkPoints2D> edges;
        for (std::size_t i = first; i < last; ++i) {
            edges->InsertNextPoint(at_x(series.x[i]), at_y(series.low[i]));
            edges->InsertNextPoint(at_x(series.x[i]), at_y(series.high[i]));
        }
        painter.GetPen()->SetLineType(vtkPen::NO_PEN);
        painter.GetBrush()->SetColor(colour_of(series));
        painter.GetBrush()->SetOpacity(45);
        painter.DrawQuadStrip(edges);
        painter.GetBrush()->SetOpacity(255);
    }

    void paint_line(vtkContext2D& painter, const Series& series, std::size_t first, std::size_t last) const {
        vtkNew<vtkPoints2D> points;
        for (std::size_t i = first; i < last; ++i) points->InsertNextPoint(at_x(series.x[i]), at_y(series.y[i]));
        if (series.joined && last - first > 1) {
            pen(painter, colour_of(series), font_ / 7, dash_of(key_of(series)));
            painter.DrawPoly(points);
        }
        if (!has_marks(series) && last - first > 1) return;
        painter.GetPen()->SetLineType(vtkPen::NO_PEN);
        painter.GetBrush()->SetColor(colour_of(series));
        const float radius = series.joined ? font_ / 4.5F : font_ / 7;
        for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) {
            double point[2];
            points->GetPoint(i, point);
            painter.DrawEllipse(static_cast<float>(point[0]), static_cast<float>(point[1]), radius, radius);
        }
    }

    const ChartPage* page_ = nullptr;
    const Chart* chart_ = nullptr;
    ChartLook look_;
    Ticks across_, up_;
    float font_ = 14, labels_ = 0, left_ = 0, right_ = 1, bottom_ = 0, top_ = 1;
};

}  // namespace

vtkSmartPointer<vtkContextItem> line_chart_item(const ChartPage& page, const Chart& chart, const vtkRectf& place,
                                                float font) {
    return placed_item<LineChartItem>(page, chart, place, font);
}

}  // namespace espalier::picture
