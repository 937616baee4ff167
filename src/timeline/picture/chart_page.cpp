#include "espalier/timeline/chart_page.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

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

namespace espalier {
namespace {

using Colour = vtkColor4ub;

/// Colours of a page. Those of lines are Okabe & Ito's (2008), without the one that fades on the background.
struct Look {
    Colour background, text, axis, grid;
    std::array<Colour, Key::colour_count> lines;
};

Look look_of(const ChartPage& page) {
    if (page.dark) {
        return {Colour(24, 26, 30),
                Colour(230, 230, 230),
                Colour(150, 150, 155),
                Colour(52, 55, 61),
                {Colour(86, 180, 233), Colour(230, 159, 0), Colour(0, 190, 140), Colour(224, 142, 186),
                 Colour(240, 228, 66), Colour(237, 109, 40), Colour(200, 200, 200)}};
    }
    return {Colour(255, 255, 255),
            Colour(40, 40, 40),
            Colour(120, 120, 120),
            Colour(230, 230, 230),
            {Colour(0, 114, 178), Colour(213, 94, 0), Colour(0, 158, 115), Colour(204, 121, 167), Colour(230, 159, 0),
             Colour(86, 180, 233), Colour(70, 70, 70)}};
}

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

void set_text(vtkTextProperty& text, const Colour& colour, float size) {
    text.SetFontFamilyToArial();
    text.SetColor(colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
    text.SetFontSize(static_cast<int>(size));
    text.SetBold(0);
    text.SetItalic(0);
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
        const Look look = look_of(*page_);
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

void set_axis(vtkAxis& axis, const Look& look, float font, const std::string& title, const Ticks& ticks) {
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

/// A stretch of a line without gaps, of one point as a dot.
void add_stretch(vtkChartXY& chart, const Series& series, std::size_t first, std::size_t last, const Key& key,
                 const Look& look, float font) {
    vtkNew<vtkDoubleArray> x, y;
    x->SetName("x");
    y->SetName("y");
    for (std::size_t i = first; i < last; ++i) {
        x->InsertNextValue(series.x[i]);
        y->InsertNextValue(series.y[i]);
    }
    vtkNew<vtkTable> table;
    table->AddColumn(x);
    table->AddColumn(y);
    auto* line = vtkPlotPoints::SafeDownCast(chart.AddPlot(last - first > 1 ? vtkChart::LINE : vtkChart::POINTS));
    line->SetInputData(table, 0, 1);
    const Colour& colour = look.lines[static_cast<std::size_t>(key.colour)];
    line->GetPen()->SetColor(colour);
    line->GetPen()->SetWidth(font / 7);
    line->GetPen()->SetLineType(dashes[static_cast<std::size_t>(key.dash)]);
    line->GetBrush()->SetColor(colour);
    // A short stretch shows its points.
    line->SetMarkerStyle(last - first <= 12 ? vtkPlotPoints::CIRCLE : vtkPlotPoints::NONE);
    line->SetMarkerSize(font / 2.4F);
}

void add_line(vtkChartXY& chart, const Series& series, const Key& key, const Look& look, float font) {
    const auto shown = [&](std::size_t i) { return std::isfinite(series.x[i]) && std::isfinite(series.y[i]); };
    for (std::size_t first = 0; first < series.x.size();) {
        std::size_t last = first;
        while (last < series.x.size() && shown(last)) ++last;
        if (last > first) add_stretch(chart, series, first, last, key, look, font);
        first = last + 1;
    }
}

vtkSmartPointer<vtkChartXY> chart_of(const ChartPage& page, const Chart& chart, const vtkRectf& place, float font) {
    const Look look = look_of(page);
    auto drawn = vtkSmartPointer<vtkChartXY>::New();
    drawn->SetAutoSize(false);
    drawn->SetSize(place);
    drawn->SetShowLegend(false);
    drawn->GetBackgroundBrush()->SetOpacity(0);
    Span x, y;
    for (const Series& series : chart.series) {
        x.add(series.x);
        y.add(series.y);
        add_line(*drawn, series, page.keys.at(series.key), look, font);
    }
    if (y.low > 0 && y.low < 0.6 * y.high) y.low = 0;  // sizes are compared from 0 on
    const int across = std::max(2, static_cast<int>(place.GetWidth() / (4.5F * font)));
    const int up = std::max(2, static_cast<int>(place.GetHeight() / (3.2F * font)));
    Ticks below = ticks_over(x.low, x.high, across);
    if (x.low < x.high) {  // along x the lines fill the chart
        below.low = x.low;
        below.high = x.high;
        const auto outside = [&](double at) { return at < x.low - 1e-9 || at > x.high + 1e-9; };
        for (std::size_t i = below.places.size(); i-- > 0;) {
            if (!outside(below.places[i])) continue;
            below.places.erase(below.places.begin() + static_cast<std::ptrdiff_t>(i));
            below.labels.erase(below.labels.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
    set_axis(*drawn->GetAxis(vtkAxis::BOTTOM), look, font, chart.x_title, below);
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
        actor->GetScene()->AddItem(chart_of(page, page.charts[i], layout.charts[i], layout.font));
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
