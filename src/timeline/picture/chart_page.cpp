#include "espalier/timeline/chart_page.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "timeline/picture/chart_look.h"
#include "timeline/picture/heat_map.h"
#include "timeline/picture/off_screen.h"

#include <fmt/format.h>
#include <vtkAxis.h>
#include <vtkBrush.h>
#include <vtkChartXY.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotArea.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <utility>

namespace espalier {
namespace {

constexpr std::array<int, Key::dash_count> dashes{vtkPen::SOLID_LINE, vtkPen::DASH_LINE, vtkPen::DOT_LINE,
                                                  vtkPen::DASH_DOT_LINE};

/// Where things stand on the page, in pixels from below.
struct Layout {
    int columns = 1, rows = 1;
    float font = 14;
    std::vector<vtkRectf> charts;
    std::vector<vtkVector2f> keys;  ///< left end of each key that has room
    vtkVector2f title;
};

constexpr std::size_t most_keys = 16;

int columns_for(std::size_t charts) {
    return charts <= 1 ? 1 : charts <= 4 ? 2 : charts <= 12 ? 3 : 4;
}

float width_of_key(const Key& key, float font) {
    return font * (4.2F + 0.56F * static_cast<float>(key.name.size()));
}

/// Sets the keys in lines from the top; returns the height they take.
float place_keys(const ChartPage& page, const PictureSize& size, float top, Layout& layout) {
    if (page.keys.size() < 2 || page.keys.size() > most_keys) return 0;
    const float margin = layout.font, line = 1.6F * layout.font, right = static_cast<float>(size.width) - margin;
    float x = margin, y = top - line / 2;
    for (const Key& key : page.keys) {
        const float width = width_of_key(key, layout.font);
        if (x > margin && x + width > right) x = margin, y -= line;
        layout.keys.emplace_back(x, y);
        x += width;
    }
    return top - y + line / 2;
}

Layout layout_of(const ChartPage& page, const PictureSize& size) {
    Layout layout;
    layout.columns = columns_for(page.charts.size());
    const auto columns = static_cast<std::size_t>(layout.columns);
    layout.rows = std::max(1, static_cast<int>((page.charts.size() + columns - 1) / columns));
    const float cell = std::min(static_cast<float>(size.width) / static_cast<float>(layout.columns),
                                1.5F * static_cast<float>(size.height) / static_cast<float>(layout.rows));
    layout.font = std::clamp(std::round(cell / 34), 9.0F, 30.0F);
    const float font = layout.font;
    float top = static_cast<float>(size.height) - 0.6F * font;
    if (!page.title.empty()) {
        layout.title = {font, top - font};
        top -= 2.2F * font;
    }
    top -= place_keys(page, size, top, layout);
    const float width = (static_cast<float>(size.width) - font) / static_cast<float>(layout.columns);
    const float height = top / static_cast<float>(layout.rows);
    for (std::size_t i = 0; i < page.charts.size(); ++i) {
        const auto column = static_cast<float>(i % columns), row = static_cast<float>(i / columns);
        layout.charts.emplace_back(column * width, top - (row + 1) * height, width, height);
    }
    return layout;
}

/// The page's title and legend, and the background.
class Heading final : public vtkContextItem {
public:
    static Heading* New() {
        auto* made = new Heading;
        made->InitializeObjectBase();
        return made;
    }

    void set(const ChartPage& page, const Layout& layout, const PictureSize& size) {
        page_ = &page, layout_ = &layout, size_ = size;
    }

    bool Paint(vtkContext2D* painter) override {
        const ChartLook look = look_of(*page_);
        painter->GetPen()->SetLineType(vtkPen::NO_PEN);
        painter->GetBrush()->SetColor(look.background);
        painter->DrawRect(0, 0, static_cast<float>(size_.width), static_cast<float>(size_.height));
        vtkNew<vtkTextProperty> text;
        set_text(*text, look.text, layout_->font);
        text->SetVerticalJustificationToCentered();
        text->SetJustificationToLeft();
        for (std::size_t i = 0; i < layout_->keys.size(); ++i) {
            const vtkVector2f place = layout_->keys[i];
            const Key& key = page_->keys[i];
            painter->GetPen()->SetColor(look.lines[static_cast<std::size_t>(key.colour)]);
            painter->GetPen()->SetWidth(layout_->font / 5);
            painter->GetPen()->SetLineType(dashes[static_cast<std::size_t>(key.dash)]);
            painter->DrawLine(place.GetX(), place.GetY(), place.GetX() + 2.4F * layout_->font, place.GetY());
            painter->ApplyTextProp(text);
            painter->DrawString(place.GetX() + 2.9F * layout_->font, place.GetY(), key.name);
        }
        if (!page_->title.empty()) {
            text->SetBold(1);
            text->SetFontSize(static_cast<int>(1.15F * layout_->font));
            painter->ApplyTextProp(text);
            painter->DrawString(layout_->title.GetX(), layout_->title.GetY(), page_->title);
        }
        return true;
    }

private:
    const ChartPage* page_ = nullptr;
    const Layout* layout_ = nullptr;
    PictureSize size_;
};

struct Span {
    double low = INFINITY, high = -INFINITY;

    void add(const std::vector<double>& values) {
        for (const double value : values) {
            if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
        }
    }
};

void set_axis(vtkAxis& axis, const ChartLook& look, float font, const std::string& title, const Ticks& ticks) {
    vtkNew<vtkDoubleArray> places;
    vtkNew<vtkStringArray> labels;
    for (std::size_t i = 0; i < ticks.places.size(); ++i) {
        places->InsertNextValue(ticks.places[i]);
        labels->InsertNextValue(ticks.labels[i]);
    }
    axis.SetBehavior(vtkAxis::FIXED);
    axis.SetCustomTickPositions(places, labels);
    axis.SetRange(ticks.low, ticks.high);
    axis.SetTitle(title);
    set_text(*axis.GetTitleProperties(), look.text, font);
    set_text(*axis.GetLabelProperties(), look.text, 0.85F * font);
    axis.GetPen()->SetColor(look.axis);
    axis.GetPen()->SetWidth(1);
    axis.GetGridPen()->SetColor(look.grid);
    axis.GetGridPen()->SetWidth(1);
}

vtkSmartPointer<vtkTable> table_of(std::initializer_list<std::pair<const char*, std::span<const double>>> columns) {
    auto table = vtkSmartPointer<vtkTable>::New();
    for (const auto& [name, values] : columns) {
        vtkNew<vtkDoubleArray> column;
        column->SetName(name);
        for (const double value : values) column->InsertNextValue(value);
        table->AddColumn(column);
    }
    return table;
}

struct Stretch {
    const Series& series;
    std::size_t first, count;

    std::span<const double> of(const std::vector<double>& values) const { return {values.data() + first, count}; }
};

void add_band(vtkChartXY& chart, const Stretch& stretch, const ChartColour& colour) {
    const Series& series = stretch.series;
    auto* band = vtkPlotArea::SafeDownCast(chart.AddPlot(vtkChart::AREA));
    band->SetInputData(
        table_of({{"x", stretch.of(series.x)}, {"low", stretch.of(series.low)}, {"high", stretch.of(series.high)}}));
    band->SetInputArray(0, "x");
    band->SetInputArray(1, "low");
    band->SetInputArray(2, "high");
    band->GetBrush()->SetColor(colour);
    band->GetBrush()->SetOpacity(45);
    band->GetPen()->SetLineType(vtkPen::NO_PEN);
}

/// A stretch of a line without gaps, of one point as a dot.
void add_stretch(vtkChartXY& chart, const Stretch& stretch, const Key& key, const ChartLook& look, float font) {
    const bool joined = stretch.series.joined && stretch.count > 1;
    const ChartColour& colour = look.lines[static_cast<std::size_t>(key.colour)];
    if (!stretch.series.low.empty() && joined) add_band(chart, stretch, colour);
    auto* line = vtkPlotPoints::SafeDownCast(chart.AddPlot(joined ? vtkChart::LINE : vtkChart::POINTS));
    line->SetInputData(table_of({{"x", stretch.of(stretch.series.x)}, {"y", stretch.of(stretch.series.y)}}), 0, 1);
    line->GetPen()->SetColor(colour);
    line->GetPen()->SetWidth(font / 7);
    line->GetPen()->SetLineType(dashes[static_cast<std::size_t>(key.dash)]);
    line->GetBrush()->SetColor(colour);
    // A short stretch shows its points.
    line->SetMarkerStyle(stretch.count <= 12 || !joined ? vtkPlotPoints::CIRCLE : vtkPlotPoints::NONE);
    line->SetMarkerSize(stretch.series.joined ? font / 2.4F : font / 4);
}

void add_line(vtkChartXY& chart, const Series& series, const Key& key, const ChartLook& look, float font) {
    const auto shown = [&](std::size_t i) { return std::isfinite(series.x[i]) && std::isfinite(series.y[i]); };
    for (std::size_t first = 0; first < series.x.size();) {
        std::size_t last = first;
        while (last < series.x.size() && shown(last)) ++last;
        if (last > first) add_stretch(chart, {series, first, last - first}, key, look, font);
        first = last + 1;
    }
}

/// Along x the lines fill the chart, but for dots, which are not cut in two.
Ticks ticks_along(const Chart& chart, const Span& x, int count) {
    Ticks ticks = ticks_over(x.low, x.high, count);
    if (!chart.x_names.empty()) {
        ticks = {{}, chart.x_names, -0.5, static_cast<double>(chart.x_names.size()) - 0.5};
        for (std::size_t i = 0; i < chart.x_names.size(); ++i) ticks.places.push_back(static_cast<double>(i));
        return ticks;
    }
    if (!(x.low < x.high)) return ticks;
    const bool dots = std::any_of(chart.series.begin(), chart.series.end(), [](const Series& s) { return !s.joined; });
    const double room = dots ? 0.03 * (x.high - x.low) : 0;
    ticks.low = x.low - room;
    ticks.high = x.high + room;
    for (std::size_t i = ticks.places.size(); i-- > 0;) {
        if (ticks.places[i] >= ticks.low - 1e-9 && ticks.places[i] <= ticks.high + 1e-9) continue;
        ticks.places.erase(ticks.places.begin() + static_cast<std::ptrdiff_t>(i));
        ticks.labels.erase(ticks.labels.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return ticks;
}

vtkSmartPointer<vtkChartXY> chart_of(const ChartPage& page, const Chart& chart, const vtkRectf& place, float font) {
    const ChartLook look = look_of(page);
    auto drawn = vtkSmartPointer<vtkChartXY>::New();
    drawn->SetAutoSize(false);
    drawn->SetSize(place);
    drawn->SetShowLegend(false);
    drawn->GetBackgroundBrush()->SetOpacity(0);
    Span x, y;
    for (const Series& series : chart.series) {
        x.add(series.x);
        y.add(series.y);
        y.add(series.low);
        y.add(series.high);
        add_line(*drawn, series, page.keys.at(series.key), look, font);
    }
    if (y.low > 0 && y.low < 0.6 * y.high) y.low = 0;  // sizes are compared from 0 on
    const int across = std::max(2, static_cast<int>(place.GetWidth() / (4.5F * font)));
    const int up = std::max(2, static_cast<int>(place.GetHeight() / (3.2F * font)));
    set_axis(*drawn->GetAxis(vtkAxis::BOTTOM), look, font, chart.x_title, ticks_along(chart, x, across));
    Ticks beside = ticks_over(y.low, y.high, up);
    const double room = 0.015 * (beside.high - beside.low);  // half a line's width, so that none is cut
    if (y.high > beside.high - room) beside.high += room;
    if (y.low < beside.low + room && beside.low != 0) beside.low -= room;
    set_axis(*drawn->GetAxis(vtkAxis::LEFT), look, font, chart.y_title, beside);
    drawn->GetAxis(vtkAxis::TOP)->SetVisible(false);
    drawn->GetAxis(vtkAxis::RIGHT)->SetVisible(false);
    return drawn;
}

void write_svg(vtkRenderer& renderer, vtkRenderWindow& window, const std::filesystem::path& path) {
    write_file(path, [&](const std::filesystem::path& temporary) {
        vtkNew<vtkSVGExporter> exporter;
        exporter->SetRenderWindow(&window);
        exporter->SetActiveRenderer(&renderer);
        exporter->SetFileName(temporary.c_str());
        exporter->Write();
        return std::filesystem::exists(temporary);
    });
}

}  // namespace

PictureSize fitting_size(const ChartPage& page) {
    const int columns = columns_for(page.charts.size());
    const int rows = std::max(1, (static_cast<int>(page.charts.size()) + columns - 1) / columns);
    return columns == 1 ? PictureSize{900, 600} : PictureSize{columns * 520, rows * 340 + 60};
}

void write_picture(const ChartPage& page, const PictureSize& size, const std::filesystem::path& path) {
    const std::string kind = path.extension().string();
    if (kind != ".png" && kind != ".svg") {
        throw UserError(fmt::format("{}: a picture is a .png or a .svg", path.string()));
    }
    OffScreenWindow screen(size.width, size.height);
    const Layout layout = layout_of(page, size);
    vtkNew<vtkContextActor> actor;
    vtkNew<Heading> heading;
    heading->set(page, layout, size);
    actor->GetScene()->AddItem(heading);
    for (std::size_t i = 0; i < page.charts.size(); ++i) {
        const Chart& chart = page.charts[i];
        if (chart.map) {
            actor->GetScene()->AddItem(heat_map_item(page, chart, layout.charts[i], layout.font));
        } else {
            actor->GetScene()->AddItem(chart_of(page, chart, layout.charts[i], layout.font));
        }
    }
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(actor);
    actor->GetScene()->SetRenderer(renderer);
    screen.window().AddRenderer(renderer);
    if (kind == ".png") {
        screen.write_png(path);
    } else {
        screen.render();
        write_svg(*renderer, screen.window(), path);
    }
    screen.window().RemoveRenderer(renderer);
}

}  // namespace espalier
