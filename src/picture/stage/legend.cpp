#include "picture/stage/legend.h"

#include "espalier/picture/chart_page.h"

#include <fmt/format.h>
#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace espalier::picture {
namespace {

float font_of(int picture_height) {
    return std::clamp(std::round(static_cast<float>(picture_height) / 40), 9.0F, 48.0F);
}

Ticks ticks_of(const ColourKey& key) {
    return ticks_over(key.range[0], key.range[1], 5);
}

/// About: the widths of letters are known to the painter alone, and the camera is placed before it paints.
float text_width(const std::string& text, float font) {
    return 0.56F * font * static_cast<float>(text.size());
}

float width_of(const ColourKey& key, float font) {
    float inside = 0;
    if (!key.colours.empty()) {
        for (const std::string& label : ticks_of(key).labels) inside = std::max(inside, text_width(label, font));
    }
    for (const auto& [name, rgb] : key.names) inside = std::max(inside, text_width(name, font));
    return std::max(text_width(key.title, font), inside + 1.8F * font);
}

float height_of(const ColourKey& key, float font, int picture_height) {
    const float title = key.title.empty() ? 0 : 1.8F * font;
    if (key.colours.empty()) return title + 1.5F * font * static_cast<float>(key.names.size());
    return title + std::clamp(0.3F * static_cast<float>(picture_height), 6 * font, 12 * font);
}

/// Paints from above, in pixels.
class LegendPainter {
public:
    LegendPainter(vtkContext2D& painter, const Legend& legend, int width, int height)
        : painter_(painter),
          legend_(legend),
          width_(static_cast<float>(width)),
          height_(static_cast<float>(height)),
          font_(font_of(height)) {}

    void paint() {
        if (!legend_.title.empty()) write(legend_.title, font_, height_ - 1.4F * font_, 1.25F);
        if (!legend_.time.empty()) write(legend_.time, font_, font_ * (legend_.metres_per_pixel > 0 ? 3.4F : 1.3F));
        if (legend_.metres_per_pixel > 0) paint_scale_bar();
        if (!legend_.caption.empty()) write_caption();
        if (legend_.shows_keys) paint_keys();
    }

private:
    void set_ink() {
        const unsigned char ink = legend_.dark ? 230 : 40;
        painter_.GetPen()->SetColor(ink, ink, ink, 255);
        painter_.GetPen()->SetWidth(std::max(1.0F, font_ / 12));
        painter_.GetTextProp()->SetColor(ink / 255.0, ink / 255.0, ink / 255.0);
    }

    void write(const std::string& text, float x, float y, float scale = 1) {
        set_ink();
        vtkTextProperty& property = *painter_.GetTextProp();
        property.SetFontFamilyToArial();
        property.SetFontSize(static_cast<int>(scale * font_));
        property.SetJustificationToLeft();
        property.SetVerticalJustificationToCentered();
        painter_.DrawString(x, y, text.c_str());
    }

    void write_caption() {
        set_ink();
        painter_.GetTextProp()->SetFontSize(static_cast<int>(1.4F * font_));
        painter_.GetTextProp()->SetJustificationToCentered();
        painter_.GetTextProp()->SetVerticalJustificationToCentered();
        painter_.DrawString(width_ / 2, 1.2F * font_, legend_.caption.c_str());
    }

    void fill(const Rgb& rgb, float x, float y, float width, float height) {
        painter_.GetPen()->SetLineType(vtkPen::NO_PEN);
        painter_.GetBrush()->SetColor(rgb[0], rgb[1], rgb[2], 255);
        painter_.DrawRect(x, y, width, height);
        painter_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    }

    void paint_keys() {
        float all = 0;
        for (const ColourKey& key : legend_.keys)
            all += height_of(key, font_, static_cast<int>(height_)) + 1.5F * font_;
        const float left = width_ - legend_.width(static_cast<int>(height_)) + 0.5F * font_;
        float top = std::min(height_ - 1.5F * font_, (height_ + all) / 2);
        for (const ColourKey& key : legend_.keys) {
            const float height = height_of(key, font_, static_cast<int>(height_));
            float under = top;
            if (!key.title.empty()) {
                write(key.title, left, top - 0.5F * font_);
                under -= 1.8F * font_;
            }
            if (key.colours.empty()) {
                paint_names(key, left, under);
            } else {
                paint_bar(key, left, top - height, under - top + height);
            }
            top -= height + 1.5F * font_;
        }
    }

    void paint_names(const ColourKey& key, float left, float top) {
        for (const auto& [name, rgb] : key.names) {
            fill(rgb, left, top - 1.1F * font_, 0.9F * font_, 0.9F * font_);
            write(name, left + 1.5F * font_, top - 0.65F * font_);
            top -= 1.5F * font_;
        }
    }

    void paint_bar(const ColourKey& key, float left, float bottom, float height) {
        const float width = 0.9F * font_;
        const int strips = std::max(2, static_cast<int>(height));
        for (int i = 0; i < strips; ++i) {
            const auto n = static_cast<float>(strips);
            fill(along(key.colours, (i + 0.5) / strips), left, bottom + height * static_cast<float>(i) / n, width,
                 height / n + 0.5F);
        }
        const double span = key.range[1] - key.range[0];
        const Ticks ticks = ticks_of(key);
        for (std::size_t i = 0; i < ticks.places.size(); ++i) {
            const double place = span > 0 ? (ticks.places[i] - key.range[0]) / span : 0.5;
            if (place < -1e-9 || place > 1 + 1e-9) continue;
            const float y = bottom + height * static_cast<float>(place);
            set_ink();
            painter_.DrawLine(left + width, y, left + 1.25F * width, y);
            write(ticks.labels[i], left + 1.7F * font_, y);
        }
    }

    void paint_scale_bar() {
        const NiceLength length = nice_length(0.25 * width_ * legend_.metres_per_pixel);
        const auto pixels = static_cast<float>(length.metres / legend_.metres_per_pixel);
        const float y = 0.9F * font_;
        set_ink();
        painter_.GetPen()->SetWidth(std::max(2.0F, font_ / 6));
        painter_.DrawLine(font_, y, font_ + pixels, y);
        write(length.text, font_, y + font_);
    }

    vtkContext2D& painter_;
    const Legend& legend_;
    float width_, height_, font_;
};

}  // namespace

vtkStandardNewMacro(LegendItem);

float Legend::width(int picture_height) const {
    const float font = font_of(picture_height);
    float width = 0;
    if (!shows_keys) return width;
    for (const ColourKey& key : keys) width = std::max(width, width_of(key, font) + 1.2F * font);
    return width;
}

bool LegendItem::Paint(vtkContext2D* painter) {
    LegendPainter(*painter, legend, GetScene()->GetSceneWidth(), GetScene()->GetSceneHeight()).paint();
    return true;
}

NiceLength nice_length(double most) {
    if (!(most > 0) || !std::isfinite(most)) return {0, ""};
    const double power = std::pow(10, std::floor(std::log10(most)));
    const double metres = most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
    if (metres >= 1000) return {metres, fmt::format("{:g} km", metres / 1000)};
    if (metres >= 0.99) return {metres, fmt::format("{:g} m", metres)};
    if (metres >= 0.0099) return {metres, fmt::format("{:g} cm", metres * 100)};
    return {metres, fmt::format("{:g} mm", metres * 1000)};
}

}  // namespace espalier::picture
