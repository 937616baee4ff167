#include "espalier/picture/chart_page.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "picture/charts/chart_look.h"
#include "picture/charts/heat_map.h"
#include "picture/charts/line_chart.h"
#include "picture/files/off_screen.h"

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkRect.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSVGExporter.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::picture {
namespace {

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
            painter->GetPen()->SetLineType(dash_of(key));
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
        const auto make = chart.map ? heat_map_item : line_chart_item;
        actor->GetScene()->AddItem(make(page, chart, layout.charts[i], layout.font));
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

}  // namespace espalier::picture
