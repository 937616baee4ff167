#include "picture/charts/heat_map.h"

#include "picture/charts/chart_look.h"
#include "picture/palette.h"

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkPen.h>
#include <vtkRect.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

class HeatMapItem final : public vtkContextItem {
public:
    static HeatMapItem* New() {
        auto* made = new HeatMapItem;
        made->InitializeObjectBase();
        return made;
    }

    void set(const ChartPage& page, const Chart& chart, const vtkRectf& place, float font) {
        chart_ = &chart, font_ = font, look_ = look_of(page);
        for (const double value : map().values) {
            if (std::isfinite(value)) low_ = std::min(low_, value), high_ = std::max(high_, value);
        }
        const float names = 0.6F * font * static_cast<float>(longest(map().rows));
        left_ = place.GetX() + 2.6F * font + names;
        bottom_ = place.GetY() + 3.8F * font;
        width_ = place.GetX() + place.GetWidth() - 7 * font - left_;
        height_ = place.GetY() + place.GetHeight() - 2.2F * font - bottom_;
    }

    bool Paint(vtkContext2D* painter) override {
        painter->GetPen()->SetLineType(vtkPen::NO_PEN);
        for (std::size_t row = 0; row < map().rows.size(); ++row) {
            for (std::size_t column = 0; column < map().columns.size(); ++column) paint_cell(*painter, row, column);
        }
        paint_names(*painter);
        paint_bar(*painter);
        return true;
    }

private:
    const HeatMap& map() const { return *chart_->map; }
    static std::size_t longest(const std::vector<std::string>& names) {
        std::size_t most = 0;
        for (const std::string& name : names) most = std::max(most, name.size());
        return most;
    }
    float cell_width() const { return width_ / static_cast<float>(map().columns.size()); }
    float cell_height() const { return height_ / static_cast<float>(map().rows.size()); }

    Rgb colour(double value) const { return along(viridis(), high_ > low_ ? (value - low_) / (high_ - low_) : 0.5); }

    void paint_cell(vtkContext2D& painter, std::size_t row, std::size_t column) const {
        const double value = map().values[row * map().columns.size() + column];
        if (!std::isfinite(value)) return;
        const float x = left_ + static_cast<float>(column) * cell_width();
        const float y = bottom_ + static_cast<float>(row) * cell_height();
        const Rgb rgb = colour(value);
        painter.GetBrush()->SetColor(rgb[0], rgb[1], rgb[2], 255);
        painter.DrawRect(x, y, cell_width() - 1, cell_height() - 1);
        const std::string text = fmt::format("{:.3g}", value);
        const bool has_room =
            cell_width() > 0.6F * font_ * static_cast<float>(text.size() + 1) && cell_height() > 1.4F * font_;
        if (!has_room) return;
        const double brightness = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
        write(painter, text, x + cell_width() / 2, y + cell_height() / 2,
              brightness > 130 ? ChartColour(30, 30, 30) : ChartColour(245, 245, 245));
    }

    // As many names as have room, the first among them.
    void paint_names(vtkContext2D& painter) const {
        const float letters = 0.6F * font_ * static_cast<float>(longest(map().columns) + 2);
        const auto across = static_cast<std::size_t>(std::ceil(std::max(1.0F, letters / cell_width())));
        for (std::size_t i = 0; i < map().columns.size(); i += across) {
            write(painter, map().columns[i], left_ + (static_cast<float>(i) + 0.5F) * cell_width(),
                  bottom_ - 0.9F * font_, look_.text);
        }
        const auto up = static_cast<std::size_t>(std::ceil(std::max(1.0F, 1.3F * font_ / cell_height())));
        for (std::size_t i = 0; i < map().rows.size(); i += up) {
            const float names = 0.3F * font_ * static_cast<float>(longest(map().rows));
            write(painter, map().rows[i], left_ - 0.4F * font_ - names,
                  bottom_ + (static_cast<float>(i) + 0.5F) * cell_height(), look_.text);
        }
        write(painter, chart_->x_title, left_ + width_ / 2, bottom_ - 2.4F * font_, look_.text, 1);
        write(painter, map().title, left_ + width_ / 2, bottom_ + height_ + 0.9F * font_, look_.text, 1);
        const float names = 0.6F * font_ * static_cast<float>(longest(map().rows));
        write(painter, chart_->y_title, left_ - names - 1.4F * font_, bottom_ + height_ / 2, look_.text, 1, 90);
    }

    void paint_bar(vtkContext2D& painter) const {
        if (!(high_ > low_)) return;
        constexpr int steps = 64;
        const float x = left_ + width_ + 1.2F * font_, step = height_ / steps;
        for (int i = 0; i < steps; ++i) {
            const Rgb rgb = along(viridis(), (i + 0.5) / steps);
            painter.GetBrush()->SetColor(rgb[0], rgb[1], rgb[2], 255);
            painter.DrawRect(x, bottom_ + static_cast<float>(i) * step, font_, step + 0.5F);
        }
        const Ticks ticks = ticks_over(low_, high_, std::max(2, static_cast<int>(height_ / (3.2F * font_))));
        for (std::size_t i = 0; i < ticks.places.size(); ++i) {
            const double place = (ticks.places[i] - low_) / (high_ - low_);
            if (place < -1e-9 || place > 1 + 1e-9) continue;
            const float half = 0.3F * font_ * static_cast<float>(ticks.labels[i].size());
            write(painter, ticks.labels[i], x + 1.4F * font_ + half, bottom_ + static_cast<float>(place) * height_,
                  look_.text);
        }
    }

    /// Its middle at (x, y).
    void write(vtkContext2D& painter, const std::string& text, float x, float y, const ChartColour& of,
               float size = 0.85F, double turned = 0) const {
        picture::write(painter, text, x, y, {of, size * font_, VTK_TEXT_CENTERED, turned});
    }

    const Chart* chart_ = nullptr;
    ChartLook look_;
    float font_ = 14, left_ = 0, bottom_ = 0, width_ = 1, height_ = 1;
    double low_ = INFINITY, high_ = -INFINITY;
};

}  // namespace

vtkSmartPointer<vtkContextItem> heat_map_item(const ChartPage& page, const Chart& chart, const vtkRectf& place,
                                              float font) {
    return placed_item<HeatMapItem>(page, chart, place, font);
}

}  // namespace espalier::picture
